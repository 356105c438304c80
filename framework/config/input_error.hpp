// Mistakes in the input, as opposed to failures of a run or of the program.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace sprekk {

/// Where a piece of input stands. `line` and `column` count from 1; 0 when the source has none (`--set`).
struct Origin {
  std::string source;  ///< a file's name as the user gave it, or "--set"
  int line = 0;
  int column = 0;
  std::string text() const;  ///< "scene.yaml:12:5", without the parts that are unknown
};

/// Wrong input. The command line answers with exit code 2 and writes nothing.
/// Message grammar: problem (why) suggestion.
class InputError : public std::runtime_error {
 public:
  InputError(const Origin& where, const std::string& problem, const std::string& why = "",
             const std::string& suggestion = "");
  explicit InputError(const std::string& message);
  /// Several mistakes, reported together: what() has one a line, the first ten of them.
  explicit InputError(const std::vector<std::string>& problems);
  const std::vector<std::string>& problems() const { return problems_; }

 private:
  std::vector<std::string> problems_;
};

/// The user's text in single quotes, on one line, shortened when it is very long.
std::string quoted(const std::string& text);

/// "a, b, c", shortened when there are very many.
std::string listed(const std::vector<std::string>& names);

/// The name nearest to `word` by edit distance, or the only name that begins with `word`, or "" when no name is near
/// enough to be meant. Upper and lower case count as nearly the same.
std::string nearest_name(const std::string& word, const std::vector<std::string>& names);

/// "unknown X 'wrod' (it is not one of: a, b, word) did you mean 'word'?" for any kind of name.
InputError unknown_name(const Origin& where, const std::string& what, const std::string& word,
                        const std::vector<std::string>& allowed);

}  // namespace sprekk
