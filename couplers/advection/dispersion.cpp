#include "couplers/advection/dispersion.hpp"

namespace sprekk::couplers {
namespace {

Tensor dispersion(const Point& q, const Dispersivity& lengths) {
  const double size = q.norm();
  if (size == 0) return Tensor::Zero();
  return lengths.across * size * Tensor::Identity() + (lengths.along - lengths.across) / size * q * q.transpose();
}

}  // namespace

std::vector<Tensor> dispersion_in_rock(const Mesh& mesh, const Vector& fluxes, const Dispersivity& lengths) {
  std::vector<Tensor> tensors;
  for (int c = 0; c < mesh.cell_count(); ++c) {
    Point q = Point::Zero();
    Tensor of_constants = Tensor::Zero();  // what the sum makes of a constant velocity: 1 where faces are flat
    for (const int face : mesh.cell_faces[c]) {
      const double out = mesh.face_cells[face][0] == c ? 1 : -1;
      const Point arm = (mesh.face_center[face] - mesh.cell_center[c]) / mesh.cell_measure[c];
      q += out * fluxes[face] * arm;
      of_constants += out * mesh.face_measure[face] * arm * mesh.face_normal[face].transpose();
    }
    if constexpr (dimension == 3) q = of_constants.inverse() * q;
    tensors.push_back(dispersion(q, lengths));
  }
  return tensors;
}

std::vector<Tensor> dispersion_in_fractures(const Mesh& mesh, const Vector& fluxes, const Dispersivity& lengths) {
  std::vector<Point> q(mesh.fracture_cell_count(), Point::Zero());
  for (std::size_t p = 0; p < mesh.ridges.size(); ++p) {
    const Ridge& ridge = mesh.ridges[p];
    for (std::size_t k = 0; k < ridge.cells.size(); ++k) {
      const FractureCell& cell = mesh.fracture_cells[ridge.cells[k]];
      const double out = k == 0 ? 1 : -1;
      q[ridge.cells[k]] += out * fluxes[static_cast<Eigen::Index>(p)] / cell.measure * (ridge.center - cell.center);
    }
  }
  std::vector<Tensor> tensors;
  for (const Point& each : q) tensors.push_back(dispersion(each, lengths));
  return tensors;
}

}  // namespace sprekk::couplers
