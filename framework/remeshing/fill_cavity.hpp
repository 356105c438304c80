// New triangles for a part of the plane whose boundary edges are given.
#pragma once

#include <array>
#include <vector>

#include "framework/triangulation/triangulation.hpp"
#include "framework/types.hpp"

namespace sprekk {

/// What a filling must keep: all of the edges.
struct CavityOutline {
  struct Edge {
    std::array<int, 2> points;
    enum class Place { rim, inside } place;  ///< rim edges run counter-clockwise: the cavity is to their left
    bool is_barrier;                         ///< the outer boundary or a fracture
  };
  std::vector<Point> points;  ///< m, each at one edge at least; no two rim edges leave the same point
  std::vector<Edge> edges;
};

/// Triangles with edge lengths that go from those of the inner edges towards those of the rim, growing by `growth` m a
/// metre, or up to 0.4 where the rim is near. `size_factor` makes all but the given edges so many times as long. The
/// points of the outline come first. Throws std::runtime_error when this fails.
Triangulation fill_cavity(const CavityOutline& outline, double size_factor, double growth);

}  // namespace sprekk
