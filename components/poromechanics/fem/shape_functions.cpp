#include "components/poromechanics/fem/shape_functions.hpp"

#include <Eigen/LU>

#include "components/poromechanics/fem/gauss_points.hpp"
#include "framework/invariants.hpp"

namespace sprekk::poromechanics {

namespace {

/// A function of the two coordinates of a reference cell, with its derivatives.
struct Reference {
  double value;
  Point slope;

  friend Reference operator*(const Reference& a, const Reference& b) {
    return {a.value * b.value, a.value * b.slope + b.value * a.slope};
  }
  friend Reference operator*(double factor, const Reference& a) { return {factor * a.value, factor * a.slope}; }
};

/// On the unit triangle.
std::vector<Reference> triangle_functions(double xi, double eta) {
  const Reference corner[3] = {{1 - xi - eta, {-1, -1}}, {xi, {1, 0}}, {eta, {0, 1}}};
  std::vector<Reference> functions(corner, corner + 3);
  for (int k = 0; k < 3; ++k) functions.push_back(4 * (corner[k] * corner[(k + 1) % 3]));
  functions.push_back(27 * (corner[0] * corner[1] * corner[2]));
  return functions;
}

/// On the unit square, whose corners are (0, 0), (1, 0), (1, 1), (0, 1).
std::vector<Reference> square_functions(double xi, double eta) {
  const Reference low[2] = {{1 - xi, {-1, 0}}, {1 - eta, {0, -1}}}, high[2] = {{xi, {1, 0}}, {eta, {0, 1}}};
  const Reference bump[2] = {4 * (low[0] * high[0]), 4 * (low[1] * high[1])};
  return {low[0] * low[1],   high[0] * low[1],  high[0] * high[1], low[0] * high[1], bump[0] * low[1],
          high[0] * bump[1], bump[0] * high[1], low[0] * bump[1],  bump[0] * bump[1]};
}

}  // namespace

std::vector<CellPoint> cell_points(const Mesh& mesh, int cell, const std::vector<int>& tips) {
  SPREKK_EXPECT(is_index(cell, mesh.cell_count()), cell, mesh.cell_count());
  const Ring &corners = mesh.cell_nodes[cell], &faces = mesh.cell_faces[cell];
  const bool is_triangle = corners.size() == 3;
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
  for (const GaussPoint& first : gauss_points())
    for (const GaussPoint& second : gauss_points()) {
      // A triangle is a square of which one side has no length.
      const double shrink = is_triangle ? 1 - first.at : 1;
      double share[3];
      share[start % 3] = first.at;
      share[(start + 1) % 3] = shrink * second.at;
      share[(start + 2) % 3] = shrink * (1 - second.at);
      const std::vector<Reference> functions =
          is_triangle ? triangle_functions(share[1], share[2]) : square_functions(first.at, second.at);
      const int count = static_cast<int>(functions.size());
      CellPoint point{Point::Zero(), 0, Eigen::VectorXd(count), Eigen::Matrix2Xd(2, count)};
      Tensor jacobian = Tensor::Zero();  // d x / d reference
      for (int k = 0; k < corners.size(); ++k) {
        // Relative to a corner, so that coordinates far from the origin cost no digits.
        const Point arm = mesh.nodes[corners[k]] - mesh.nodes[corners[0]];
        const Reference& of_face = functions[corners.size() + k];
        point.x += functions[k].value * arm + of_face.value * shift[k];
        jacobian += arm * functions[k].slope.transpose() + shift[k] * of_face.slope.transpose();
      }
      point.x += mesh.nodes[corners[0]];
      const double stretch = jacobian.determinant();
      SPREKK_ASSERT(stretch > 0, cell, stretch);
      point.weight = first.weight * second.weight * shrink * stretch;
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
