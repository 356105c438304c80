// Points of the rock whose displacement is given.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "framework/config/spec.hpp"
#include "framework/mesh/mesh.hpp"

namespace sprekk::poromechanics {

/// A point whose displacement is given in some directions of space.
struct PinnedPoint {
  Origin origin;
  std::optional<Point> at;                                        ///< m
  std::array<std::optional<Data>, dimension> displacement_along;  ///< m
  Spec spec();
};
using PinnedPoints = std::map<std::string, PinnedPoint>;  ///< by name

/// Parameters by name.
void add_pinned_points(Spec& spec, PinnedPoints& points);

/// The node of a mesh that is nearest to a pinned point. Throws InputError where the point lies outside of the rock,
/// and where it lies on the wall of a fracture, which has a node on each side.
int pinned_node(const PinnedPoint& point, const std::string& name, const Mesh& mesh);

}  // namespace sprekk::poromechanics
