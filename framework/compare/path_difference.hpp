// How far fractures of two runs have taken different ways.
#pragma once

#include <vector>

#include "framework/results/cell_sampler.hpp"

namespace sprekk {

/// The line of a fracture, in pieces.
struct Polyline {
  std::vector<std::array<Position, 2>> segments;
  double length() const;  ///< m
};

/// The lines of all fractures at one time, by their number: the cells on them, and the paths that the mesh does not
/// have yet. Either grid may be without cells.
std::vector<Polyline> polylines(const Grid& fractures, const Grid& paths);

/// The distance of two lines. Each point of one line has a distance from the other line; the largest is not the same
/// both ways.
struct PathDifference {
  int fracture = 0;            ///< its number
  double there = 0, back = 0;  ///< m: largest distance of points of the first line from the other one, and back
  double sideways = 0;         ///< m: the larger of both, without parts beyond an end of the other line
  double length = 0;           ///< m: of the first line less that of the other one
  Position where{};            ///< m, where the larger of `there` and `back` is
  double scale = 0;            ///< m: the length of the longer line
  double largest() const { return there > back ? there : back; }
};
PathDifference path_difference(const Polyline& one, const Polyline& other);

}  // namespace sprekk
