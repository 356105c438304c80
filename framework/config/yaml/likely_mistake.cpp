#include "framework/config/yaml/likely_mistake.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>
#include <vector>

namespace sprekk {
namespace {

/// Reads a text line by line as far as quotation marks, brackets, comments and indentation matter, up to a mistake.
class Scan {
 public:
  Scan(const std::string& text, std::string source) : source_(std::move(source)) {
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line) && !mistake_;) {
      ++number_;
      if (!line.empty() && line.back() == '\r') line.pop_back();
      read(line);
    }
    if (mistake_) return;
    if (quote_ != 0)
      mistake_.emplace(quote_at_, fmt::format("the quotation mark {} is never closed", quote_), "the text ends in it",
                       "close it on its line, or remove it");
    else if (!open_.empty())
      mistake_.emplace(open_.back().where, fmt::format("the '{}' is never closed", open_.back().bracket),
                       "the text ends in it", fmt::format("write '{}' where it ends", partner(open_.back().bracket)));
  }

  std::optional<InputError> mistake() const { return mistake_; }
  bool ends_in_quotes() const { return quote_ != 0; }

 private:
  struct Open {
    char bracket;
    Origin where;
  };

  static char partner(char bracket) { return bracket == '[' ? ']' : bracket == '{' ? '}' : bracket == ']' ? '[' : '{'; }

  void read(const std::string& line) {
    const std::size_t first = line.find_first_not_of(' ');
    const bool is_block = quote_ == 0 && open_.empty();
    const bool is_empty = first == std::string::npos || line[first] == '#';
    if (is_block && is_empty) return;
    if (is_block && block_text_ && first > *block_text_) return;
    block_text_.reset();
    const Origin place{source_, number_, static_cast<int>(first) + 1};
    if (is_block && line[first] == '\t')
      mistake_.emplace(place, "malformed YAML", "a tab stands in the indentation", "use spaces");
    if (is_block && !mistake_) read_indentation(line, first, place);
    if (!mistake_) read_marks(line, is_block ? first : 0);
    if (is_block && (line.back() == '|' || line.back() == '>')) block_text_ = first;
  }

  /// Refuses a line that is indented less than the one above, and as deep as none before that.
  void read_indentation(const std::string& line, std::size_t first, const Origin& place) {
    std::string levels;
    bool is_less = false;
    while (!levels_.empty() && levels_.back() > first) {
      levels = fmt::format("{}{}{}", levels_.back(), levels.empty() ? "" : " or ", levels);
      levels_.pop_back();
      is_less = true;
    }
    if (is_less && (levels_.empty() || levels_.back() != first)) {
      if (!levels_.empty()) levels = fmt::format("{} or {}", levels_.back(), levels);
      mistake_.emplace(place, fmt::format("the line is indented by {} {}", first, first == 1 ? "space" : "spaces"),
                       fmt::format("the lines above, to which it could belong, by {}", levels),
                       "indent it as those that it belongs to");
      return;
    }
    if (levels_.empty() || levels_.back() != first) levels_.push_back(first);
    for (std::size_t at = first; line.compare(at, 2, "- ") == 0;) {  // what stands in an item is a level of its own
      at = line.find_first_not_of(' ', at + 1);
      if (at == std::string::npos) return;
      levels_.push_back(at);
    }
  }

  void read_marks(const std::string& line, std::size_t begin) {
    char before = ' ';  // the last character that is no space
    for (std::size_t i = begin; i < line.size() && !mistake_; ++i) {
      const char c = line[i];
      const Origin place{source_, number_, static_cast<int>(i) + 1};
      if (quote_ != 0) {
        read_quoted(line, i);
        before = c;
        continue;
      }
      if (c == '#' && (i == 0 || line[i - 1] == ' ')) return;
      const bool begins_value = std::string(" :,[{-?").find(before) != std::string::npos;
      if ((c == '"' || c == '\'') && begins_value) {
        quote_ = c;
        quote_at_ = place;
      } else if ((c == '[' || c == '{') && (begins_value || !open_.empty())) {
        open_.push_back({c, place});
      } else if ((c == ']' || c == '}') && !open_.empty()) {
        if (open_.back().bracket != partner(c))
          mistake_.emplace(place, fmt::format("a '{}' closes the '{}'", c, open_.back().bracket),
                           "which stands at " + open_.back().where.text(),
                           fmt::format("write '{}'", partner(open_.back().bracket)));
        open_.pop_back();
      }
      if (c != ' ') before = c;
    }
  }

  /// Inside of quotation marks: leaves them at their end.
  void read_quoted(const std::string& line, std::size_t& i) {
    const bool is_escape = quote_ == '"' ? line[i] == '\\' : line.compare(i, 2, "''") == 0;
    if (is_escape)
      ++i;
    else if (line[i] == quote_) {
      if (quote_at_.line != number_ && line.find_first_not_of(" ,]}", i + 1) != std::string::npos)
        mistake_.emplace(quote_at_, fmt::format("the quotation mark {} is not closed on its line", quote_),
                         fmt::format("the next one, in line {}, ends the text that begins here", number_),
                         "close it, or remove it");
      quote_ = 0;
    }
  }

  std::string source_;
  int number_ = 0;
  char quote_ = 0;  ///< the mark of the text that is being read, or 0
  Origin quote_at_;
  std::vector<Open> open_;
  std::vector<std::size_t> levels_;        ///< of indentation, of the maps and lists that a line may belong to
  std::optional<std::size_t> block_text_;  ///< the indentation of the key of a block of text (| or >)
  std::optional<InputError> mistake_;
};

}  // namespace

std::optional<InputError> likely_mistake(const std::string& text, const std::string& source) {
  return Scan(text, source).mistake();
}

std::optional<InputError> unclosed_quote(const std::string& text, const std::string& source) {
  const Scan scan(text, source);
  return scan.ends_in_quotes() ? scan.mistake() : std::nullopt;
}

}  // namespace sprekk
