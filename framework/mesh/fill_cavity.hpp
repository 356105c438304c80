// New triangles for a part of the plane whose boundary edges are given.
#pragma once

#include <array>
#include <vector>

#include "framework/mesh/triangulation.hpp"
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

/// Triangles with edge lengths that go from those of the inner edges to those of the rim, growing by `growth` m a metre
/// where the rim allows; inside, they are `size` times that. The points of the outline come first. Throws
/// std::runtime_error when this fails.
Triangulation fill_cavity(const CavityOutline& outline, double size, double growth);

}  // namespace sprekk
