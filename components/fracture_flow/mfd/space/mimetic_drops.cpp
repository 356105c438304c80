#include "components/fracture_flow/tpfa/mimetic_drops.hpp"

#include <algorithm>

#include "framework/invariants.hpp"
#include "framework/mesh/ridge_distance.hpp"
#include "framework/round_off.hpp"

namespace sprekk::fracture_flow {
namespace {

Eigen::MatrixXd beside_two_point_fluxes(const Mesh& mesh, int cell) {
  const FractureCell& of = mesh.fracture_cells[cell];
  const auto count = static_cast<Eigen::Index>(of.ridges.size());
  Eigen::MatrixXd midpoints(count, dimension - 1), normals(count, dimension - 1);
  Vector h(count);
  for (Eigen::Index k = 0; k < count; ++k) {
    const int ridge = of.ridges[static_cast<int>(k)];
    const Point out = mesh.ridges[ridge].center - of.center;
    midpoints.row(k) = out.transpose() * of.tangents;
    h[k] = distance_to_ridge(mesh, cell, ridge) / mesh.ridges[ridge].measure;
  }
  const FaceNodes& corners = mesh.face_nodes[of.faces[0]];
  for (int k = 0; k < corners.size(); ++k) {
    const Point &from = mesh.nodes[corners[k]], &to = mesh.nodes[corners.after(k)];
    const auto is_here = [&](int ridge) { return mesh.ridges[ridge].center == 0.5 * (from + to); };
    const Eigen::Index place = std::ranges::find_if(of.ridges, is_here) - of.ridges.begin();
    SPREKK_ASSERT(place < count, cell, k);
    const TangentialVector edge = of.tangents.transpose() * (to - from);
    const Eigen::RowVector2d normal(edge[1], -edge[0]);
    normals.row(place) = midpoints.row(place).dot(normal) < 0 ? -normal : normal;
  }
  const Eigen::MatrixXd rest = Eigen::MatrixXd::Identity(count, count) - normals * midpoints.transpose() / of.measure;
  Eigen::MatrixXd g = midpoints * midpoints.transpose() / of.measure + rest.transpose() * h.asDiagonal() * rest;
  g.diagonal() -= h;
  // Of the largest entry: rectangles, where nothing else is left, keep two-point fluxes.
  return (g.cwiseAbs().array() < rounding::of_terms * h.maxCoeff()).select(0, g);
}

}  // namespace

long MimeticDrops::cells_that_need_them(const Mesh& mesh) {
  long count = 0;
  for (int i = 0; i < mesh.fracture_cell_count(); ++i) count += !beside_two_point_fluxes(mesh, i).isZero(0);
  return count;
}

MimeticDrops::MimeticDrops(const Mesh& mesh) : mesh_(&mesh), outflows_(mesh) {
  for (int i = 0; i < mesh.fracture_cell_count(); ++i) of_cell_.push_back(beside_two_point_fluxes(mesh, i));
}

}  // namespace sprekk::fracture_flow
