// graph: components, couplers and schedule as a picture.
#pragma once

#include <iosfwd>
#include <string>

#include "framework/scene/model.hpp"

namespace sprekk {

/// Draws the graph into a file, .dot, or .svg by Graphviz; without a name it prints the dot language. Throws InputError
/// for other names, for files that cannot be written, and when Graphviz is needed and not there.
void draw_graph(const Model& model, const std::string& file);

/// Writes the graph in the dot language: an ellipse a component with its unknowns, a diamond a coupler with the inputs
/// that it determines, boxes for the schedule.
void print_graph(const Model& model, std::ostream& out);

}  // namespace sprekk
