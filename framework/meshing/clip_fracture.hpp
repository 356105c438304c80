// Cuts off what lies outside the box.
#pragma once

#include <vector>

#include "framework/meshing/geometry.hpp"

namespace sprekk {

/// The parts of a polyline that lie in the box: none, itself where it lies inside, or its parts, from the first point
/// on. Several are called NAME_1, NAME_2, …. Parts shorter than point_tolerance and those along a side are left out.
/// In a plane.
std::vector<FractureGeometry> clipped(const FractureGeometry& fracture, const Box& box);

}  // namespace sprekk
