// The cells of fractures behind their fronts.
#pragma once

#include <limits>
#include <vector>

#include "framework/mesh/space/fronts.hpp"

namespace sprekk::fine_fracture {

/// A piece of a front without corners.
struct FrontPiece {
  int fracture;
  bool is_closed;
  std::vector<int> ridges;
  std::vector<RimEdge> edges;
  std::vector<double> arc;   ///< m, at the nodes, one more than edges: along the front, of which this is a piece
  std::vector<Point> ahead;  ///< unit, at the nodes: the mean of those of the edges there

  int count() const { return static_cast<int>(edges.size()); }
  double length(int edge) const { return arc[edge + 1] - arc[edge]; }
  double length() const { return arc.back() - arc.front(); }
  /// m, along the piece from one arc length to another, with its sign; around a closed piece the shorter way.
  double way(double from, double to) const;
  /// The edge that is `further` edges along from this one (back if negative); none beyond the ends.
  int edge_at(int edge, int further) const;
};

/// The pieces of all fronts. They end at corners of more than 45 degrees, near which jumps are not proportional to the
/// square root of the distance.
std::vector<FrontPiece> pieces_of_fronts(const Mesh& mesh);

/// A fracture cell as seen from the front that is nearest.
struct CellBehind {
  /// none where the way to any front leads across a junction, or two pieces are equally near: on a diagonal of equal
  /// cells, where round-off would choose.
  int piece = none;
  int edge = 0;                                               ///< of the piece, the nearest
  double distance = std::numeric_limits<double>::infinity();  ///< m, of the centre of the cell
  bool is_between = false;                                    ///< whether another piece is as near
  double arc = 0;                                             ///< m, of the nearest place on the front
  /// As those of a RimEdge, at this place. They turn evenly along the front: with those of single edges, which stand
  /// askew to the front by up to half of its bends, part of K_III would count as K_II.
  Tensor axes = Tensor::Zero();
};

/// One for each fracture cell.
std::vector<CellBehind> cells_behind(const Mesh& mesh, const std::vector<FrontPiece>& pieces);

/// Distances (m) from its piece to points of quadrature in the cell, which have equal weights.
std::vector<double> distances_in_cell(const Mesh& mesh, const FrontPiece& piece, const CellBehind& seen, int cell);

/// m: how far the fracture cell at an edge reaches behind it.
double depth_behind(const Mesh& mesh, const RimEdge& edge);

/// What is on the line behind the middle of an edge, across the front.
struct WayBehind {
  double length;   ///< m, to the next end, junction or side; infinite where there is none
  bool is_to_tip;  ///< whether a front is there
};
WayBehind way_behind(const Mesh& mesh, int fracture, int ridge, const RimEdge& edge);

}  // namespace sprekk::fine_fracture
