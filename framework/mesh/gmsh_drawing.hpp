// A drawing handed over to gmsh. For implementation files that work with gmsh.
#pragma once

#include <vector>

#include "framework/mesh/canonical_drawing.hpp"

namespace sprekk {

/// Enters points and straight lines into the current gmsh model; the tag of number i of the drawing is i + 1.
void enter_drawing(const CanonicalDrawing& drawing);

/// The plane surface inside of the first loop and outside of the others, with given lines embedded in it; also
/// synchronizes the model. Each loop's lines follow one another.
void add_surface(const CanonicalDrawing& drawing, const std::vector<std::vector<int>>& loops,
                 const std::vector<int>& embedded);

}  // namespace sprekk
