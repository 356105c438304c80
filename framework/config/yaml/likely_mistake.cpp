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
    while (!levels_.empty() && levels_.back().indentation > first) {
      levels = fmt::format("{}{}{}", levels_.back().indentation, levels.empty() ? "" : " or ", levels);
      levels_.pop_back();
      is_less = true;
    }
    if (is_less && (levels_.empty() || levels_.back().indentation != first)) {
      if (!levels_.empty()) levels = fmt::format("{} or {}", levels_.back().indentation, levels);
      mistake_.emplace(place, fmt::format("the line is indented by {} {}", first, first == 1 ? "space" : "spaces"),
                       fmt::format("the lines above, to which it could belong, by {}", levels),
                       "indent it as those that it belongs to");
      return;
    }
    const bool is_item = line.compare(first, 2, "- ") == 0 || line.substr(first) == "-";
    if (levels_.empty() || levels_.back().indentation != first) levels_.push_back({first, is_item, place});
    if (levels_.back().is_list && !is_item) {
      mistake_.emplace(levels_.back().where, "'- ' begins a list",
                       fmt::format("line {}, as deep as it, has none: it is a key of a map", number_),
                       "write '- ' before all of them, or before none");
      return;
    }
    for (std::size_t at = first; line.compare(at, 2, "- ") == 0;) {  // what stands in an item is a level of its own
      at = line.find_first_not_of(' ', at + 1);
      if (at == std::string::npos) return;
      levels_.push_back({at, line.compare(at, 2, "- ") == 0, place});
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
  /// A map or list that a line may belong to.
  struct Level {
    std::size_t indentation;
    bool is_list;
    Origin where;
  };
  std::vector<Level> levels_;
  std::optional<std::size_t> block_text_;  ///< the indentation of the key of a block of text (| or >)
  std::optional<InputError> mistake_;
};

/// A line with its number, without what follows '#'.
struct Line {
  int number = 0;
  std::string text;
  std::size_t first() const { return text.find_first_not_of(' '); }
  bool is_blank() const { return first() == std::string::npos; }
  std::string words() const { return text.substr(first()); }
  /// Whether it has a key: "a: 1", "a:", "- a".
  bool has_key() const {
    const std::string word = words();
    return word.find(": ") != std::string::npos || word.back() == ':' || word.starts_with("- ") || word == "-";
  }
};

/// The last lines up to this number that are not blank, the lowest first.
std::vector<Line> lines_up_to(const std::string& text, int number) {
  std::vector<Line> lines;
  std::istringstream stream(text);
  Line line;
  while (line.number < number && std::getline(stream, line.text)) {
    ++line.number;
    line.text.erase(std::min(line.text.size(), line.text.find(" #")));
    line.text.erase(line.text.find_last_not_of(" \r") + 1);
    if (!line.is_blank() && line.text[line.first()] != '#') lines.insert(lines.begin(), line);
  }
  return lines;
}

/// What a line without a key was meant to be.
InputError lack_of_key(const Line& line, const std::string& source) {
  const std::string words = line.words();
  const auto with = [&](std::size_t at, std::size_t length, const char* sign) {
    std::string before = words.substr(0, at), after = words.substr(at + length);
    before.erase(before.find_last_not_of(' ') + 1);
    after.erase(0, std::min(after.size(), after.find_first_not_of(' ')));
    return "write '" + before + sign + after + "'";
  };
  const Origin where{source, line.number, static_cast<int>(line.first()) + 1};
  const std::string what = quoted(words) + " is no key with a value";
  if (words.starts_with("//") || words.starts_with("%") || words.starts_with(";"))
    return {where, what, "comments begin with '#'", "write '#'"};
  if (const std::size_t colon = words.find(':'); colon != std::string::npos)
    return {where, what, "no blank stands behind its ':'", with(colon, 1, ": ")};
  if (const std::size_t equals = words.find('='); equals != std::string::npos)
    return {where, what, "':' stands between the two, not '='", with(equals, 1, ": ")};
  return {where, what, "a line here has a ':' behind its key", "write 'KEY: VALUE', or '#' before a comment"};
}

}  // namespace

std::optional<InputError> mistake_above(const std::string& text, int line, const std::string& source) {
  const std::vector<Line> lines = lines_up_to(text, line);
  constexpr std::size_t most = 2;  // lines: the parser goes on to the next key before it refuses
  for (std::size_t i = 0; i < std::min(most, lines.size()); ++i)
    if (!lines[i].has_key()) return lack_of_key(lines[i], source);
  if (lines.size() < 2 || lines[0].first() <= lines[1].first() || lines[1].text.back() == ':') return std::nullopt;
  return InputError({source, lines[0].number, static_cast<int>(lines[0].first()) + 1},
                    fmt::format("the line is indented by {} spaces", lines[0].first()),
                    fmt::format("the line above it, by {}, has its value already", lines[1].first()),
                    "indent both alike, or move one of them");
}

std::optional<InputError> likely_mistake(const std::string& text, const std::string& source) {
  return Scan(text, source).mistake();
}

std::optional<InputError> unclosed_quote(const std::string& text, const std::string& source) {
  const Scan scan(text, source);
  return scan.ends_in_quotes() ? scan.mistake() : std::nullopt;
}

}  // namespace sprekk
