#include "framework/command_line/graph_command.hpp"

#include <ostream>

namespace sprekk {

namespace {

/// Prints a step and what is inside it; returns its node's name.
std::string print_step(const ScheduleStep& step, std::ostream& out, int& count) {
  const std::string node = "step" + std::to_string(count++);
  out << "  " << node << " [shape=box, style=filled, fillcolor=\"#eeeeee\", label=\"" << step.describe() << "\"];\n";
  for (const ScheduleStep* child : step.children())
    out << "  " << node << " -> " << print_step(*child, out, count) << ";\n";
  return node;
}

}  // namespace

void print_graph(const Model& model, std::ostream& out) {
  out << "digraph \"" << model.scene().name << "\" {\n  rankdir=LR;\n  node [fontname=\"sans-serif\"];\n";
  for (const Scene::ComponentEntry& entry : model.scene().components) {
    std::string unknowns;
    for (const auto& field : model.fields().all())
      if (field->spec().owner == entry.name && field->spec().role == Role::unknown)
        unknowns += "\\n" + field->spec().name + " (" + std::to_string(field->size()) + ")";
    out << "  \"" << entry.name << "\" [label=\"" << entry.name << "\\n" << entry.type << unknowns << "\"];\n";
  }
  for (const Scene::CouplerEntry& entry : model.scene().couplers) {
    std::string determined;
    for (const auto& field : model.fields().all())
      if (field->determined_by() == entry.name) determined += "\\n" + field->name() + " (" + std::to_string(field->size()) + ")";
    out << "  \"" << entry.name << "\" [shape=diamond, label=\"" << entry.name << determined << "\"];\n";
    for (const std::string& component : entry.between)
      out << "  \"" << component << "\" -> \"" << entry.name << "\" [dir=none];\n";
  }
  int count = 0;
  print_step(model.schedule(), out, count);
  out << "}\n";
}

}  // namespace sprekk
