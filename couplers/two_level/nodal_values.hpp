// From values of cells and outer faces to values of nodes, and between nodes (Eqs. 18, 19 of the paper).
#pragma once

#include <array>

#include "framework/mesh/mesh.hpp"
#include "framework/mesh/point_location.hpp"

namespace sprekk::couplers {

/// Linear in each triangle between its nodes, and in either half of a quadrilateral. Nodes on a fracture exist on both
/// of its sides, and so do their values.
class NodalValues {
 public:
  enum class From {
    cells_and_faces,  ///< the linear function that fits the cells and the faces with one cell around the node (least
                      ///< squares, weights 1/distance^2): exact for linear fields
    cells,            ///< the same of the cells alone; with less than three around a node, the least gradient that fits
    mean_of_cells  ///< the area-weighted mean of the cells (Eq. 17 of the paper): off by the strain times the distance
                   ///< at a wall
  };
  /// Keeps a pointer to the mesh.
  NodalValues(const Mesh& mesh, From from);
  /// `cells`: `components` values a cell; `faces`: as many a face, or empty.
  void set(int components, const Vector& cells, const Vector& faces);
  /// A place in a cell.
  struct Place {
    std::array<int, 3> nodes;
    std::array<double, 3> share;
  };
  Place place(int cell, const Point& x) const;
  /// The values there; `components` is what was set.
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
