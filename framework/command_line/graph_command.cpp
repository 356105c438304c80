#include "framework/command_line/graph_command.hpp"

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>

#include "framework/config/input_error.hpp"
#include "framework/parallel/parallel.hpp"

namespace sprekk {

namespace {

/// Prints a step and what is inside it; returns its node's name.
std::string print_step(const ScheduleStep& step, std::ostream& out, int& count) {
  const std::string node = "step" + std::to_string(count++);
  out << "  " << node << " [shape=box, style=filled, fillcolor=\"#eeeeee\", label=\"" << step.describe() << "\"];\n";
  for (const ScheduleStep* child : step.children()) {
    const std::string inner = print_step(*child, out, count);
    out << "  " << node << " -> " << inner << ";\n";
  }
  return node;
}

/// Lets Graphviz draw; the text goes through a temporary file next to the picture.
void draw_svg(const std::string& text, const std::string& file) {
  const std::string source = file + ".dot";
  std::ofstream out(source);
  if (!(out << text << std::flush))
    throw InputError({"-o"}, "the file " + quoted(file) + " cannot be written", std::strerror(errno),
                     "choose another one");
  const std::string target = "-o" + file;
  const char* const arguments[] = {"dot", "-Tsvg", target.c_str(), source.c_str(), nullptr};
  pid_t process = 0;
  int status = 0;
  const int failure = posix_spawnp(&process, "dot", nullptr, nullptr, const_cast<char* const*>(arguments), environ);
  if (failure == 0) waitpid(process, &status, 0);
  std::remove(source.c_str());
  if (failure != 0)
    throw InputError({"-o"}, "Graphviz cannot be started", std::string("its program dot: ") + std::strerror(failure),
                     "install graphviz, or write a .dot file");
  if (status != 0) throw InputError({"-o"}, "Graphviz did not draw " + quoted(file), "", "write a .dot file instead");
}

}  // namespace

void print_graph(const Model& model, std::ostream& out) {
  out << "digraph \"" << model.scene().name << "\" {\n  rankdir=LR;\n  node [fontname=\"sans-serif\"];\n";
  for (const Scene::ComponentEntry& entry : model.scene().components) {
    std::string unknowns;
    for (const auto& field : model.fields().all())
      if (field->spec().owner == entry.name && field->spec().role.is_unknown())
        unknowns += "\\n" + field->spec().name + " (" + std::to_string(field->size()) + ")";
    out << "  \"" << entry.name << "\" [label=\"" << entry.name << "\\n" << entry.type << unknowns << "\"];\n";
  }
  for (const Scene::CouplerEntry& entry : model.scene().couplers) {
    std::string determined;
    for (const auto& field : model.fields().all())
      if (field->determined_by() == entry.name)
        determined += "\\n" + field->name() + " (" + std::to_string(field->size()) + ")";
    out << "  \"" << entry.name << "\" [shape=diamond, label=\"" << entry.name << determined << "\"];\n";
    for (const std::string& component : entry.between)
      out << "  \"" << component << "\" -> \"" << entry.name << "\" [dir=none];\n";
  }
  int count = 0;
  print_step(model.schedule(), out, count);
  out << "}\n";
}

void draw_graph(const Model& model, const std::string& file) {
  if (!parallel::is_root()) return;
  if (file.empty()) return print_graph(model, std::cout);
  const std::string kind = std::filesystem::path(file).extension().string();
  if (kind != ".dot" && kind != ".svg")
    throw InputError({"-o"}, "the picture " + quoted(file) + " has no known kind", "it is known by its ending",
                     "end it with .dot or .svg");
  std::ostringstream text;
  print_graph(model, text);
  if (kind == ".dot") {
    std::ofstream out(file);
    if (!(out << text.str() << std::flush))
      throw InputError({"-o"}, "the file " + quoted(file) + " cannot be written", std::strerror(errno),
                       "choose another one");
    return;
  }
  draw_svg(text.str(), file);
}

}  // namespace sprekk
