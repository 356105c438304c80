#include "components/poromechanics/fem/shape_functions.hpp"

#include <Eigen/LU>

#include "components/poromechanics/fem/middle_nodes.hpp"
#include "components/poromechanics/fem/reference_cell.hpp"
#include "framework/invariants.hpp"

namespace sprekk::poromechanics {

std::vector<CellPoint> cell_points(const Mesh& mesh, int cell, const std::vector<int>& tips, const CellEdges* edges) {
  SPREKK_EXPECT(is_index(cell, mesh.cell_count()), cell, mesh.cell_count());
  const CellNodes& corners = mesh.cell_nodes[cell];
  const CellFaces& faces = mesh.cell_faces[cell];
  const MiddleNodes middle = middle_nodes(mesh, cell, tips, edges);
  const bool has_edges = edges && edges->are_in(cell);
  std::vector<CellPoint> points;
  for (const auto& [weight, all_functions] : reference_points(corners.size(), middle.start, has_edges)) {
    std::vector<ReferenceFunction> functions = all_functions;
    for (int k = has_edges ? edges->of_cell[cell].size() - 1 : none; k >= 0; --k)
      if (edges->of_cell[cell][k] == none) functions.erase(functions.begin() + corners.size() + k);
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
        of_corner += of_face.value * middle.of_faces[k];
        slope += middle.of_faces[k] * of_face.slope.transpose();
      }
      point.x += of_corner;
      jacobian += slope;
    }
    for (std::size_t k = 0; has_edges && k < middle.of_edges.size(); ++k) {
      const ReferenceFunction& of_edge = all_functions[corners.size() + k];
      point.x += of_edge.value * middle.of_edges[k];
      jacobian += middle.of_edges[k] * of_edge.slope.transpose();
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
