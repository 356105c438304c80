#include "components/poromechanics/mpsa/tip_field.hpp"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

namespace sprekk::poromechanics {
namespace {

constexpr int linear_terms = 6, terms = linear_terms + 2;
/// Of the fit's smallest singular value to its largest; below, fields and linear displacements are too alike.
constexpr double well_posed = 1e-3;

bool is_isotropic(const Stiffness& c) {
  const double near = 1e-9 * c(0, 0);
  return std::abs(c(0, 0) - c(1, 1)) < near && std::abs(c(0, 2)) < near && std::abs(c(1, 2)) < near &&
         std::abs(c(0, 0) - c(0, 1) - 2 * c(2, 2)) < near;
}

/// The two subfaces that are walls of the same fracture cell, when they are all of the region's outer ones.
std::optional<std::array<int, 2>> walls_of_tip(const Mesh& mesh, const InteractionRegion& region) {
  std::array<int, 2> walls{none, none};
  int count = 0;
  for (int f = 0; f < region.subface_count(); ++f) {
    if (region.is_inner(f)) continue;
    if (count == 2) return std::nullopt;
    walls[count++] = f;
  }
  if (count < 2) return std::nullopt;
  const int cell = mesh.face_fracture_cell[region.faces[walls[0]]];
  if (cell == none || cell != mesh.face_fracture_cell[region.faces[walls[1]]]) return std::nullopt;
  return walls;
}

}  // namespace

std::optional<TipField> TipField::find(const Mesh& mesh, const InteractionRegion& region, std::span<const int> cells,
                                       const std::vector<Stiffness>& stiffness) {
  const auto walls = walls_of_tip(mesh, region);
  if (!walls || 2 * cells.size() < terms + 2 || cells.size() != region.subcells.size()) return std::nullopt;
  const Stiffness& rock = stiffness[cells[0]];
  for (const int cell : cells)
    if (stiffness[cell] != rock) return std::nullopt;
  if (!is_isotropic(rock)) return std::nullopt;
  // Of a fracture of a single cell both ends may be tips: this one is where all faces of the region meet.
  const auto& ends = mesh.face_nodes[region.faces[(*walls)[0]]];
  const bool is_first = std::all_of(region.faces.begin(), region.faces.end(), [&](int face) {
    return mesh.face_nodes[face][0] == ends[0] || mesh.face_nodes[face][1] == ends[0];
  });
  const int node = is_first ? ends[0] : ends[1];
  TipField field(mesh, region, rock, node, region.faces[(*walls)[0]]);
  if (!field.fit(cells)) return std::nullopt;
  return field;
}

TipField::TipField(const Mesh& mesh, const InteractionRegion& region, const Stiffness& stiffness, int node, int wall)
    : mesh_(mesh),
      region_(region),
      shear_(stiffness(2, 2)),
      poisson_(0.5 * stiffness(0, 1) / (stiffness(0, 1) + stiffness(2, 2))),
      tip_(mesh.nodes[node]),
      size_(mesh.face_length[wall]) {
  const Point ahead = (tip_ - mesh.face_center[wall]).normalized();
  axes_ << ahead.x(), -ahead.y(), ahead.y(), ahead.x();
}

bool TipField::fit(std::span<const int> cells) {
  const int count = static_cast<int>(cells.size());
  at_cells_.resize(2 * count, 2);
  Eigen::MatrixXd basis = Eigen::MatrixXd::Zero(2 * count, terms);
  for (int k = 0; k < count; ++k) {
    const Point& center = mesh_.cell_center[cells[k]];
    at_cells_.middleRows<2>(2 * k) = displacement(k);
    const Eigen::RowVector3d linear(1, (center.x() - tip_.x()) / size_, (center.y() - tip_.y()) / size_);
    basis.block<1, 3>(2 * k, 0) = basis.block<1, 3>(2 * k + 1, 3) = linear;
  }
  basis.rightCols<2>() = at_cells_ / std::sqrt(size_);
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(basis, Eigen::ComputeThinU | Eigen::ComputeThinV);
  if (svd.singularValues()[terms - 1] < well_posed * svd.singularValues()[0]) return false;
  const Eigen::MatrixXd inverse = svd.solve(Eigen::MatrixXd::Identity(2 * count, 2 * count));
  share_ = inverse.bottomRows<2>() / std::sqrt(size_);
  return true;
}

void TipField::correct(double* coefficients, const Point& exact) const {
  Eigen::Map<Eigen::RowVectorXd> row(coefficients, at_cells_.rows());
  const Eigen::RowVector2d missing = exact.transpose() - row * at_cells_;
  row += missing * share_;
}

Eigen::Matrix2d TipField::displacement(int subcell) const {
  const Point x = axes_.transpose() * (mesh_.cell_center[region_.subcells[subcell].cell] - tip_);
  const double theta = std::atan2(x.y(), x.x()), c = std::cos(0.5 * theta), s = std::sin(0.5 * theta);
  const double kolosov = 3 - 4 * poisson_;
  Eigen::Matrix2d local;
  local << c * (kolosov - 1 + 2 * s * s), s * (kolosov + 1 + 2 * c * c),  //
      s * (kolosov + 1 - 2 * c * c), -c * (kolosov - 1 - 2 * s * s);
  return std::sqrt(x.norm()) * (axes_ * local);
}

Point TipField::force(int subface, int component) const {
  if (!region_.is_inner(subface)) return Point::Zero();  // walls are free
  const int subcell = region_.neighbours[subface][0];
  const Point& half_face = region_.subcells[subcell].half_face[region_.place(subface, subcell)];
  const Point along = axes_.transpose() * (mesh_.face_center[region_.faces[subface]] - tip_);
  const double theta = std::atan2(along.y(), along.x());
  const double c = std::cos(0.5 * theta), s = std::sin(0.5 * theta);
  const double c3 = std::cos(1.5 * theta), s3 = std::sin(1.5 * theta);
  const Point n = axes_.transpose() * half_face;
  // Stress times sqrt(r) / (2 G); its mean over the half face is 2 / sqrt(length) times that.
  Eigen::Matrix2d local;
  local.col(0) = Point(c * (1 - s * s3) * n.x() + c * s * c3 * n.y(), c * s * c3 * n.x() + c * (1 + s * s3) * n.y());
  local.col(1) =
      Point(-s * (2 + c * c3) * n.x() + c * (1 - s * s3) * n.y(), c * (1 - s * s3) * n.x() + s * c * c3 * n.y());
  return 4 * shear_ / std::sqrt(half_face.norm()) * (axes_ * local).row(component);
}

}  // namespace sprekk::poromechanics
