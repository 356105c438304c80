// Interpolates values of cells and outer faces to nodes, and between nodes (Eqs. 18, 19 of the paper).
#pragma once

#include <array>

#include "framework/mesh/mesh.hpp"
#include "framework/mesh/search/point_location.hpp"

namespace sprekk::couplers {

/// A piecewise linear field: linear in each triangle, and in either half of a quadrilateral. Nodes on a fracture, and
/// their values, exist on both sides of the fracture.
class NodalValues {
 public:
  /// How the value of a node is computed from values around it.
  enum class From {
    cells_and_faces,  ///< a linear fit to the cells, and faces with one cell, around the node (least squares, weights
                      ///< 1/distance^2): exact for linear fields
    cells,            ///< the same with cells alone; with fewer than three around a node, the least gradient that fits
    mean_of_cells  ///< the area-weighted mean of the cells (Eq. 17 of the paper): at a wall, its error is the gradient
                   ///< times the distance to the cell centres
  };
  /// Keeps a pointer to the mesh.
  NodalValues(const Mesh& mesh, From from);
  /// Sets the nodal values. `cells`: `components` values for each cell; `faces`: as many for each face, or empty.
  void set(int components, const Vector& cells, const Vector& faces);
  /// Sets `components` values for each node as they are.
  void set_nodes(int components, const Vector& nodes);
  /// A place in a cell: three nodes and their weights.
  struct Place {
    std::array<int, 3> nodes;
    std::array<double, 3> share;
  };
  Place place(int cell, const Point& x) const;
  /// One of the values at all nodes.
  Vector of_nodes(int component) const { return values_.col(component); }
  /// The values at a place; `components` as they were set.
  template <int components>
  Eigen::Vector<double, components> at(const Place& place) const {
    return place.share[0] * row<components>(place.nodes[0]) + place.share[1] * row<components>(place.nodes[1]) +
           place.share[2] * row<components>(place.nodes[2]);
  }
  template <int components>
  Eigen::Vector<double, components> at(int cell, const Point& x) const {
    return at<components>(place(cell, x));
  }

 private:
  template <int components>
  Eigen::Vector<double, components> row(int node) const {
    return values_.row(node).template head<components>();
  }

  const Mesh* mesh_;
  From from_;
  SparseMatrix from_cells_, from_faces_;  ///< nodes × entities
  Eigen::MatrixXd values_;                ///< nodes × components
};

}  // namespace sprekk::couplers
