// `sprekk new KIND NAME`: a folder with a plug-in to start from.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace sprekk {

/// A file of the folder that `sprekk new` writes. In its name and text, __type__, __name__ and __Class__ stand for
/// "flow/my-part", "flow_my_part" and "FlowMyPart".
struct TemplateFile {
  std::string kind;  ///< "component"; "any": in folders of all kinds; "law.friction": laws of that kind
  std::string name, text;
};

/// The command `new` with its arguments.
class NewCommand {
 public:
  NewCommand(CLI::App& app, const std::vector<TemplateFile>& templates);
  bool is_called() const { return command_->parsed(); }
  /// Writes the folder and says what to do next. Throws InputError for a name that is no type, that exists, or whose
  /// folder exists.
  void run() const;

 private:
  /// Of what the templates are; of laws, after "law.".
  std::vector<std::string> kinds(const std::string& begin) const;

  CLI::App* command_;
  const std::vector<TemplateFile>& templates_;
  std::string kind_, type_, folder_, law_;
};

}  // namespace sprekk
