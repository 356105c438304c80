// Which cell holds a point.
#pragma once

#include <functional>
#include <string>

#include "framework/mesh/mesh.hpp"

namespace sprekk {

/// Finds the cell of a point, by a grid of buckets over the mesh. Keeps a pointer to the mesh, which must stay alive
/// and unchanged.
class PointLocation {
 public:
  explicit PointLocation(const Mesh& mesh);

  /// The cell that holds the point, or none outside of the mesh. A point on a face gives the adjacent cell with the
  /// smallest index; points outside by less than 1e-10 of the mesh's extent still count as inside.
  int cell_at(const Point& x) const;
  /// The same, faster where the guess (a cell, or none) is near the point: for a series of points close together.
  int cell_at(const Point& x, int guess) const;

 private:
  int bucket(int axis, double coordinate) const;
  int number(const std::array<int, dimension>& at) const;  ///< of the bucket with these numbers along the axes

  const Mesh* mesh_;
  Point low_;
  double width_ = 1;  ///< of a bucket, m
  std::array<int, dimension> counts_;
  Adjacency cells_;  ///< the cells whose bounding box meets a bucket, by the number of the bucket
  double slack_ = 0;
};

/// The index of a fracture, or none.
int find_fracture(const Mesh& mesh, const std::string& name);

/// The fracture cell that is nearest to a point, of those that count (all without `counts`). Of cells whose distances
/// differ by less than a millionth of their length, the first. none where no cell counts.
int nearest_fracture_cell(const Mesh& mesh, const Point& x, const std::function<bool(int cell)>& counts = {});

}  // namespace sprekk
