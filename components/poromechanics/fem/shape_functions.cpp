#include "components/poromechanics/fem/shape_functions.hpp"

#include <Eigen/LU>

#include "components/poromechanics/fem/reference_cell.hpp"
#include "framework/invariants.hpp"

namespace sprekk::poromechanics {

std::vector<CellPoint> cell_points(const Mesh& mesh, int cell, const std::vector<int>& tips, bool has_edges) {
  SPREKK_EXPECT(is_index(cell, mesh.cell_count()), cell, mesh.cell_count());
  const CellNodes& corners = mesh.cell_nodes[cell];
  const CellFaces& faces = mesh.cell_faces[cell];
  // How far the middle nodes of faces are from the middle, and the corner that rays of points start from.
  std::vector<Point> shift(faces.size(), Point::Zero());
  int start = 1;
  for (int k = 0; k < faces.size(); ++k) {
    const int tip = tips.empty() ? none : tips[faces[k]];
    if (tip == none) continue;
    const bool is_first = corners[k] == tip;
    const Point face = mesh.nodes[corners.after(k)] - mesh.nodes[corners[k]];
    shift[k] = (is_first ? -1 : 1) * face / 4;
    start = is_first ? k : (k + 1) % corners.size();
  }
  std::vector<CellPoint> points;
  for (const auto& [weight, functions] : reference_points(corners.size(), start, has_edges)) {
    const int count = static_cast<int>(functions.size());
    CellPoint point{Point::Zero(), 0, Eigen::VectorXd(count), CellPoint::Gradients(dimension, count)};
    Tensor jacobian = Tensor::Zero();  // d x / d reference
    for (int k = 0; k < corners.size(); ++k) {
      // Relative to a corner, so that coordinates far from the origin cost no digits.
      const Point arm = mesh.nodes[corners[k]] - mesh.nodes[corners[0]];
      Point of_corner = functions[k].value * arm;
      Tensor slope = arm * functions[k].slope.transpose();
      if (k < faces.size()) {
        const ReferenceFunction& of_face = functions[count - 1 - faces.size() + k];
        of_corner += of_face.value * shift[k];
        slope += shift[k] * of_face.slope.transpose();
      }
      point.x += of_corner;
      jacobian += slope;
    }
    point.x += mesh.nodes[corners[0]];
    const double stretch = jacobian.determinant();
    SPREKK_ASSERT(stretch > 0, cell, stretch);
    point.weight = weight * stretch;
    const Tensor turn = jacobian.inverse().transpose();
    for (int i = 0; i < count; ++i) {
      point.value[i] = functions[i].value;
      point.gradient.col(i) = turn * functions[i].slope;
    }
    points.push_back(std::move(point));
  }
  return points;
}

}  // namespace sprekk::poromechanics
