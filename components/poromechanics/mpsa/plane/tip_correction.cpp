#include "components/poromechanics/mpsa/plane/tip_correction.hpp"

#include <algorithm>

namespace sprekk::poromechanics {
namespace {

/// A face of the region that is a wall, or none.
int wall_of(const InteractionRegion& region) {
  for (int f = 0; f < region.subface_count(); ++f)
    if (!region.is_inner(f)) return region.faces[f];
  return none;
}

}  // namespace

TipCorrection::TipCorrection(const TipField& field, double weight, const Mesh& mesh, const InteractionRegion& region,
                             int node, std::span<const int> cells, const std::vector<Stiffness>& stiffness)
    : field_(field), weight_(weight), mesh_(mesh), region_(region), node_(mesh.nodes[node]) {
  const int wall = wall_of(region);
  if (node != field.tip()) side_ = wall == none ? field.frame().side_of(node_) : field.frame().side_of_wall(mesh, wall);
  for (const Subcell& subcell : region.subcells)
    shear_ratio_ += stiffness[subcell.cell](2, 2) / field.rock()(2, 2) / region.subcell_count();
  const auto column = [&](int cell) {
    return 2 * static_cast<int>(std::lower_bound(cells.begin(), cells.end(), cell) - cells.begin());
  };
  for (const Subcell& subcell : region.subcells) {
    own_.push_back(column(subcell.cell));
    modes_.push_back(field.displacement(mesh.cell_center[subcell.cell], side_));
  }
  for (const int cell : field.cells()) at_tip_.push_back(column(cell));
}

void TipCorrection::of_force(double* coefficients, int subface, int component) const {
  const int face = region_.faces[subface];
  const TipField::Modes force = field_.force(mesh_.face_center[face], side_) - field_.force(node_, side_);
  add_missing(coefficients, sign_of(face) * shear_ratio_ * force.row(component));
}

double TipCorrection::sign_of(int face) const {
  const Point along = mesh_.face_center[face] - node_;
  return Point(-along.y(), along.x()).dot(mesh_.face_normal[face]) > 0 ? 1 : -1;
}

void TipCorrection::add_moment(std::vector<Triplet>& moments, int subface, double weight) const {
  const int face = region_.faces[subface];
  const Point& center = mesh_.face_center[face];
  const Point along = (center - node_).normalized();
  // The integral of dF (x - center), by parts.
  const TipField::Modes at_node = field_.force(node_, side_), mean = field_.integrated_force(node_, center, side_);
  const auto moment = [&](int component, int direction) -> TipField::Amounts {
    return at_node.row(component) * (center - node_)[direction] - mean.row(component) * along[direction];
  };
  const TipField::Amounts of_modes[3] = {moment(0, 0), moment(1, 1), 0.5 * (moment(0, 1) + moment(1, 0))};
  for (int k = 0; k < 3; ++k)
    for (std::size_t cell = 0; cell < field_.cells().size(); ++cell)
      for (int c = 0; c < 2; ++c)
        moments.emplace_back(3 * face + k, 2 * field_.cells()[cell] + c,
                             weight * sign_of(face) * shear_ratio_ *
                                 of_modes[k].dot(field_.share().col(2 * static_cast<int>(cell) + c)));
}

void TipCorrection::of_displacement(double* coefficients, int subface, int component) const {
  const int face = region_.faces[subface];
  const int side = field_.frame().side_of_wall(mesh_, face);
  add_missing(coefficients, field_.displacement(mesh_.face_center[face], side).row(component));
}

void TipCorrection::of_volume_change(double* coefficients, int subcell) const {
  const Subcell& part = region_.subcells[subcell];
  const auto face_center = [&](int i) { return mesh_.face_center[region_.faces[part.subfaces[i]]]; };
  const Point& center = mesh_.cell_center[part.cell];
  const int side = side_ == 0 ? field_.frame().side_of(center) : side_;  // a cell at the tip may have a wall as a face
  add_missing(coefficients, field_.volume_change({node_, face_center(0), center, face_center(1)}, side));
}

void TipCorrection::add_missing(double* coefficients, const TipField::Amounts& exact) const {
  TipField::Amounts missing = exact;
  for (std::size_t k = 0; k < own_.size(); ++k)
    for (int c = 0; c < 2; ++c) missing -= coefficients[own_[k] + c] * modes_[k].row(c);
  missing *= weight_;
  for (std::size_t k = 0; k < at_tip_.size(); ++k)
    for (int c = 0; c < 2; ++c) coefficients[at_tip_[k] + c] += missing.dot(field_.share().col(2 * k + c));
}

}  // namespace sprekk::poromechanics
