// A cavity as gmsh fills it.
#pragma once

#include <functional>

#include "framework/mesh/canonical_drawing.hpp"
#include "framework/mesh/fill_cavity.hpp"
#include "framework/mesh/triangulation.hpp"

namespace sprekk {

/// Points and triangles in the frame and with the numbers of `drawing`, in which `drawn` is the outline `given`.
/// `size`: wanted length of edges at a place of that frame. Throws std::runtime_error when gmsh fails.
Triangulation fill_with_gmsh(const CavityOutline& given, const CanonicalDrawing& drawing, const CavityOutline& drawn,
                             const std::function<double(const Point&)>& size);

}  // namespace sprekk
