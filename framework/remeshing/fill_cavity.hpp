// Fills a part of the plane with given boundary edges with triangles.
#pragma once

#include <array>
#include <vector>

#include "framework/triangulation/triangulation.hpp"
#include "framework/types.hpp"

namespace sprekk {

/// The edges of a cavity, on its rim and inside. The triangles that fill it have all of them as edges.
struct CavityOutline {
  /// An edge between two points of the outline.
  struct Edge {
    std::array<int, 2> points;
    /// Rim edges run counter-clockwise: the cavity is to their left.
    enum class Place { rim, inside } place;
    bool is_barrier;  ///< whether the edge belongs to the outer boundary or to a fracture
  };
  std::vector<Point> points;  ///< m, each at one or more edges; no two rim edges start at the same point
  std::vector<Edge> edges;
};

/// The points of each edge.
std::vector<std::array<int, 2>> lines_of(const CavityOutline& outline);

/// Triangles whose edge lengths change from those of the inner edges to those of the rim, by `growth` m per m, or up to
/// 0.4 m per m where the rim is near. `size_factor` scales the lengths of all but the given edges. The points of the
/// outline come first. Throws std::runtime_error when no triangulation is found.
Triangulation fill_cavity(const CavityOutline& outline, double size_factor, double growth);

}  // namespace sprekk
