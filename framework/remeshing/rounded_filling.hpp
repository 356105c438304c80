// Fills a cavity so that the topology does not depend on the last digits of its outline.
#pragma once

#include <optional>

#include "framework/remeshing/fill_cavity.hpp"

namespace sprekk {

/// As fill_cavity, but the triangulation is made for an outline on a coarse grid (rounded_points) in a frame with the
/// origin `anchor` (m, a place that stays from one cavity to the next), and then moved to the outline as given.
/// Outlines that differ by round-off give the same topology, and nodes are continuous. Nothing where the triangulation
/// for the grid is not found, or where moving it takes more than a third of its smallest angle.
std::optional<Triangulation> fill_rounded_cavity(const CavityOutline& outline, double size_factor, double growth,
                                                 const Point& anchor);

}  // namespace sprekk
