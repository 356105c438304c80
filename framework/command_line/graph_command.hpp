// graph: components, couplers and schedule as a picture.
#pragma once

#include <iosfwd>

#include "framework/scene/model.hpp"

namespace sprekk {

/// Writes the graph in the dot language: an ellipse a component with its unknowns, a diamond a coupler with the inputs
/// that it determines, boxes for the schedule.
void print_graph(const Model& model, std::ostream& out);

}  // namespace sprekk
