// The known name that is nearest to a misspelt one.
#include <algorithm>
#include <cctype>

#include "framework/config/input_error.hpp"
#include "framework/config/unknown_key.hpp"

namespace sprekk {
namespace {

constexpr std::size_t longest_word = 64;  // characters: no name is longer

std::string lower_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

/// Insertions, deletions, substitutions and swaps of neighbours (optimal string alignment distance).
int edit_distance(const std::string& a, const std::string& b) {
  std::vector<int> before_previous, previous(b.size() + 1), current(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) previous[j] = static_cast<int>(j);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    current[0] = static_cast<int>(i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const int substitution = previous[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      current[j] = std::min({previous[j] + 1, current[j - 1] + 1, substitution});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) current[j] = std::min(current[j], before_previous[j - 2] + 1);
    }
    before_previous = previous;
    std::swap(previous, current);
  }
  return previous[b.size()];
}

std::string only_name_that_begins_with(const std::string& word, const std::vector<std::string>& names) {
  std::string result;
  for (const std::string& name : names) {
    if (lower_case(name).rfind(word, 0) != 0) continue;
    if (!result.empty()) return "";
    result = name;
  }
  return result;
}

/// The names of which the word is a part, or which are a part of it: "water_density" for "density". None if there are
/// many.
std::vector<std::string> names_with_part(const std::string& word, const std::vector<std::string>& names) {
  constexpr std::size_t shortest = 3, most = 3;  // letters: shorter parts are in everything
  const auto has_part = [](const std::string& whole, const std::string& part) {
    const auto ends = [&whole](std::size_t at) { return at == whole.size() || whole[at] == '_' || whole[at] == '/'; };
    for (std::size_t at = whole.find(part); at != std::string::npos; at = whole.find(part, at + 1))
      if ((at == 0 || ends(at - 1)) && ends(at + part.size())) return true;
    return false;
  };
  std::vector<std::string> found;
  const std::string lower_word = lower_case(word);
  for (const std::string& name : names) {
    const std::string lower_name = lower_case(name);
    if (std::min(word.size(), name.size()) >= shortest &&
        (has_part(lower_name, lower_word) || has_part(lower_word, lower_name)))
      found.push_back(name);
  }
  return found.size() <= most ? found : std::vector<std::string>();
}

}  // namespace

std::string nearest_name(const std::string& word, const std::vector<std::string>& names) {
  if (word.empty() || word.size() > longest_word) return "";
  const std::string lower_word = lower_case(word);
  std::string nearest;
  int nearest_distance = 0, nearest_exact_distance = 0;
  for (const std::string& name : names) {
    if (name.size() > longest_word) continue;
    const int distance = edit_distance(lower_word, lower_case(name));
    const int exact_distance = edit_distance(word, name);  // decides between "mPa" and "MPa"
    const bool nearer =
        distance < nearest_distance || (distance == nearest_distance && exact_distance < nearest_exact_distance);
    if (nearest.empty() || nearer) {
      nearest = name;
      nearest_distance = distance;
      nearest_exact_distance = exact_distance;
    }
  }
  // A third of the letters may be wrong, at most three: in shorter words everything resembles everything.
  constexpr int most_slips = 3, letters_for_one = 3;
  const int tolerated = std::min(most_slips, static_cast<int>(std::max(word.size(), nearest.size())) / letters_for_one);
  if (!nearest.empty() && nearest_distance <= tolerated) return nearest;
  return word.size() >= 3 ? only_name_that_begins_with(lower_word, names) : "";
}

InputError unknown_name(const Origin& where, const std::string& what, const std::string& word,
                        const std::vector<std::string>& allowed) {
  const std::string why = allowed.empty() ? "there is none" : "it is not one of: " + listed(allowed);
  return InputError(where, "unknown " + what + " " + quoted(word), why, name_advice(word, allowed, ""));
}

std::string name_advice(const std::string& word, const std::vector<std::string>& known, const std::string& belongs) {
  std::vector<std::string> meant;
  if (const std::string nearest = nearest_name(word, known); !nearest.empty())
    meant.push_back(nearest);
  else
    meant = names_with_part(word, known);
  std::string text;
  for (std::size_t i = 0; i < meant.size(); ++i)
    text += (i == 0 ? "did you mean " : i + 1 == meant.size() ? " or " : ", ") + sprekk::quoted(meant[i]);
  if (!meant.empty()) text += "?";
  return text + (text.empty() || belongs.empty() ? "" : " ") + belongs;
}

}  // namespace sprekk
