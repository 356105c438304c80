#include "components/poromechanics/mpsa/local_stresses.hpp"

#include <algorithm>
#include <cmath>

#include "framework/invariants.hpp"
#include "framework/linear/eliminate.hpp"

namespace sprekk::poromechanics {

namespace {

/// target += factor * source, both of `count` values.
inline void add_scaled(double* target, double factor, const double* source, int count) {
  if (factor == 0) return;
  for (int j = 0; j < count; ++j) target[j] += factor * source[j];
}

/// The force on a face of a stress, given as a row of its entries.
Point traction_of(const GradientRow& stress, const Point& face) {
  Point force;
  for (int c = 0; c < dimension; ++c) {
    force[c] = face[0] * stress[dimension * c];
    for (int d = 1; d < dimension; ++d) force[c] += face[d] * stress[dimension * c + d];
  }
  return force;
}

}  // namespace

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
  columns_ = boundary_column();
  load_column_.assign(subfaces_, none);
  for (int f = 0; f < subfaces_; ++f) {
    if (conditions[region.faces[f]][0] == MechanicalCondition::none) continue;
    load_column_[f] = columns_;
    columns_ += dimension;
  }
  width_ = dimension * subfaces_ + columns_;

  stress_.resize(subcells_);
  for (int k = 0; k < subcells_; ++k) stress_[k] = stress_map(stiffness[region.subcells[k].cell]);
  SPREKK_ASSERT(are_indices(column_, cells_), cells_);
  find_jumps(region, stiffness, 0);

  find_axes(mesh, region, conditions);

  held_.clear();
  assemble(region, conditions);
  if (subcells_ <= few_subcells) {
    solve_few(mesh, region, cells, stiffness, conditions);
  } else {
    const auto smallest_pivot = [&] { return eliminate(system_.data(), dimension * subfaces_, width_); };
    double pivot = smallest_pivot();
    if (pivot < limits_.turns_freely) {
      // A stiff subcell among very soft ones can turn freely, since the soft ones exert small forces only: it is
      // coupled to their rotation a little.
      find_jumps(region, stiffness, limits_.held_by_soft);
      assemble(region, conditions);
      pivot = smallest_pivot();
    }
    if (pivot < limits_.singular) throw unsolvable_region("MPSA", mesh, region, "stiffness");
  }
  find_gradients(region);
  find_forces(region, stiffness);
  prescribe_forces(region, conditions);
  exchange_volumes(mesh, region, stiffness);
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
    const Kink kink(one.half_face[region.place(f, first)], region.shares[f], stiffness[one.cell],
                    stiffness[other.cell]);
    for (int m = 0; m < rotations; ++m) jump_[f].of[m] = kink.rotation(m);
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
  row_.resize(subfaces_);
  for (int f = 0; f < subfaces_; ++f) {
    axes_[f] = axes_of(conditions[region.faces[f]].axes, mesh.face_normal[region.faces[f]]);
    std::array<bool, dimension> is_taken{};
    for (int c = 0; c < dimension; ++c) {
      int nearest = none;
      for (int e = 0; e < dimension; ++e)
        if (!is_taken[e] && (nearest == none || std::abs(axes_[f](e, c)) > std::abs(axes_[f](nearest, c)))) nearest = e;
      is_taken[nearest] = true;
      row_[f][c] = nearest;
    }
  }
}

void LocalStresses::turn_balance(int subface) {
  double *of_axis[dimension], *along[dimension];
  for (int c = 0; c < dimension; ++c) {
    of_axis[c] = system_.data() + (dimension * subface + c) * width_;
    along[c] = system_.data() + row_of(subface, c) * width_;
  }
  for (int j = 0; j < width_; ++j) {
    Point given;
    for (int c = 0; c < dimension; ++c) given[c] = of_axis[c][j];
    const Point balance = axes_[subface].transpose() * given;
    for (int c = 0; c < dimension; ++c) along[c][j] = balance[c];
  }
}

void LocalStresses::add_gradient(const InteractionRegion& region, double* row, int subcell,
                                 const GradientRow& function) const {
  const Subcell& of = region.subcells[subcell];
  double* of_cell = row + dimension * (subfaces_ + column(subcell));
  for (int i = 0; i < dimension; ++i)
    for (int e = 0; e < dimension; ++e) {
      double value = function[dimension * e] * of.gradient[i][0];
      for (int d = 1; d < dimension; ++d) value += function[dimension * e + d] * of.gradient[i][d];
      row[dimension * of.subfaces[i] + e] += value;
      of_cell[e] += value;
    }
}

