#include "components/poromechanics/fem/faces_together.hpp"

#include <Eigen/LU>
#include <map>
#include <utility>

#include "components/poromechanics/fem/sparse_blocks.hpp"
#include "framework/dense/cholesky.hpp"
#include "framework/dense/symmetric_eigen.hpp"

namespace sprekk::poromechanics {

namespace {

constexpr double kept_of_bending = 2;  // how much stiffer faces are, at first order, than together in their cell

/// The largest work of displacements of faces together, over that of each face or group alone: from 1 to the number of
/// faces.
double largest_ratio(const Eigen::MatrixXd& together, const Eigen::MatrixXd& alone) {
  return generalized_eigenvalues(together, alone)[together.rows() - 1];
}

auto block(auto& matrix, int i, int j) {
  return matrix.template block<dimension, dimension>(dimension * i, dimension * j);
}

/// The inverse of a stiffness in the directions that are not held.
Tensor free_compliance(const Tensor& stiffness, const HeldDirections& held) {
  if (held.is_free()) return stiffness.inverse();
  Eigen::Matrix<double, dimension, Eigen::Dynamic> free(dimension, 0);
  for (int k = 0; k < dimension; ++k)
    if (!held.is_held[k]) {
      free.conservativeResize(Eigen::NoChange, free.cols() + 1);
      free.rightCols<1>() = held.axes.col(k);
    }
  if (free.cols() == 0) return Tensor::Zero();
  if (free.cols() == 1) return free * free.transpose() / free.col(0).dot(stiffness * free.col(0));
  return free * DenseCholesky(free.transpose() * stiffness * free).solve_columns(free.transpose());
}

/// As FacesTogether::Displaced, of the faces of one group.
struct DisplacedSet {
  Eigen::MatrixXd of_force, of_given;
};

DisplacedSet displaced_set(const Eigen::MatrixXd& stiffness, const std::vector<int>& faces, const Held& held) {
  const Eigen::Index size = stiffness.rows();
  Eigen::MatrixXd held_axes = Eigen::MatrixXd::Zero(size, size), free_axes(size, size);
  Eigen::Index free = 0;
  for (std::size_t i = 0; i < faces.size(); ++i)
    for (int k = 0; k < dimension; ++k) {
      const HeldDirections& directions = held.faces[faces[i]];
      const auto first = static_cast<Eigen::Index>(dimension * i);
      if (directions.is_held[k]) {
        held_axes.col(first + k).segment<dimension>(first) = directions.axes.col(k);
      } else {
        free_axes.col(free).setZero();
        free_axes.col(free++).segment<dimension>(first) = directions.axes.col(k);
      }
    }
  if (free == 0) return {Eigen::MatrixXd::Zero(size, size), held_axes};
  const Eigen::MatrixXd axes = free_axes.leftCols(free);
  const Eigen::MatrixXd compliance =
      axes * DenseCholesky(axes.transpose() * stiffness * axes).solve_columns(axes.transpose());
  return {compliance, held_axes - compliance * stiffness * held_axes};
}

}  // namespace

FacesTogether::FacesTogether(const RawDisplacement& raw, std::vector<int> groups)
    : raw_(raw), groups_(std::move(groups)), alone_(raw.mesh.face_count(), Tensor::Zero()) {}

void FacesTogether::add(int cell, const Eigen::MatrixXd& of_unknowns) {
  const CellFaces& faces = raw_.mesh.cell_faces[cell];
  const int count = faces.size(), size = dimension * count;
  // Strains vary where faces have no forces: in cells that are no simplices, or have functions of edges.
  const bool can_bend = raw_.mesh.cell_nodes[cell].size() > dimension + 1 || (raw_.edges && raw_.edges->are_in(cell));
  const Eigen::MatrixXd together = of_unknowns.bottomRightCorner(size, size);
  Eigen::MatrixXd alone = Eigen::MatrixXd::Zero(size, size);
  bool is_one_set = true;
  for (int i = 0; i < count; ++i)
    for (int j = 0; j < count; ++j) {
      const int group = groups_[faces[i]];
      const bool is_same_set = i == j || (group != none && group == groups_[faces[j]]);
      if (is_same_set) block(alone, i, j) = block(together, i, j);
      is_one_set = is_one_set && is_same_set;
    }
  const double factor = is_one_set ? 1 : (can_bend ? kept_of_bending : 1) * largest_ratio(together, alone);
  for (int i = 0; i < count; ++i) {
    if (groups_[faces[i]] == none) {
      alone_[faces[i]] += factor * block(alone, i, i);
      continue;
    }
    for (int j = 0; j < count; ++j)
      put(of_groups_, raw_.of_face(faces[i]), raw_.of_face(faces[j]), factor * block(alone, i, j));
  }
}

void FacesTogether::add_springs(int cell, const Eigen::MatrixXd& of_unknowns) {
  const CellFaces& faces = raw_.mesh.cell_faces[cell];
  const int count = faces.size(), size = dimension * count;
  const Eigen::MatrixXd of_faces = of_unknowns.bottomRightCorner(size, size);
  for (int i = 0; i < count; ++i) {
    if (groups_[faces[i]] == none)
      alone_[faces[i]] += block(of_faces, i, i);
    else
      put(of_groups_, raw_.of_face(faces[i]), raw_.of_face(faces[i]), block(of_faces, i, i));
  }
}

std::vector<std::vector<int>> FacesTogether::of_each_group() const {
  std::map<int, std::vector<int>> grouped;
  for (int f = 0; f < raw_.mesh.face_count(); ++f)
    if (groups_[f] != none) grouped[groups_[f]].push_back(f);
  std::vector<std::vector<int>> all;
  for (auto& [group, faces] : grouped) all.push_back(std::move(faces));
  return all;
}

FacesTogether::Displaced FacesTogether::displaced(const Held& held) const {
  std::vector<Triplet> of_force, of_given;
  for (int f = 0; f < raw_.mesh.face_count(); ++f) {
    if (groups_[f] != none) continue;
    const Tensor compliance = free_compliance(alone_[f], held.faces[f]);
    Tensor axes = Tensor::Zero();
    for (int k = 0; k < dimension; ++k)
      if (held.faces[f].is_held[k]) axes.col(k) = held.faces[f].axes.col(k);
    put(of_force, raw_.of_face(f), raw_.of_face(f), compliance);
    put(of_given, raw_.of_face(f), raw_.of_face(f), axes - compliance * alone_[f] * axes);
  }
  const SparseMatrix of_groups = made(raw_.size(), raw_.size(), of_groups_);
  for (const std::vector<int>& faces : of_each_group()) {
    const int count = static_cast<int>(faces.size());
    Eigen::MatrixXd own(dimension * count, dimension * count);
    for (int i = 0; i < count; ++i)
      for (int j = 0; j < count; ++j)
        for (int k = 0; k < dimension; ++k)
          for (int l = 0; l < dimension; ++l)
            own(dimension * i + k, dimension * j + l) =
                of_groups.coeff(raw_.of_face(faces[i]) + k, raw_.of_face(faces[j]) + l);
    const DisplacedSet set = displaced_set(own, faces, held);
    for (int i = 0; i < count; ++i)
      for (int j = 0; j < count; ++j) {
        put(of_force, raw_.of_face(faces[i]), raw_.of_face(faces[j]), block(set.of_force, i, j));
        put(of_given, raw_.of_face(faces[i]), raw_.of_face(faces[j]), block(set.of_given, i, j));
      }
  }
  return {made(raw_.size(), raw_.size(), of_force), made(raw_.size(), raw_.size(), of_given)};
}

}  // namespace sprekk::poromechanics
