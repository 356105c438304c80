// The local problem of a node that has few subcells, at corners and edges of the rock, where the subcells may turn
// about the line through their centres.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "components/poromechanics/mpsa/local_stresses.hpp"
#include "framework/dense/symmetric_eigen.hpp"
#include "framework/invariants.hpp"
#include "framework/linear/eliminate.hpp"

namespace sprekk::poromechanics {
namespace {

/// How points are scattered about their mean.
struct Scatter {
  Point mean = Point::Zero();
  Eigen::Vector3d width;   ///< root of the sum of squares along the principal axes, ascending, m
  Eigen::Matrix3d axes;    ///< a column each
  std::vector<Point> arm;  ///< of the points from their mean

  Scatter(const Mesh& mesh, std::span<const int> cells) {
    for (const int cell : cells) mean += mesh.cell_center[cell] / static_cast<double>(cells.size());
    Eigen::MatrixXd squares = Eigen::MatrixXd::Zero(3, 3);
    for (const int cell : cells) {
      arm.emplace_back(mesh.cell_center[cell] - mean);
      squares += arm.back() * arm.back().transpose();
    }
    const SymmetricEigen eigen = symmetric_eigen(squares);
    width = eigen.values.cwiseMax(0).cwiseSqrt();
    axes = eigen.vectors;
  }
};

/// The linear displacement that fits those of some cells best (least squares): its gradient is the sum of (u of the
/// cell) ⊗ weight. Where the centres lie in one plane or on one line, the change across it is what strains least.
struct LinearFit {
  std::vector<int> cells;
  std::vector<Point> weight;           ///< of the cells, 1/m
  Tensor across = Tensor::Identity();  ///< projects onto the directions across, along which centres do not differ
  int rank = 0;                        ///< how many directions there are along which they do

  LinearFit(const Mesh& mesh, std::vector<int> of_fit, double flat) : cells(std::move(of_fit)) {
    const Scatter scatter(mesh, cells);
    Tensor inverse = Tensor::Zero();
    for (int k = 0; k < 3; ++k) {
      if (!(scatter.width[k] > flat * scatter.width[2])) continue;
      const Tensor along = scatter.axes.col(k) * scatter.axes.col(k).transpose();
      inverse += along / (scatter.width[k] * scatter.width[k]);
      across -= along;
      ++rank;
    }
    for (const Point& arm : scatter.arm) weight.emplace_back(inverse * arm);
  }