void LocalStresses::assemble(const InteractionRegion& region, const std::vector<FaceConditions>& conditions) {
  const int u_columns = dimension * subfaces_;
  system_.assign(u_columns * width_, 0);
  const int s_columns = u_columns + stress_column();
  // The forces out of the neighbours add up to zero, or to the half of what is prescribed for the face.
  for (int k = 0; k < subcells_; ++k) {
    const Subcell& subcell = region.subcells[k];
    for (int i = 0; i < dimension; ++i) {
      const Point& half_face = subcell.half_face[i];
      const ForceMap own = force_map(stress_[k], half_face);
      double* rows[dimension];
      for (int c = 0; c < dimension; ++c) {
        rows[c] = system_.data() + (dimension * subcell.subfaces[i] + c) * width_;
        add_gradient(region, rows[c], k, own.row(c));
        rows[c][s_columns + column(k)] += half_face[c];
      }
      for (const int f : subcell.subfaces) {
        if (!region.is_inner(f)) continue;
        const auto [first, second] = region.neighbours[f];
        for (int m = 0; m < rotations; ++m) {
          const GradientJump& jump = jump_[f].of[m];
          const Point couple = couple_on(region, f, m, k, half_face);
          for (int c = 0; c < dimension; ++c) {
            add_gradient(region, rows[c], first, couple[c] * jump.of_gradient[0]);
            add_gradient(region, rows[c], second, couple[c] * jump.of_gradient[1]);
            rows[c][s_columns + column(first)] -= couple[c] * jump.of_stress;
            rows[c][s_columns + column(second)] += couple[c] * jump.of_stress;
            if (load_column_[f] == none) continue;
            for (int e = 0; e < dimension; ++e) rows[c][u_columns + load_column_[f] + e] -= couple[c] * jump.of_load[e];
          }
        }
      }
    }
  }
  for (const HeldTurn& held : held_) add_held(region, held);
  for (int f = 0; f < subfaces_; ++f) {
    if (load_column_[f] == none) continue;
    const FaceConditions& given = conditions[region.faces[f]];
    for (int c = 0; c < dimension; ++c)
      for (int e = 0; e < dimension; ++e)
        system_[(dimension * f + c) * width_ + dimension * f + e] += region.shares[f] * given.spring(c, e);
    if (given.axes != ConditionAxes::of_space) turn_balance(f);
    for (int c = 0; c < dimension; ++c) {
      double* row = system_.data() + row_of(f, c) * width_;
      const int b_column = u_columns + load_column_[f] + c;
      if (given[c] == MechanicalCondition::displacement) {
        std::fill_n(row, width_, 0.0);
        for (int e = 0; e < dimension; ++e) row[dimension * f + e] = axes_[f](e, c);
        row[b_column] = 1;
      } else {
        row[b_column] += region.shares[f];
      }
    }
  }
}

void LocalStresses::add_held(const InteractionRegion& region, const HeldTurn& held) {
  const Subcell& subcell = region.subcells[held.subcell];
  for (int i = 0; i < dimension; ++i) {
    const Point couple = held.strength / subcell.measure * traction_of(held.of_gradient, subcell.half_face[i]);
    for (int c = 0; c < dimension; ++c) {
      double* row = system_.data() + (dimension * subcell.subfaces[i] + c) * width_;
      add_gradient(region, row, held.subcell, couple[c] * held.of_gradient);
      add_scaled(row + dimension * subfaces_, couple[c], held.of_columns.data(), columns_);
    }
  }
}

Point LocalStresses::couple_on(const InteractionRegion& region, int subface, int rotation, int subcell,
                               const Point& half_face) const {
  const int side = region.neighbours[subface][0] == subcell ? 0 : 1;
  SPREKK_ASSERT(region.neighbours[subface][side] == subcell, subface, subcell);
  return jump_[subface].strength[side] / region.subcells[subcell].measure *
         traction_of(jump_[subface].of[rotation].of_gradient[side], half_face);
}

