// How random fractures lie, and what keeps them apart.
#pragma once

#include <functional>
#include <vector>

#include "framework/meshing/geometry.hpp"
#include "framework/meshing/random/random_laws.hpp"

namespace sprekk {

struct RandomFractures;

/// The points of a fracture in a random direction, from its middle, m: in a plane a line; in space a square of this
/// edge length, two edges of which are horizontal.
std::vector<Point> points_around_middle(const RandomFractures& set, double length, RandomNumbers& directions);

/// Tells of the points of one fracture after the other whether it keeps away from the sides of the box, the fractures
/// and regions of the geometry as it is now, and those that it has said yes to.
std::function<bool(const std::vector<Point>&)> placer(const Geometry& geometry, const RandomFractures& set);

}  // namespace sprekk
