// Commands that start runs elsewhere: `srun -n 1`, `ssh node2 {command}`.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "framework/config/input_error.hpp"

namespace sprekk {

/// A command that is put before that of a run, or a template in which `{command}` stands for the command of the run:
/// one word, quoted for a shell, with the folder to work in and the settings of the environment.
class Launcher {
 public:
  /// `text`: words between blanks; quotes keep a word together. Throws InputError for an empty text, and for a quote
  /// that does not end.
  Launcher(const std::string& text, const Origin& origin);

  /// The words to start: the program is looked for along the path. `environment`: what a template is to set.
  std::vector<std::string> words(const std::vector<std::string>& command,
                                 const std::map<std::string, std::string>& environment) const;
  const std::string& text() const { return text_; }

 private:
  std::string text_;
  std::vector<std::string> words_;
};

}  // namespace sprekk
