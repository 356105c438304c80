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
  int outer = 0;
  for (int f = 0; f < subfaces_; ++f) outer += !region.is_inner(f);
  columns_ = 3 * cells_ + 2 * outer;
  width_ = 2 * subfaces_ + columns_;

  split_.resize(subcells_);
  for (int k = 0; k < subcells_; ++k) split_[k] = split_stiffness(stiffness[region.subcells[k].cell]);
  weigh_means(region, stiffness, 1);

  assemble(region, conditions);
  const auto smallest_pivot = [&] { return eliminate(system_.data(), 2 * subfaces_, width_); };
  double pivot = smallest_pivot();
  if (subcells_ > 1 && pivot < 1e-6) {
    // A stiff subcell among very soft ones, free to turn: it has to follow their mean gradient a little. The forces on
    // it are theirs, and small.
    weigh_means(region, stiffness, 0.9);
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

void LocalStresses::weigh_means(const InteractionRegion& region, const std::vector<Stiffness>& stiffness,
                                double most_own_share) {
  const auto stiffness_of = [&](int k) -> const Stiffness& { return stiffness[region.subcells[k].cell]; };
  bool is_even = true;
  for (int k = 1; k < subcells_ && is_even; ++k) is_even = stiffness_of(k) == stiffness_of(0);
  means_ = is_even ? 1 : subcells_;
  share_.assign(means_ * subcells_, 0);
  mean_weight_.assign(means_ * subfaces_, Point::Zero());
  for (int m = 0; m < means_; ++m) {
    double* share = share_.data() + m * subcells_;
    double others = 0;
    for (int k = 0; k < subcells_; ++k) {
      const double ratio = stiffness_of(k)(2, 2) / stiffness_of(m)(2, 2);
      share[k] = region.subcells[k].area * std::min(ratio * ratio, 1 / (ratio * ratio));
      if (k != m) others += share[k];
    }
    double sum = share[m] + others;
    if (!is_even && share[m] > most_own_share * sum) {
      // The others together count for the rest, by their areas.
      double area = 0;
      for (int k = 0; k < subcells_; ++k) area += k == m ? 0 : region.subcells[k].area;
      for (int k = 0; k < subcells_; ++k)
        share[k] = k == m ? most_own_share : (1 - most_own_share) * region.subcells[k].area / area;
      sum = 1;
    }
    for (int k = 0; k < subcells_; ++k) share[k] /= sum;
    for (int k = 0; k < subcells_; ++k)
      for (int i = 0; i < 2; ++i)
        mean_weight_[m * subfaces_ + region.subcells[k].subfaces[i]] += share[k] * region.subcells[k].gradient[i];
  }
}

void LocalStresses::assemble(const InteractionRegion& region, const std::vector<FaceConditions>& conditions) {
  system_.assign(2 * subfaces_ * width_, 0);
  const int u_columns = 2 * subfaces_, s_columns = u_columns + 2 * cells_;
  int b_column = s_columns + cells_;
  for (int f = 0; f < subfaces_; ++f) {
    double* rows[2] = {system_.data() + 2 * f * width_, system_.data() + (2 * f + 1) * width_};
    // The forces out of the neighbours add up to zero, or to the half of what is prescribed for the face.
    ForceMap of_mean[2] = {ForceMap::Zero(), ForceMap::Zero()};
    for (int side = 0; side < 2; ++side) {
      const int k = region.neighbours[f][side];
      if (k == none) continue;
      const Subcell& subcell = region.subcells[k];
      const Point& half_face = subcell.half_face[region.place(f, k)];
      const ForceMap own = force_map(split_[k].own, half_face);
      of_mean[means_ == 1 ? 0 : side] += force_map(split_[k].mean, half_face);
      for (int c = 0; c < 2; ++c) {
        for (int i = 0; i < 2; ++i)
          for (int e = 0; e < 2; ++e) {
            const double weight = own(c, 2 * e) * subcell.gradient[i][0] + own(c, 2 * e + 1) * subcell.gradient[i][1];
            rows[c][2 * subcell.subfaces[i] + e] += weight;
            rows[c][u_columns + 2 * column(k) + e] += weight;
          }
        rows[c][s_columns + column(k)] += half_face[c];
      }
    }
    // In an even medium the shares of the mean gradient cancel between the neighbours.
    for (int side = 0; side < 2; ++side) {
      if (of_mean[side].isZero(0)) continue;
      const int m = mean_of(region.neighbours[f][side]);
      for (int c = 0; c < 2; ++c)
        for (int e = 0; e < 2; ++e) {
          const Point weight(of_mean[side](c, 2 * e), of_mean[side](c, 2 * e + 1));
          for (int g = 0; g < subfaces_; ++g) rows[c][2 * g + e] += weight.dot(mean_weight_[m * subfaces_ + g]);
          for (int k = 0; k < subcells_; ++k) {
            const Subcell& subcell = region.subcells[k];
            rows[c][u_columns + 2 * column(k) + e] +=
                share_[m * subcells_ + k] * weight.dot(subcell.gradient[0] + subcell.gradient[1]);
          }
        }
    }
    if (region.is_inner(f)) continue;
    for (int c = 0; c < 2; ++c, ++b_column) {
      if (conditions[region.faces[f]][c] == MechanicalCondition::displacement) {
        std::fill_n(rows[c], width_, 0.0);
        rows[c][2 * f + c] = rows[c][b_column] = 1;
      } else {
        rows[c][b_column] = 0.5;
      }
    }
  }
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
  gradients_.assign(4 * (subcells_ + means_) * columns_, 0);
  volumes_.assign(subcells_ * columns_, 0);
  double* means = gradients_.data() + 4 * subcells_ * columns_;
  for (int k = 0; k < subcells_; ++k) {
    const Subcell& subcell = region.subcells[k];
    for (int c = 0; c < 2; ++c)
      for (int d = 0; d < 2; ++d) {
        double* gradient = gradients_.data() + (4 * k + 2 * c + d) * columns_;
        for (int i = 0; i < 2; ++i)
          add_scaled(gradient, subcell.gradient[i][d], displacement(subcell.subfaces[i], c), columns_);
        gradient[2 * column(k) + c] -= subcell.gradient[0][d] + subcell.gradient[1][d];
        for (int m = 0; m < means_; ++m)
          add_scaled(means + (4 * m + 2 * c + d) * columns_, share_[m * subcells_ + k], gradient, columns_);
      }
    const double* gradient = gradients_.data() + 4 * k * columns_;
    double* volume = volumes_.data() + k * columns_;
    add_scaled(volume, subcell.area, gradient, columns_);
    add_scaled(volume, subcell.area, gradient + 3 * columns_, columns_);
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
    const Point half_face = (side == 0 ? 1.0 : -1.0) * region.subcells[k].half_face[region.place(f, k)];
    const ForceMap own = force_map(split_[k].own, half_face), mean = force_map(split_[k].mean, half_face);
    const double* gradient = gradients_.data() + 4 * k * columns_;
    const double* mean_gradient = gradients_.data() + 4 * (subcells_ + mean_of(k)) * columns_;
    for (int c = 0; c < 2; ++c) {
      double* force = forces_.data() + (2 * f + c) * columns_;
      for (int e = 0; e < 4; ++e) {
        add_scaled(force, own(c, e), gradient + e * columns_, columns_);
        add_scaled(force, mean(c, e), mean_gradient + e * columns_, columns_);
      }
      force[stress_column() + column(k)] -= half_face[c];
    }
  }
}

}  // namespace sprekk::poromechanics
