// graph: components, couplers and schedule as a picture.
#pragma once

#include <iosfwd>
#include <string>

#include "framework/scene/model.hpp"

namespace sprekk {

/// Writes the graph to a file: as .dot, or by Graphviz as .svg; without a name it prints the dot language. Throws
/// InputError for other file names, for files that cannot be written, and when Graphviz is needed but not installed.
void draw_graph(const Model& model, const std::string& file);

/// Writes the graph in the dot language: an ellipse for each component with its unknowns, a diamond for each coupler
/// with the inputs that it determines, boxes for the schedule.
void print_graph(const Model& model, std::ostream& out);

}  // namespace sprekk