void LocalStresses::find_gradients(const InteractionRegion& region) {
  gradients_.assign(gradient_entries * subcells_ * columns_, 0);
  volumes_.assign(subcells_ * columns_, 0);
  for (int k = 0; k < subcells_; ++k) {
    const Subcell& subcell = region.subcells[k];
    for (int c = 0; c < dimension; ++c)
      for (int d = 0; d < dimension; ++d) {
        double* gradient = gradients_.data() + (gradient_entries * k + dimension * c + d) * columns_;
        double of_cell = 0;
        for (int i = 0; i < dimension; ++i) {
          add_scaled(gradient, subcell.gradient[i][d], displacement(subcell.subfaces[i], c), columns_);
          of_cell += subcell.gradient[i][d];
        }
        gradient[dimension * column(k) + c] -= of_cell;
      }
    const double* gradient = gradients_.data() + gradient_entries * k * columns_;
    double* volume = volumes_.data() + k * columns_;
    for (int c = 0; c < dimension; ++c)
      add_scaled(volume, subcell.measure, gradient + (dimension + 1) * c * columns_, columns_);
  }
  turns_.assign(rotations * subfaces_ * columns_, 0);
  for (int f = 0; f < subfaces_; ++f) {
    if (!region.is_inner(f)) continue;
    for (int m = 0; m < rotations; ++m)
      add_jump(region, f, jump_[f].of[m], 1, turns_.data() + (rotations * f + m) * columns_);
  }
}

void LocalStresses::add_jump(const InteractionRegion& region, int subface, const GradientJump& jump, double factor,
                             double* row) const {
  for (int side = 0; side < 2; ++side) {
    const int k = region.neighbours[subface][side];
    for (int e = 0; e < gradient_entries; ++e)
      add_scaled(row, factor * jump.of_gradient[side][e], gradients_.data() + (gradient_entries * k + e) * columns_,
                 columns_);
    row[stress_column() + column(k)] += factor * (side == 0 ? jump.of_stress : -jump.of_stress);
  }
  if (load_column_[subface] != none)
    for (int e = 0; e < dimension; ++e) row[load_column_[subface] + e] += factor * jump.of_load[e];
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
  forces_.assign(dimension * subfaces_ * columns_, 0);
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
    const double* gradient = gradients_.data() + gradient_entries * k * columns_;
    for (int c = 0; c < dimension; ++c) {
      double* force = forces_.data() + (dimension * f + c) * columns_;
      for (int e = 0; e < gradient_entries; ++e) add_scaled(force, own(c, e), gradient + e * columns_, columns_);
      for (const int turning : subcell.subfaces)
        if (region.is_inner(turning))
          for (int m = 0; m < rotations; ++m)
            add_scaled(force, couple_on(region, turning, m, k, half_face)[c],
                       turns_.data() + (rotations * turning + m) * columns_, columns_);
      for (const HeldTurn& held : held_) {
        if (held.subcell != k) continue;
        const double couple = held.strength / subcell.measure * traction_of(held.of_gradient, half_face)[c];
        for (int e = 0; e < gradient_entries; ++e)
          add_scaled(force, couple * held.of_gradient[e], gradient + e * columns_, columns_);
        add_scaled(force, -couple, held.of_columns.data(), columns_);
      }
      force[stress_column() + column(k)] -= half_face[c];
      // The force on the first side; both sides together balance the load on the face.
      if (side == 1 && load_column_[f] != none) force[load_column_[f] + c] += region.shares[f];
    }
  }
}

void LocalStresses::prescribe_forces(const InteractionRegion& region, const std::vector<FaceConditions>& conditions) {
  for (int f = 0; f < subfaces_; ++f) {
    const FaceConditions& given = conditions[region.faces[f]];
    if (given.axes == ConditionAxes::of_space || given.has_spring()) continue;
    double* of_axis = forces_.data() + dimension * f * columns_;
    for (int j = 0; j < columns_; ++j) {
      Point force;
      for (int c = 0; c < dimension; ++c) force[c] = of_axis[c * columns_ + j];
      Point along = axes_[f].transpose() * force;
      for (int c = 0; c < dimension; ++c)
        if (given[c] == MechanicalCondition::traction) along[c] = j == load_column_[f] + c ? region.shares[f] : 0;
      force = axes_[f] * along;
      for (int c = 0; c < dimension; ++c) of_axis[c * columns_ + j] = force[c];
    }
  }
}

}  // namespace sprekk::poromechanics
