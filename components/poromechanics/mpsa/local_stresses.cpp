#include "components/poromechanics/mpsa/local_stresses.hpp"

#include <Eigen/QR>
#include <Eigen/SVD>
#include <algorithm>
#include <stdexcept>
#include <string>

#include "components/poromechanics/mpsa/tip_correction.hpp"
#include "framework/linear/eliminate.hpp"

namespace sprekk::poromechanics {

namespace {

/// Below this, relative to others, what a single subcell's own balance tells is left to its neighbour.
constexpr double weak = 1e-3;

/// Of what holds the rotations of neighbours together, relative to their shear modulus. Between an eighth and a half
/// errors change little (docs/numerics/poromechanics.md); far below, rotations are loose.
constexpr double rotation_strength = 0.25;

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

Adjacency local_cells(const Mesh& mesh, const std::vector<int>& tips) {
  Adjacency cells;
  std::vector<int> of_node;
  for (int node = 0; node < mesh.node_count(); ++node) {
    const auto at_node = mesh.node_cells[node];
    of_node.assign(at_node.begin(), at_node.end());
    if (at_node.size() == 1) add_cells_across(mesh, at_node[0], node, of_node);
    if (tips[node] != none) {
      const auto at_tip = mesh.node_cells[tips[node]];
      of_node.insert(of_node.end(), at_tip.begin(), at_tip.end());
    }
    cells.append_set(of_node);
  }
  return cells;
}

void LocalStresses::solve(const Mesh& mesh, const InteractionRegion& region, std::span<const int> cells,
                          const std::vector<Stiffness>& stiffness, const std::vector<FaceConditions>& conditions) {
  subcells_ = region.subcell_count();
  cells_ = static_cast<int>(cells.size());
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
  find_jumps(region, stiffness, 0);

  assemble(region, conditions);
  const auto smallest_pivot = [&] { return eliminate(system_.data(), 2 * subfaces_, width_); };
  double pivot = smallest_pivot();
  if (subcells_ > 1 && pivot < 1e-6) {
    // A stiff subcell among very soft ones, free to turn: it has to turn with them a little. The forces on it are
    // theirs, and small.
    find_jumps(region, stiffness, 0.1);
    assemble(region, conditions);
    pivot = smallest_pivot();
  }
  if (subcells_ > 1 && pivot < 1e-12)
    throw std::runtime_error("MPSA: singular local problem at a node of cell " +
                             std::to_string(region.subcells[0].cell) + " (is its stiffness positive definite?)");
  if (subcells_ == 1 && pivot < weak) {
    assemble(region, conditions);
    solve_singular(mesh, region, cells);
  }
  find_gradients(region);
  find_forces(region, stiffness);
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
  for (int f = 0; f < subfaces_; ++f) {
    if (!region.is_inner(f)) continue;
    const auto [first, second] = region.neighbours[f];
    const Subcell &one = region.subcells[first], &other = region.subcells[second];
    jump_[f] = RotationJump::across(one.half_face[region.place(f, first)], stiffness[one.cell], stiffness[other.cell]);
    // The softer rock's: with more, what it misses of a field that is not linear would load the stiffer one.
    const double strengths[2] = {one.area * shear_modulus(stiffness[one.cell]),
                                 other.area * shear_modulus(stiffness[other.cell])};
    const double both = 2 * strengths[0] * strengths[1] / (strengths[0] + strengths[1]);
    for (int side = 0; side < 2; ++side)
      jump_[f].strength[side] = rotation_strength * std::max(both, least_strength * strengths[side]);
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
    for (int c = 0; c < 2; ++c) {
      double* row = system_.data() + (2 * f + c) * width_;
      const int b_column = u_columns + load_column_[f] + c;
      if (conditions[region.faces[f]][c] == MechanicalCondition::displacement) {
        std::fill_n(row, width_, 0.0);
        row[2 * f + c] = row[b_column] = 1;
      } else {
        row[b_column] += 0.5;
      }
    }
  }
}

Point LocalStresses::couple_on(const InteractionRegion& region, int subface, int subcell,
                               const Point& half_face) const {
  const int side = region.neighbours[subface][0] == subcell ? 0 : 1;
  const GradientRow& stress = jump_[subface].of_gradient[side];
  return jump_[subface].strength[side] / region.subcells[subcell].area *
         Point(half_face[0] * stress[0] + half_face[1] * stress[1],
               half_face[0] * stress[2] + half_face[1] * stress[3]);
}

void LocalStresses::solve_singular(const Mesh& mesh, const InteractionRegion& region, std::span<const int> cells) {
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const int n = 2 * subfaces_;
  Eigen::Map<RowMajor> system(system_.data(), n, width_);
  for (int i = 0; i < n; ++i) system.row(i) /= system.row(i).head(n).cwiseAbs().maxCoeff();
  Eigen::JacobiSVD<Eigen::MatrixXd> svd(system.leftCols(n), Eigen::ComputeFullU | Eigen::ComputeFullV);
  svd.setThreshold(weak);
  Eigen::MatrixXd solution = svd.solve(system.rightCols(columns_));
  if (cells_ > 1) {
    // What is free is chosen so that the subcell's linear displacement, continued to the centres of the cells across,
    // comes as near as it can to their displacements.
    const Subcell& subcell = region.subcells[0];
    const int targets = 2 * (cells_ - 1);
    Eigen::MatrixXd continuation = Eigen::MatrixXd::Zero(targets, n);
    Eigen::MatrixXd target = Eigen::MatrixXd::Zero(targets, columns_);
    int row = 0;
    for (int other = 0; other < cells_; ++other) {
      if (other == column(0)) continue;
      const Point arm = mesh.cell_center[cells[other]] - mesh.cell_center[subcell.cell];
      for (int c = 0; c < 2; ++c, ++row) {
        target(row, 2 * other + c) = 1;
        target(row, 2 * column(0) + c) = -1;
        for (int i = 0; i < 2; ++i) {
          const double weight = subcell.gradient[i].dot(arm);
          continuation(row, 2 * subcell.subfaces[i] + c) += weight;
          target(row, 2 * column(0) + c) += weight;
        }
      }
    }
    const Eigen::MatrixXd free = svd.matrixV().rightCols(n - svd.rank());
    const Eigen::MatrixXd response = continuation * free;
    solution += free * response.completeOrthogonalDecomposition().solve(target - continuation * solution);
  }
  system.rightCols(columns_) = solution;
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
    add_scaled(volume, subcell.area, gradient, columns_);
    add_scaled(volume, subcell.area, gradient + 3 * columns_, columns_);
  }
  turns_.assign(subfaces_ * columns_, 0);
  for (int f = 0; f < subfaces_; ++f) {
    if (!region.is_inner(f)) continue;
    const RotationJump& jump = jump_[f];
    double* turn = turns_.data() + f * columns_;
    for (int side = 0; side < 2; ++side) {
      const int k = region.neighbours[f][side];
      for (int e = 0; e < 4; ++e)
        add_scaled(turn, jump.of_gradient[side][e], gradients_.data() + (4 * k + e) * columns_, columns_);
      turn[stress_column() + column(k)] += side == 0 ? jump.of_stress : -jump.of_stress;
    }
    if (load_column_[f] != none)
      for (int e = 0; e < 2; ++e) turn[load_column_[f] + e] += jump.of_load[e];
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
      // That of the first side, which bears with the second what loads the face.
      if (side == 1 && load_column_[f] != none) force[load_column_[f] + c] += 0.5;
    }
  }
}

}  // namespace sprekk::poromechanics
