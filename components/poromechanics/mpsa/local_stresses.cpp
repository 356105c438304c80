#include "components/poromechanics/mpsa/local_stresses.hpp"

#include <algorithm>
#include <cmath>

#include "components/poromechanics/mpsa/tip_correction.hpp"
#include "framework/invariants.hpp"
#include "framework/linear/eliminate.hpp"

namespace sprekk::poromechanics {

namespace {

/// Smallest pivot, of a row, of a local problem that is solvable: less is round-off.
constexpr double singular = 1e-12;

/// target += factor * source, both of `count` values.
inline void add_scaled(double* target, double factor, const double* source, int count) {
  for (int j = 0; j < count; ++j) target[j] += factor * source[j];
}

/// The cells on the other sides of the faces that do not touch the node: one at most of a triangle, two of a
/// quadrilateral.
void add_cells_across(const Mesh& mesh, int cell, int node, std::vector<int>& cells) {
  for (const int face : mesh.cell_faces[cell]) {
    if (mesh.face_nodes[face][0] == node || mesh.face_nodes[face][1] == node) continue;
    const int across = mesh.face_cells[face][mesh.face_cells[face][0] == cell ? 1 : 0];
    if (across != none) cells.push_back(across);
  }
}

}  // namespace

Adjacency local_cells(const Mesh& mesh, const EndZones& zones) {
  SPREKK_EXPECT(static_cast<int>(zones.end.size()) == mesh.node_count(), zones.end.size(), mesh.node_count());
  Adjacency cells;
  std::vector<int> of_node;
  for (int node = 0; node < mesh.node_count(); ++node) {
    const auto at_node = mesh.node_cells[node];
    of_node.assign(at_node.begin(), at_node.end());
    if (at_node.size() == 1) add_cells_across(mesh, at_node[0], node, of_node);
    if (zones.end[node] != none) {
      const std::vector<int>& near_tip = zones.cells.at(zones.end[node]);
      of_node.insert(of_node.end(), near_tip.begin(), near_tip.end());
    }
    cells.append_set(of_node);
  }
  return cells;
}

void LocalStresses::solve(const Mesh& mesh, const InteractionRegion& region, std::span<const int> cells,
                          const std::vector<Stiffness>& stiffness, const std::vector<FaceConditions>& conditions) {
  subcells_ = region.subcell_count();
  cells_ = static_cast<int>(cells.size());
  SPREKK_EXPECT(is_ascending(cells));
  SPREKK_EXPECT(static_cast<int>(stiffness.size()) == mesh.cell_count(), stiffness.size(), mesh.cell_count());
  SPREKK_EXPECT(static_cast<int>(conditions.size()) == mesh.face_count(), conditions.size(), mesh.face_count());
  column_.resize(subcells_);
  for (int k = 0; k < subcells_; ++k)
    column_[k] =
        static_cast<int>(std::lower_bound(cells.begin(), cells.end(), region.subcells[k].cell) - cells.begin());
  subfaces_ = region.subface_count();
  columns_ = 3 * cells_;
  load_column_.assign(subfaces_, none);
  for (int f = 0; f < subfaces_; ++f) {
    if (conditions[region.faces[f]][0] == MechanicalCondition::none) continue;
    load_column_[f] = columns_;
    columns_ += 2;
  }
  width_ = 2 * subfaces_ + columns_;

  stress_.resize(subcells_);
  for (int k = 0; k < subcells_; ++k) stress_[k] = stress_map(stiffness[region.subcells[k].cell]);
  SPREKK_ASSERT(are_indices(column_, cells_), cells_);
  find_jumps(region, stiffness, 0);

  find_axes(mesh, region, conditions);

  assemble(region, conditions);
  if (subcells_ == 1) {
    solve_single(mesh, region, cells, stiffness, conditions);
    find_gradients(region);
    find_forces(region, stiffness);
    prescribe_forces(region, conditions);
    return;
  }
  const auto smallest_pivot = [&] { return eliminate(system_.data(), 2 * subfaces_, width_); };
  double pivot = smallest_pivot();
  if (pivot < limits_.turns_freely) {
    // A stiff subcell among very soft ones can turn freely, since the soft ones exert small forces only: it is coupled
    // to their rotation a little.
    find_jumps(region, stiffness, limits_.held_by_soft);
    assemble(region, conditions);
    pivot = smallest_pivot();
  }
  if (pivot < singular) throw unsolvable_region("MPSA", mesh, region, "stiffness");
  find_gradients(region);
  find_forces(region, stiffness);
  prescribe_forces(region, conditions);
  exchange_volumes(mesh, region, stiffness);
}

void LocalStresses::correct(const InteractionRegion& region, const TipCorrection& tip) {
  for (int f = 0; f < subfaces_; ++f)
    for (int c = 0; c < 2; ++c)
      if (region.is_inner(f))
        tip.of_force(forces_.data() + (2 * f + c) * columns_, f, c);
      else
        tip.of_displacement(system_.data() + (2 * f + c) * width_ + 2 * subfaces_, f, c);
  for (int k = 0; k < subcells_; ++k) tip.of_volume_change(volumes_.data() + k * columns_, k);
}

void LocalStresses::find_jumps(const InteractionRegion& region, const std::vector<Stiffness>& stiffness,
                               double least_strength) {
  jump_.resize(subfaces_);
  dilation_.resize(subfaces_);
  for (int f = 0; f < subfaces_; ++f) {
    if (!region.is_inner(f)) continue;
    const auto [first, second] = region.neighbours[f];
    const Subcell &one = region.subcells[first], &other = region.subcells[second];
    SPREKK_ASSERT(one.measure > 0 && other.measure > 0, one.cell, other.cell);
    const Kink kink(one.half_face[region.place(f, first)], stiffness[one.cell], stiffness[other.cell]);
    jump_[f] = {kink.rotation(), {0, 0}};
    dilation_[f] = kink.dilation();
    // The strength of the softer rock: with more, its error for a field that is not linear would load the stiffer rock.
    const double strengths[2] = {one.measure * shear_modulus(stiffness[one.cell]),
                                 other.measure * shear_modulus(stiffness[other.cell])};
    const double both = 2 * strengths[0] * strengths[1] / (strengths[0] + strengths[1]);
    SPREKK_ASSERT(both > 0, one.cell, other.cell, both);
    for (int side = 0; side < 2; ++side)
      jump_[f].strength[side] = limits_.rotation_strength * std::max(both, least_strength * strengths[side]);
  }
}

void LocalStresses::find_axes(const Mesh& mesh, const InteractionRegion& region,
                              const std::vector<FaceConditions>& conditions) {
  axes_.resize(subfaces_);
  for (int f = 0; f < subfaces_; ++f)
    axes_[f] = axes_of(conditions[region.faces[f]].axes, mesh.face_normal[region.faces[f]]);
}

int LocalStresses::row_of(int subface, int direction) const {
  const bool are_swapped = std::abs(axes_[subface](0, 0)) < std::abs(axes_[subface](1, 0));
  return 2 * subface + (are_swapped ? 1 - direction : direction);
}

void LocalStresses::turn_balance(int subface) {
  double *x = system_.data() + 2 * subface * width_, *y = x + width_;
  double* along[2] = {system_.data() + row_of(subface, 0) * width_, system_.data() + row_of(subface, 1) * width_};
  for (int j = 0; j < width_; ++j) {
    const Point balance = axes_[subface].transpose() * Point(x[j], y[j]);
    for (int c = 0; c < 2; ++c) along[c][j] = balance[c];
  }
}

void LocalStresses::assemble(const InteractionRegion& region, const std::vector<FaceConditions>& conditions) {
  system_.assign(2 * subfaces_ * width_, 0);
  const int u_columns = 2 * subfaces_, s_columns = u_columns + 2 * cells_;
  // A row: factor times the function of a subcell's gradient, that is weight · G. What stands at the columns of given
  // values is on the other side of the equation.
  const auto add_gradient = [&](double* row, int k, const GradientRow& weight) {
    const Subcell& subcell = region.subcells[k];
    for (int i = 0; i < 2; ++i)
      for (int e = 0; e < 2; ++e) {
        const double value = weight[2 * e] * subcell.gradient[i][0] + weight[2 * e + 1] * subcell.gradient[i][1];
        row[2 * subcell.subfaces[i] + e] += value;
        row[u_columns + 2 * column(k) + e] += value;
      }
  };
  // The forces out of the neighbours add up to zero, or to the half of what is prescribed for the face.
  for (int k = 0; k < subcells_; ++k) {
    const Subcell& subcell = region.subcells[k];
    for (int i = 0; i < 2; ++i) {
      const Point& half_face = subcell.half_face[i];
      const ForceMap own = force_map(stress_[k], half_face);
      double* rows[2] = {system_.data() + 2 * subcell.subfaces[i] * width_,
                         system_.data() + (2 * subcell.subfaces[i] + 1) * width_};
      for (int c = 0; c < 2; ++c) {
        add_gradient(rows[c], k, own.row(c));
        rows[c][s_columns + column(k)] += half_face[c];
      }
      for (const int f : subcell.subfaces) {
        if (!region.is_inner(f)) continue;
        const RotationJump& jump = jump_[f];
        const Point couple = couple_on(region, f, k, half_face);
        const auto [first, second] = region.neighbours[f];
        for (int c = 0; c < 2; ++c) {
          add_gradient(rows[c], first, couple[c] * jump.of_gradient[0]);
          add_gradient(rows[c], second, couple[c] * jump.of_gradient[1]);
          rows[c][s_columns + column(first)] -= couple[c] * jump.of_stress;
          rows[c][s_columns + column(second)] += couple[c] * jump.of_stress;
          if (load_column_[f] != none)
            for (int e = 0; e < 2; ++e) rows[c][u_columns + load_column_[f] + e] -= couple[c] * jump.of_load[e];
        }
      }
    }
  }
  for (int f = 0; f < subfaces_; ++f) {
    if (load_column_[f] == none) continue;
    const FaceConditions& given = conditions[region.faces[f]];
    for (int c = 0; c < 2; ++c)
      for (int e = 0; e < 2; ++e) system_[(2 * f + c) * width_ + 2 * f + e] += region.shares[f] * given.spring(c, e);
    if (given.axes != ConditionAxes::of_space) turn_balance(f);
    for (int c = 0; c < 2; ++c) {
      double* row = system_.data() + row_of(f, c) * width_;
      const int b_column = u_columns + load_column_[f] + c;
      if (given[c] == MechanicalCondition::displacement) {
        std::fill_n(row, width_, 0.0);
        for (int e = 0; e < 2; ++e) row[2 * f + e] = axes_[f](e, c);
        row[b_column] = 1;
      } else {
        row[b_column] += 0.5;
      }
    }
  }
}

Point LocalStresses::couple_on(const InteractionRegion& region, int subface, int subcell,
                               const Point& half_face) const {
  const int side = region.neighbours[subface][0] == subcell ? 0 : 1;
  SPREKK_ASSERT(region.neighbours[subface][side] == subcell, subface, subcell);
  const GradientRow& stress = jump_[subface].of_gradient[side];
  return jump_[subface].strength[side] / region.subcells[subcell].measure *
         Point(half_face[0] * stress[0] + half_face[1] * stress[1],
               half_face[0] * stress[2] + half_face[1] * stress[3]);
}

void LocalStresses::find_gradients(const InteractionRegion& region) {
  gradients_.assign(4 * subcells_ * columns_, 0);
  volumes_.assign(subcells_ * columns_, 0);
  for (int k = 0; k < subcells_; ++k) {
    const Subcell& subcell = region.subcells[k];
    for (int c = 0; c < 2; ++c)
      for (int d = 0; d < 2; ++d) {
        double* gradient = gradients_.data() + (4 * k + 2 * c + d) * columns_;
        for (int i = 0; i < 2; ++i)
          add_scaled(gradient, subcell.gradient[i][d], displacement(subcell.subfaces[i], c), columns_);
        gradient[2 * column(k) + c] -= subcell.gradient[0][d] + subcell.gradient[1][d];
      }
    const double* gradient = gradients_.data() + 4 * k * columns_;
    double* volume = volumes_.data() + k * columns_;
    add_scaled(volume, subcell.measure, gradient, columns_);
    add_scaled(volume, subcell.measure, gradient + 3 * columns_, columns_);
  }
  turns_.assign(subfaces_ * columns_, 0);
  for (int f = 0; f < subfaces_; ++f) {
    if (!region.is_inner(f)) continue;
    add_jump(region, f, jump_[f], 1, turns_.data() + f * columns_);
  }
}

void LocalStresses::add_jump(const InteractionRegion& region, int subface, const GradientJump& jump, double factor,
                             double* row) const {
  for (int side = 0; side < 2; ++side) {
    const int k = region.neighbours[subface][side];
    for (int e = 0; e < 4; ++e)
      add_scaled(row, factor * jump.of_gradient[side][e], gradients_.data() + (4 * k + e) * columns_, columns_);
    row[stress_column() + column(k)] += factor * (side == 0 ? jump.of_stress : -jump.of_stress);
  }
  if (load_column_[subface] != none)
    for (int e = 0; e < 2; ++e) row[load_column_[subface] + e] += factor * jump.of_load[e];
}

void LocalStresses::exchange_volumes(const Mesh& mesh, const InteractionRegion& region,
                                     const std::vector<Stiffness>& stiffness) {
  exchange_.assign(mesh, region, stiffness, dilation_, limits_.exchange);
  const int count = static_cast<int>(exchange_.subfaces.size());
  jumps_.assign(count * columns_, 0);
  for (int i = 0; i < count; ++i) {
    const GradientJump& jump = dilation_[exchange_.subfaces[i]];
    add_jump(region, exchange_.subfaces[i], jump, VolumeExchange::modulus(jump), jumps_.data() + i * columns_);
  }
  exchanged_.assign(count * columns_, 0);
  for (int i = 0; i < count; ++i) {
    double* volume = exchanged_.data() + i * columns_;
    for (int j = 0; j < count; ++j) add_scaled(volume, exchange_.volume(i, j), jumps_.data() + j * columns_, columns_);
    const auto [first, second] = region.neighbours[exchange_.subfaces[i]];
    add_scaled(volumes_.data() + first * columns_, -1, volume, columns_);
    add_scaled(volumes_.data() + second * columns_, 1, volume, columns_);
  }
}

void LocalStresses::find_forces(const InteractionRegion& region, const std::vector<Stiffness>& stiffness) {
  forces_.assign(2 * subfaces_ * columns_, 0);
  for (int f = 0; f < subfaces_; ++f) {
    // Of the two equal expressions for the force, the one of the softer side suffers less from cancellation.
    int side = 0;
    if (region.is_inner(f)) {
      const auto trace = [&](int s) { return stiffness[region.subcells[region.neighbours[f][s]].cell].trace(); };
      side = trace(1) < trace(0) ? 1 : 0;
    }
    const int k = region.neighbours[f][side];
    const Subcell& subcell = region.subcells[k];
    const Point half_face = (side == 0 ? 1.0 : -1.0) * subcell.half_face[region.place(f, k)];
    const ForceMap own = force_map(stress_[k], half_face);
    const double* gradient = gradients_.data() + 4 * k * columns_;
    for (int c = 0; c < 2; ++c) {
      double* force = forces_.data() + (2 * f + c) * columns_;
      for (int e = 0; e < 4; ++e) add_scaled(force, own(c, e), gradient + e * columns_, columns_);
      for (const int turning : subcell.subfaces)
        if (region.is_inner(turning))
          add_scaled(force, couple_on(region, turning, k, half_face)[c], turns_.data() + turning * columns_, columns_);
      force[stress_column() + column(k)] -= half_face[c];
      // The force on the first side; both sides together balance the load on the face.
      if (side == 1 && load_column_[f] != none) force[load_column_[f] + c] += 0.5;
    }
  }
}

void LocalStresses::prescribe_forces(const InteractionRegion& region, const std::vector<FaceConditions>& conditions) {
  for (int f = 0; f < subfaces_; ++f) {
    const FaceConditions& given = conditions[region.faces[f]];
    if (given.axes == ConditionAxes::of_space || given.has_spring()) continue;
    double *x = forces_.data() + 2 * f * columns_, *y = x + columns_;
    for (int j = 0; j < columns_; ++j) {
      Point along = axes_[f].transpose() * Point(x[j], y[j]);
      for (int c = 0; c < 2; ++c)
        if (given[c] == MechanicalCondition::traction) along[c] = j == load_column_[f] + c ? 0.5 : 0;
      const Point force = axes_[f] * along;
      x[j] = force[0];
      y[j] = force[1];
    }
  }
}

}  // namespace sprekk::poromechanics
