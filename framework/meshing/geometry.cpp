#include "framework/meshing/geometry.hpp"

namespace sprekk {

double far_size(const Geometry& geometry, const MeshOptions& options) {
  constexpr double cells_across = 50;  // of the longer side: where a scene says nothing about sizes
  return options.size.value_or(geometry.box.size().maxCoeff() / cells_across);
}

double point_tolerance(const Box& box) {
  constexpr double same_point = 1e-9;  // of the diagonal: round-off of coordinates
  return same_point * box.size().norm();
}

}  // namespace sprekk
