#include "framework/command_line/manual_page.hpp"

namespace sprekk {
namespace {

/// Text for roff, with what would be a request escaped: backslashes, and dots and quotes at the beginning of a line.
std::string plain(const std::string& text) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '\\') {
      result += "\\e";
    } else if (c == '-') {
      result += "\\-";
    } else if ((c == '.' || c == '\'') && (i == 0 || text[i - 1] == '\n')) {
      result += std::string("\\&") + c;
    } else {
      result += c;
    }
  }
  return result;
}

std::string bold(const std::string& text) { return "\\fB" + plain(text) + "\\fR"; }
std::string italic(const std::string& text) { return "\\fI" + plain(text) + "\\fR"; }

std::string sentence(std::string text) {
  if (!text.empty() && text.back() != '.') text += '.';
  return text;
}

/// The names and the value of an option: "-o, --output FOLDER".
std::string usage_of(const DeclaredOption& option) {
  std::string text;
  for (const std::string& name : option.names) text += (text.empty() ? "" : ", ") + bold(name);
  if (option.names.empty()) return italic(option.value);
  if (option.value.empty()) return text;
  return text + (option.is_value_optional ? " [" + italic(option.value) + "]" : " " + italic(option.value));
}

std::string paragraph(const std::string& head, const std::string& text) {
  return ".TP\n" + head + "\n" + plain(sentence(text)) + "\n";
}

std::string synopsis(const DeclaredCommand& command) {
  std::string line = bold("sprekk " + command.name), options;
  for (const DeclaredOption& option : command.options) {
    if (option.is_positional()) {
      line += " " + italic(option.value) + (option.is_list ? " ..." : "");
    } else if (!option.is_help()) {
      options = " [" + italic("options") + "]";
    }
  }
  return line + options + "\n";
}

}  // namespace

std::string manual_page(const DeclaredCommand& program, const std::string& summary, const std::string& version) {
  std::string page = ".TH SPREKK 1 \"\" \"Sprekk " + plain(version) + "\" \"User Commands\"\n" +
                     ".SH NAME\nsprekk \\- " + plain(summary) + "\n.SH SYNOPSIS\n.nf\n";
  for (const DeclaredCommand& command : program.commands) page += synopsis(command);
  page +=
      ".fi\n.SH DESCRIPTION\n" + plain(program.description) +
      "\nA scene, a YAML file, says what there is, which physics act, how they are coupled and how a step is solved.\n"
      ".SH OPTIONS\n";
  for (const DeclaredOption& option : program.options) page += paragraph(usage_of(option), option.description);
  page += ".SH COMMANDS\n";
  for (const DeclaredCommand& command : program.commands) {
    page += ".SS " + plain(command.name) + "\n" + plain(sentence(command.description)) + "\n";
    for (const DeclaredOption& option : command.options)
      if (!option.is_help()) page += paragraph(usage_of(option), option.description);
  }
  page += ".SH EXIT STATUS\n" + paragraph("0", "Done") + paragraph("1", "The run failed") +
          paragraph("2", "The input is wrong, and nothing has been done") +
          paragraph("3", "Runs are further apart than the tolerance of sprekk compare") +
          paragraph("130", "Interrupted; the run can go on with --restart");
  page += ".SH FILES\n" +
          paragraph(italic("results/<scene>"),
                    "The results of a run, if it does not say otherwise: tables (.csv), fields "
                    "(.pvd, .vtu), the record run.json and checkpoint.h5") +
          paragraph(italic("share/doc/sprekk/examples"), "Scenes to begin with, below the folder of the installation") +
          paragraph(italic("share/sprekk/scene.schema.json"), "The JSON schema of scenes, for editors");
  page += ".SH EXAMPLES\n.nf\n" + plain("sprekk run first_scene.yaml\n") +
          plain("sprekk run first_scene.yaml --set materials.friction=0.9 -o results/rough\n") +
          plain("sprekk report results/rough\n") + plain("sprekk compare results/first_scene results/rough\n") +
          plain("mpirun -n 2 sprekk run first_scene.yaml\n") + ".fi\n" + ".SH SEE ALSO\n.BR mpirun (1)\n";
  return page;
}

}  // namespace sprekk
