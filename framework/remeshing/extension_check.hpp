// Checks of the paths along which fractures are to grow.
#pragma once

#include <vector>

#include "framework/mesh/mesh.hpp"
#include "framework/remeshing/path_extension.hpp"

namespace sprekk {

/// The least distance between a path and anything else, in edge lengths: a cell must fit in between. From itself, and
/// from its own fracture, a path keeps this distance or a quarter of the length along the fracture in between,
/// whichever is less.
inline constexpr double least_gap = 0.5;
/// An end nearer than this to the outer boundary, in edge lengths, is moved onto the boundary.
inline constexpr double boundary_snap = 0.01;
/// An end nearer than this to a ridge of another fracture, in edge lengths, is moved to that point.
inline constexpr double joint_snap = 0.01;
/// A path that meets the outer boundary or another fracture at less than this angle passes too near to it, rad (15
/// degrees): the cells between both have this angle.
inline constexpr double least_incidence = 0.2617993877991494;

/// Throws ExtensionError for the first extension that cannot be made with edges of this size (m). Near a fracture or
/// boundary that is nearer to the old tip than the least gap, a path may pass at nine tenths of the distance of the
/// tip, and may leave it at 15 degrees or more. Cells that are replaced count as healed (heal_ends). Returns the
/// extensions; ends near the outer boundary, or near a ridge of another fracture inside of the rock, are moved
/// onto it.
std::vector<PathExtension> check_extensions(const Mesh& mesh, const std::vector<PathExtension>& extensions,
                                            double size);

/// Whether a straight step of a path, from `from` to `to`, comes so near to the outer boundary or to another fracture
/// that check_extensions would soon refuse the path. That is nearer than 1.5 times the least gap, and nearer than 0.95
/// times the distance of the beginning of the path (check_extensions allows 0.9). `beginning`: the old tip; `size` (m)
/// as in check_extensions.
bool comes_too_near(const Mesh& mesh, int fracture, const Point& beginning, const Point& from, const Point& to,
                    double size);

}  // namespace sprekk
