#include "framework/command_line/new_command.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iostream>

#include "framework/scene/law_kinds.hpp"
#include "framework/scene/registry.hpp"

namespace sprekk {

namespace {

constexpr const char *of_any_kind = "any", *of_law = "law.";

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool is_of_word(char c) { return is_letter(c) || (c >= '0' && c <= '9') || c == '_'; }

/// Throws InputError unless the parts between '/' are names in C++, and for a name that exists. Only components have a
/// '/'.
void check_type(const std::string& type, const std::string& kind) {
  bool begins = true, is_fine = !type.empty();
  for (const char c : type) {
    is_fine = is_fine && (begins ? is_letter(c) : is_of_word(c) || c == '/');
    begins = c == '/';
  }
  if (!is_fine || begins)
    throw InputError({"sprekk new"}, quoted(type) + " is no name of a type",
                     "it is made of letters, digits and '_', begins with a letter, and may have a role before '/'",
                     "write for example my_part, or heat_flow/my_part");
  if (kind != "component" && type.find('/') != std::string::npos)
    throw InputError({"sprekk new"}, "the name " + quoted(type) + " of a " + kind + " has a '/'",
                     "only types of components have a role before '/'",
                     "write for example " + type.substr(type.rfind('/') + 1));
  const auto is_this = [&](const auto& known) { return known.type == type; };
  const Registry& registry = Registry::instance();
  if (std::any_of(registry.components().begin(), registry.components().end(), is_this) ||
      std::any_of(registry.couplers().begin(), registry.couplers().end(), is_this))
    throw InputError({"sprekk new"}, "the type " + quoted(type) + " exists", "", "choose another name");
  if (kind != "law") return;
  for (const LawKind& laws : law_kinds())
    for (const auto& [name, doc] : laws.laws())
      if (name == type)
        throw InputError({"sprekk new"}, "a law of " + laws.name + " is called " + quoted(type), "",
                         "choose another name");
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + by.size()))
    text.replace(at, what.size(), by);
  return text;
}

}  // namespace

NewCommand::NewCommand(CLI::App& app, const std::vector<TemplateFile>& templates)
    : command_(app.add_subcommand("new",
                                  "Writes a folder with a component, a coupler, a law, an accelerator or an output to "
                                  "start from, outside of this tree")),
      templates_(templates) {
  command_->add_option("kind", kind_, "What it is")->required()->check(CLI::IsMember(kinds("")));
  command_->add_option("name", type_, "The name of its type, for example my_part or heat_flow/my_part")
      ->required()
      ->type_name("NAME");
  command_->add_option("--kind", law_, "Of a law, and needed there: what it is for")
      ->check(CLI::IsMember(kinds(of_law)));
  command_->add_option("-o,--output", folder_, "The folder; one of that name here by default")->type_name("FOLDER");
}

std::vector<std::string> NewCommand::kinds(const std::string& begin) const {
  std::vector<std::string> kinds;
  for (const TemplateFile& file : templates_) {
    if (file.kind == of_any_kind || !file.kind.starts_with(begin)) continue;
    const std::string rest = file.kind.substr(begin.size()), kind = rest.substr(0, rest.find('.'));
    if (std::ranges::find(kinds, kind) == kinds.end()) kinds.push_back(kind);
  }
  return kinds;
}

void NewCommand::run() const {
  namespace fs = std::filesystem;
  check_type(type_, kind_);
  if (kind_ != "law" && command_->count("--kind") > 0)
    throw InputError({"sprekk new"}, "'--kind' has no effect", "it says what a law is for", "remove it");
  if (kind_ == "law" && law_.empty())
    throw InputError({"sprekk new"}, "'--kind' is missing", "there are laws of " + listed(kinds(of_law)),
                     "write for example: sprekk new law " + type_ + " --kind " + kinds(of_law).back());
  const std::string kind = kind_ == "law" ? of_law + law_ : kind_;
  const std::string name = replaced(type_, "/", "_");
  std::string class_name;
  bool begins = true;
  for (const char c : name) {
    if (c != '_') class_name += begins ? static_cast<char>(std::toupper(static_cast<unsigned char>(c))) : c;
    begins = c == '_';
  }
  const fs::path folder = folder_.empty() ? name : folder_;
  if (fs::exists(folder) && !(fs::is_directory(folder) && fs::is_empty(folder)))
    throw InputError({"sprekk new"}, "'" + folder.string() + "' exists", "nothing is overwritten",
                     "choose another folder by -o");
  const auto filled = [&](std::string text) {
    for (const auto& [what, by] : {std::pair{"__type__", type_}, {"__name__", name}, {"__Class__", class_name}})
      text = replaced(std::move(text), what, by);
    return text;
  };
  fs::create_directories(folder);
  for (const TemplateFile& file : templates_) {
    if (file.kind != kind && file.kind != of_any_kind) continue;
    std::ofstream out(folder / filled(file.name));
    out << filled(file.text);
    if (!out.flush()) throw std::runtime_error("cannot write " + (folder / filled(file.name)).string());
  }
  std::cout << "wrote " << folder.string() << "; its README.md says how it is built, tested and run\n";
}

}  // namespace sprekk