  /// What a function of the gradient is for a unit displacement of one of the cells along an axis.
  double value(const GradientRow& function, int place, int axis) const {
    Tensor gradient = -weight[place] * across.row(axis);
    gradient.row(axis) += weight[place].transpose();
    double value = 0;
    for (int e = 0; e < gradient_entries; ++e) value += function[e] * gradient(e / dimension, e % dimension);
    return value;
  }
};

/// The fit for a cell: of those cells that are of its rock, where these are enough. So it is exact in layers, too.
LinearFit fit_for(int cell, const Mesh& mesh, std::span<const int> cells, const std::vector<Stiffness>& stiffness,
                  double flat) {
  LinearFit fit(mesh, {cells.begin(), cells.end()}, flat);
  std::vector<int> of_rock;
  std::ranges::copy_if(cells, std::back_inserter(of_rock),
                       [&](int other) { return stiffness[other] == stiffness[cell]; });
  if (of_rock.size() == cells.size()) return fit;
  LinearFit of_one(mesh, std::move(of_rock), flat);
  return of_one.rank == fit.rank ? of_one : fit;
}

}  // namespace

std::vector<int> cells_and_beyond(const Mesh& mesh, int node, const MpsaLimits& limits) {
  const auto at_node = mesh.node_cells[node];
  std::vector<int> cells(at_node.begin(), at_node.end());
  if (cells.size() > few_subcells) return cells;
  // Cells two faces away are enough, on one side of a border between two rocks, too, unless they are nearly in one
  // plane. Where the mesh has one layer, more do not help.
  constexpr double solid = 0.2;  // least ratio of widths: errors of the fit are at most some times those of cells
  constexpr int enough_layers = 2, most_layers = 3;
  for (int layer = 0; layer < most_layers; ++layer) {
    const std::vector<int> inner = cells;
    for (const int cell : inner)
      for (const int face : mesh.cell_faces[cell]) {
        const int across = mesh.face_cells[face][mesh.face_cells[face][0] == cell ? 1 : 0];
        if (across != none && std::ranges::find(cells, across) == cells.end()) cells.push_back(across);
      }
    std::ranges::sort(cells);
    if (layer + 1 < enough_layers) continue;
    const Scatter scatter(mesh, cells);
    if (scatter.width[0] > solid * scatter.width[2]) break;
  }
  SPREKK_ASSERT(limits.flat < solid, limits.flat);
  return cells;
}

void LocalStresses::solve_few(const Mesh& mesh, const InteractionRegion& region, std::span<const int> cells,
                              const std::vector<Stiffness>& stiffness, const std::vector<FaceConditions>& conditions) {
  std::vector<int> own;
  for (const Subcell& subcell : region.subcells) own.push_back(subcell.cell);
  const Scatter scatter(mesh, own);
  // A single subcell turns about any axis; two turn about the line through their centres, and three do so the less, the
  // farther their centres are from a line.
  const double off_line = subcells_ == 1 ? 0 : scatter.width[1] / scatter.width[2];
  // What a rotation moves prescribed displacements by.
  Tensor moved = Tensor::Zero();
  double arms = 0;
  for (const Subcell& subcell : region.subcells)
    for (const int f : subcell.subfaces) {
      if (region.is_inner(f)) continue;
      const Point arm = mesh.face_center[region.faces[f]] - mesh.cell_center[subcell.cell];
      arms += arm.squaredNorm();
      for (int c = 0; c < dimension; ++c) {
        if (conditions[region.faces[f]][c] != MechanicalCondition::displacement) continue;
        const Point by = arm.cross(axes_[f].col(c));
        moved += by * by.transpose();
      }
    }
  const Tensor about = subcells_ == 1 ? Tensor(symmetric_eigen(moved).vectors) : Tensor(scatter.axes);
  for (int axis = subcells_ == 1 ? 0 : 2; axis < 3; ++axis) {
    const double sine = std::sqrt(std::max(0.0, about.col(axis).dot(moved * about.col(axis)) / arms));
    const double open = 1 - std::clamp((sine - limits_.vague) / (limits_.certain - limits_.vague), 0.0, 1.0);
    const double part = (1 - off_line) * (1 - off_line) * open;
    if (!(part > 0)) continue;
    GradientRow turn = GradientRow::Zero();
    for (int m = 0; m < rotations; ++m) turn += about(m, axis) * rotation_of_gradient(m);
    for (int k = 0; k < subcells_; ++k) {
      const Subcell& subcell = region.subcells[k];
      const LinearFit fit = fit_for(subcell.cell, mesh, cells, stiffness, limits_.flat);
      HeldTurn held{k, turn,
                    part * limits_.rotation_strength * subcell.measure * shear_modulus(stiffness[subcell.cell]),
                    std::vector<double>(columns_)};
      for (std::size_t i = 0; i < fit.cells.size(); ++i) {
        const auto at = std::ranges::lower_bound(cells, fit.cells[i]) - cells.begin();
        for (int c = 0; c < dimension; ++c)
          held.of_columns[dimension * at + c] = fit.value(turn, static_cast<int>(i), c);
      }
      held_.push_back(std::move(held));
    }
  }
  assemble(region, conditions);
  if (eliminate(system_.data(), dimension * subfaces_, width_) < limits_.singular)
    throw unsolvable_region("MPSA", mesh, region, "stiffness");
}

}  // namespace sprekk::poromechanics
