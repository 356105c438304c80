// The outer edges of a mesh, and where they do not bound what the cells fill.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "framework/mesh/face_table.hpp"
#include "framework/mesh/plane/planar.hpp"
#include "framework/mesh/search/plane/segment_tree.hpp"

namespace sprekk {

/// The edges with one cell, and the loops that they form. Keeps references to nodes and edges.
class OuterBoundary {
 public:
  /// A closed path of outer edges, with the cells on its left.
  struct Loop {
    std::vector<int> edges;
    bool is_hole;  ///< it runs clockwise, around what no cell covers
  };
  /// Where two parts of the boundary come together without common nodes.
  struct Contact {
    /// What meets there.
    enum class Kind {
      side_on_side,  ///< two edges have the same ends, but not the same nodes
      node_on_edge,  ///< a node lies on the inside of an edge
      gap,           ///< a gap far narrower than its edges
      overlap        ///< cells lie on other cells
    };
    Kind kind;
    Point at;
    double width = 0;  ///< m, of a gap
  };

  OuterBoundary(const std::vector<Point>& nodes, const std::vector<Ring>& cells, const FaceTable& edges);

  /// Empty where the boundary touches itself in a node: there it forms no loops.
  std::vector<Loop> loops() const;
  /// All contacts. Without any, the cells cover their part of the plane once.
  std::vector<Contact> contacts() const;
  /// The other outer edge with the same ends, from the last to the first, and with its own nodes; none if there is
  /// none.
  int twin(int edge) const;
  /// The point between the ends of an edge.
  Point middle(int edge) const;

 private:
  bool are_one_place(int node, int other) const { return (nodes_[node] - nodes_[other]).norm() <= round_off_; }
  bool share_a_node(int edge, int other) const;
  std::optional<Contact> contact_of(int node, double shortest, int edge) const;
  int cover(const Point& x) const;

  const std::vector<Point>& nodes_;
  const std::vector<Ring>& cells_;
  const FaceTable& edges_;
  std::vector<int> outer_;         ///< edges
  std::vector<Segment> segments_;  ///< of outer_
  double extent_ = 0, round_off_ = 0;
  SegmentTree tree_;
};

}  // namespace sprekk
