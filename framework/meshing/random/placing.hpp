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

/// A function that decides on one fracture after the other, by its points (m): whether it keeps the distances and
/// angles of the set from the sides of the box, from the fractures and regions that the geometry has now, and from
/// those that were accepted before.
std::function<bool(const std::vector<Point>&)> placer(const Geometry& geometry, const RandomFractures& set);

}  // namespace sprekk
