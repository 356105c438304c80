// The local problem of a node that has one subcell, at a corner of the rock: the balances of two faces alone may not
// determine it.
#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "components/poromechanics/mpsa/local_stresses.hpp"
#include "framework/dense/least_squares.hpp"
#include "framework/dense/svd.hpp"
#include "framework/invariants.hpp"

namespace sprekk::poromechanics {
namespace {

/// Displacements at the centres of other cells: as functions of q, and what they are, over their scale.
struct Continuation {
  Eigen::Matrix<double, Eigen::Dynamic, 4, Eigen::RowMajor> of_q;
  Eigen::MatrixXd values;
};

/// The q with known q = value; rows have length one. Prescribed displacements (`held`) hold. In the components of q
/// that they leave free, forces determine q along the singular vectors, each to the degree that its singular value is
/// large: two faces with nearly equal forces hardly determine the stress along them, and the error of the normal of a
/// curved side is larger than that. The remaining components continue the displacement of the cells across to their
/// centres, by least squares.
Eigen::MatrixXd determine(const Eigen::Matrix4d& known, const Eigen::MatrixXd& value, const std::vector<int>& held,
                          const std::vector<int>& forces, const Continuation& across, const MpsaLimits& limits) {
  Eigen::MatrixXd q = Eigen::MatrixXd::Zero(4, value.cols());
  Eigen::MatrixXd free = Eigen::MatrixXd::Identity(4, 4);
  if (!held.empty()) {
    const Eigen::MatrixXd rows = known(held, Eigen::all);
    const DenseSvd svd(rows, Eigen::ComputeFullU | Eigen::ComputeFullV);
    q = svd.solve(Eigen::MatrixXd(value(held, Eigen::all)));
    free = svd.matrixV().rightCols(forces.size()).eval();
  }
  if (forces.empty()) return q;
  const Eigen::MatrixXd rows = known(forces, Eigen::all);
  const DenseSvd svd(rows * free, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Eigen::MatrixXd along = svd.matrixU().transpose() * (value(forces, Eigen::all) - rows * q);
  const Eigen::MatrixXd directions = free * svd.matrixV();
  std::vector<int> open;
  Eigen::VectorXd weight = Eigen::VectorXd::Zero(forces.size());
  for (int i = 0; i < weight.size(); ++i) {
    const double sine = svd.singularValues()[i];
    const double part = std::clamp((sine - limits.vague) / (limits.certain - limits.vague), 0.0, 1.0);
    if (part < 1) {
      open.push_back(i);
      weight[i] = std::sqrt(part / (1 - part));
    } else {
      q += directions.col(i) * along.row(i) / sine;
    }
  }
  if (open.empty()) return q;
  const auto targets = static_cast<int>(across.of_q.rows()), count = static_cast<int>(open.size());
  const Eigen::MatrixXd opened = directions(Eigen::all, open);
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(targets + count, count);
  Eigen::MatrixXd target = Eigen::MatrixXd::Zero(targets + count, value.cols());
  for (int row = 0; row < targets; ++row) {
    const Eigen::RowVector4d reached = across.of_q.row(row);
    matrix.row(row) = reached * opened;
    target.row(row) = -reached * q;
    target.row(row) += across.values.row(row);
  }
  for (int i = 0; i < count; ++i) {
    matrix(targets + i, i) = weight[open[i]];
    if (weight[open[i]] > 0)
      target.row(targets + i) = weight[open[i]] / svd.singularValues()[open[i]] * along.row(open[i]);
  }
  return q + opened * LeastSquares(matrix).solve_columns(target);
}

}  // namespace

/// Those across the faces that do not touch the node: one at most of a triangle, two of a quadrilateral.
std::vector<int> cells_and_beyond(const Mesh& mesh, int node, const MpsaLimits&) {
  const auto at_node = mesh.node_cells[node];
  std::vector<int> cells(at_node.begin(), at_node.end());
  if (at_node.size() > few_subcells) return cells;
  for (const int face : mesh.cell_faces[at_node[0]]) {
    if (mesh.face_nodes[face][0] == node || mesh.face_nodes[face][1] == node) continue;
    const int across = mesh.face_cells[face][mesh.face_cells[face][0] == at_node[0] ? 1 : 0];
    if (across != none) cells.push_back(across);
  }
  std::ranges::sort(cells);
  return cells;
}

void LocalStresses::solve_few(const Mesh& mesh, const InteractionRegion& region, std::span<const int> cells,
                              const std::vector<Stiffness>& stiffness, const std::vector<FaceConditions>& conditions) {
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const Subcell& subcell = region.subcells[0];
  const Stiffness& rock = stiffness[subcell.cell];
  SPREKK_EXPECT(is_symmetric(rock), subcell.cell);
  Eigen::Map<RowMajor> system(system_.data(), 4, width_);

  // In place of the displacements of the faces: q, the strain and the rotation, each as the root of its energy. Then
  // angles between what is known do not depend on axes, shape or moduli.
  Eigen::Matrix4d strain_and_rotation;  // (xx, yy, 2 xy; yx − xy) of the gradient
  strain_and_rotation << 1, 0, 0, 0, 0, 0, 0, 1, 0, 1, 1, 0, 0, -1, 1, 0;
  Eigen::Matrix4d root = Eigen::Matrix4d::Zero();
  root.topLeftCorner<3, 3>() = Eigen::LLT<Stiffness>(rock).matrixU();
  root(3, 3) = std::sqrt(shear_modulus(rock));
  const Eigen::Matrix4d gradient = (root * strain_and_rotation).inverse();  // of q
  Eigen::Matrix4d arms = Eigen::Matrix4d::Zero();  // displacements of the faces less the cell's, of the gradient
  for (int i = 0; i < 2; ++i) {
    const Point arm = mesh.face_center[region.faces[subcell.subfaces[i]]] - mesh.cell_center[subcell.cell];
    for (int c = 0; c < 2; ++c) arms.block<1, 2>(2 * subcell.subfaces[i] + c, 2 * c) = arm.transpose();
  }
  Eigen::MatrixXd of_cell = Eigen::MatrixXd::Zero(4, columns_);  // the cell's displacement, on either face
  for (int i = 0; i < 4; ++i) of_cell(i, 2 * column(0) + i % 2) = 1;
  Eigen::Matrix4d known = system.leftCols<4>() * arms * gradient;
  Eigen::MatrixXd value = system.rightCols(columns_) - system.leftCols<4>() * of_cell;
  for (int i = 0; i < 4; ++i) {
    const double norm = known.row(i).norm();
    known.row(i) /= norm;
    value.row(i) /= norm;
  }

  // Which of the equations are of prescribed displacements; the cells across, to whose centres displacements continue.
  std::vector<int> held, forces;
  for (int i = 0; i < 4; ++i) {
    const int c = row_of(i / 2, 0) == i ? 0 : 1;
    const FaceConditions& given = conditions[region.faces[i / 2]];
    const double spring = axes_[i / 2].col(c).dot(given.spring * axes_[i / 2].col(c));
    const bool is_stiff = spring > limits_.holds * shear_modulus(rock);
    (given[c] == MechanicalCondition::displacement || is_stiff ? held : forces).push_back(i);
  }
  const int targets = 2 * (cells_ - 1);
  Continuation across{decltype(Continuation::of_q)(targets, 4), Eigen::MatrixXd::Zero(targets, columns_)};
  for (int other = 0, row = 0; other < cells_; ++other) {
    if (other == column(0)) continue;
    const Point arm = mesh.cell_center[cells[other]] - mesh.cell_center[subcell.cell];
    const double scale = root(3, 3) / arm.norm();
    for (int c = 0; c < 2; ++c, ++row) {
      across.of_q.row(row) = scale * (arm[0] * gradient.row(2 * c) + arm[1] * gradient.row(2 * c + 1));
      across.values(row, 2 * other + c) = scale;
      across.values(row, 2 * column(0) + c) = -scale;
    }
  }
  const Eigen::MatrixXd q = determine(known, value, held, forces, across, limits_);
  system.rightCols(columns_) = of_cell + arms * gradient * q;
}

}  // namespace sprekk::poromechanics
