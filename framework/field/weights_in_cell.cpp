#include "framework/field/weights_in_cell.hpp"

#include <cmath>
#include <stdexcept>

#include "framework/dense/least_squares.hpp"
#include "framework/invariants.hpp"
#include "framework/mesh/corner_weights.hpp"

namespace sprekk {

namespace {

std::vector<std::pair<int, double>> face_weights(const Mesh& mesh, int cell, const Point& x) {
  const CellFaces& faces = mesh.cell_faces[cell];
  // Minimizes sum (a + b·(x_face − x) − value)^2; the weights of a are the first row of the pseudo-inverse.
  Eigen::MatrixXd basis(faces.size(), 1 + dimension);
  const double scale = std::pow(mesh.cell_measure[cell], 1.0 / dimension);
  for (int k = 0; k < faces.size(); ++k) {
    basis(k, 0) = 1;
    basis.row(k).tail<dimension>() = (mesh.face_center[faces[k]] - x) / scale;
  }
  const Eigen::MatrixXd inverse = LeastSquares(basis).pseudo_inverse();
  std::vector<std::pair<int, double>> weights;
  for (int k = 0; k < faces.size(); ++k) weights.emplace_back(faces[k], inverse(0, k));
  return weights;
}

}  // namespace

bool is_in_cells(Location location) {
  return location == Location::cell || location == Location::node || location == Location::face;
}

std::vector<std::pair<int, double>> weights_in_cell(const Mesh& mesh, Location location, int cell, const Point& x) {
  SPREKK_EXPECT(is_index(cell, mesh.cell_count()), cell, mesh.cell_count());
  switch (location) {
    case Location::cell:
      return {{cell, 1.0}};
    case Location::node:
      return corner_weights(mesh, cell, x);
    case Location::face:
      return face_weights(mesh, cell, x);
    default:
      throw std::logic_error("a field on fractures has no value in a cell");
  }
}

Vector means_of_cells(const Mesh& mesh, Location location, int components, const Vector& values) {
  if (location == Location::cell) return values;
  Vector means = Vector::Zero(static_cast<Eigen::Index>(mesh.cell_count()) * components);
  for (int c = 0; c < mesh.cell_count(); ++c)
    for (const auto& [entity, weight] : weights_in_cell(mesh, location, c, mesh.cell_center[c]))
      means.segment(c * components, components) += weight * values.segment(entity * components, components);
  return means;
}

}  // namespace sprekk
