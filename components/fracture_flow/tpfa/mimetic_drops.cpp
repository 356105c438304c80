#include "components/fracture_flow/tpfa/mimetic_drops.hpp"

#include <algorithm>

#include "framework/invariants.hpp"
#include "framework/mesh/ridge_distance.hpp"

namespace sprekk::fracture_flow {
namespace {

Eigen::MatrixXd beside_two_point_fluxes(const Mesh& mesh, int cell) {
  const FractureCell& of = mesh.fracture_cells[cell];
  const auto count = static_cast<Eigen::Index>(of.ridges.size());
  Eigen::MatrixXd midpoints(count, dimension - 1), normals(count, dimension - 1);
  Vector h(count);
  for (Eigen::Index k = 0; k < count; ++k) {
    const int ridge = of.ridges[static_cast<std::size_t>(k)];
    const Point out = mesh.ridges[ridge].center - of.center;
    midpoints.row(k) = out.transpose() * of.tangents;
    h[k] = distance_to_ridge(mesh, cell, ridge) / mesh.ridges[ridge].measure;
    normals.row(k) = midpoints.row(k);  // of a line; in space turned below
  }
  if constexpr (dimension == 2) {
    normals.rowwise().normalize();
  } else {
    const FaceNodes& corners = mesh.face_nodes[of.faces[0]];
    for (int k = 0; k < corners.size(); ++k) {
      const Point along = mesh.nodes[corners.after(k)] - mesh.nodes[corners[k]];
      const TangentialVector edge = of.tangents.transpose() * along;
      TangentialVector normal(edge[1], -edge[0]);
      const Point middle = 0.5 * (mesh.nodes[corners[k]] + mesh.nodes[corners.after(k)]);
      const auto ridge = std::ranges::find_if(of.ridges, [&](int r) { return mesh.ridges[r].center == middle; });
      SPREKK_ASSERT(ridge != of.ridges.end(), cell, k);
      const Eigen::Index place = ridge - of.ridges.begin();
      if (midpoints.row(place).dot(normal) < 0) normal = -normal;
      normals.row(place) = normal;
    }
  }
  const Eigen::MatrixXd rest = Eigen::MatrixXd::Identity(count, count) - normals * midpoints.transpose() / of.measure;
  Eigen::MatrixXd g = midpoints * midpoints.transpose() / of.measure + rest.transpose() * h.asDiagonal() * rest;
  g.diagonal() -= h;
  constexpr double round_off = 1e-14;
  return (g.cwiseAbs().array() < round_off * h.maxCoeff()).select(0, g);
}

}  // namespace

MimeticDrops::MimeticDrops(const Mesh& mesh) : mesh_(&mesh), junction_of_ridge_(mesh.ridges.size(), none) {
  for (int i = 0; i < mesh.fracture_cell_count(); ++i) of_cell_.push_back(beside_two_point_fluxes(mesh, i));
  for (std::size_t j = 0; j < mesh.junctions.size(); ++j)
    for (const int ridge : mesh.junctions[j].ridges) junction_of_ridge_[ridge] = static_cast<int>(j);
}

std::vector<std::pair<int, double>> MimeticDrops::at(int cell, int ridge) const {
  std::vector<std::pair<int, double>> factors;
  if (of_cell_.empty()) return factors;
  const FaceRidges& ridges = mesh_->fracture_cells[cell].ridges;
  const auto is_here = [&](int other) { return mesh_->ridges[other].center == mesh_->ridges[ridge].center; };
  const auto place = std::ranges::find_if(ridges, is_here) - ridges.begin();
  SPREKK_EXPECT(place < static_cast<long>(ridges.size()), cell, ridge);
  for (std::size_t j = 0; j < ridges.size(); ++j) {
    const double factor = of_cell_[cell](place, static_cast<Eigen::Index>(j));
    if (factor == 0) continue;
    // What flows out at a junction goes to each of the other cells there.
    const int junction = junction_of_ridge_[ridges[j]];
    const std::vector<int> one = {ridges[j]};
    for (const int r : junction == none ? one : mesh_->junctions[junction].ridges) {
      const std::vector<int>& cells = mesh_->ridges[r].cells;
      if (std::ranges::count(cells, cell) > 0) factors.emplace_back(r, cells[0] == cell ? factor : -factor);
    }
  }
  return factors;
}

}  // namespace sprekk::fracture_flow
