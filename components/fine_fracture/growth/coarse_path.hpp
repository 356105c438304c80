// What the coarse level takes over of the path of a tip.
#pragma once

#include <vector>

#include "framework/types.hpp"

namespace sprekk::fine_fracture {

/// What becomes of sharp bends between short edges: without one the mesh would have 2 % less of the path, or more, than
/// has parted. A path that ends at another fracture is to have no short edges there.
enum class SharpBends { stay, are_dropped };

/// The points (m) of a path from `start`, without those that would make an edge shorter than half of `coarse_size`, m
/// (sec. 4.4.2 of the paper). The end stays. A sharp bend stays where its edges are a tenth of `coarse_size` at least.
/// `added`: at least one point.
std::vector<Point> coarse_path(const Point& start, const std::vector<Point>& added, double coarse_size,
                               SharpBends bends);

}  // namespace sprekk::fine_fracture
