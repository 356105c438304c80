#include "components/poromechanics/fem/fem_operators.hpp"

#include <Eigen/LU>

#include "components/poromechanics/fem/volumetric_split.hpp"
#include "framework/dense/symmetric_eigen.hpp"
#include "framework/invariants.hpp"

namespace sprekk::poromechanics {

namespace {

SparseMatrix made(int rows, int columns, const std::vector<Triplet>& entries) {
  SparseMatrix matrix(rows, columns);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

void put(std::vector<Triplet>& entries, int row, int column, const Tensor& block) {
  for (int i = 0; i < dimension; ++i)
    for (int j = 0; j < dimension; ++j)
      if (block(i, j) != 0) entries.emplace_back(row + i, column + j, block(i, j));
}

/// The stiffness for all coefficients, and for each face alone.
struct RawStiffness {
  SparseMatrix matrix;
  std::vector<Tensor> of_face;            ///< N/m per m
  std::vector<Tensor> of_face_in_shares;  ///< the same, times stiffness_together of its cells, twice in quadrilaterals
  std::vector<Eigen::Matrix2Xd> of_interior;
};

/// The largest work of displacements of faces together, over the sum of what each does alone: from 1 to the number of
/// faces.
double stiffness_together(const Eigen::MatrixXd& of_unknowns, int corners) {
  const int size = dimension * corners;
  const Eigen::MatrixXd of_faces = of_unknowns.bottomRightCorner(size, size);
  Eigen::MatrixXd alone = Eigen::MatrixXd::Zero(size, size);
  for (int at = 0; at < size; at += dimension)
    alone.block<dimension, dimension>(at, at) = of_faces.block<dimension, dimension>(at, at);
  return generalized_eigenvalues(of_faces, alone)[size - 1];
}

RawStiffness raw_stiffness(const RawDisplacement& raw, const std::vector<int>& tips,
                           const std::vector<Stiffness>& stiffness, ElementOrder order) {
  const Mesh& mesh = raw.mesh;
  RawStiffness result;
  result.of_face.assign(mesh.face_count(), Tensor::Zero());
  result.of_face_in_shares = result.of_face;
  std::vector<Triplet> entries;
  for (int c = 0; c < mesh.cell_count(); ++c) {
    CellStiffness of_cell = cell_stiffness(cell_points(mesh, c, tips), stiffness[c], order);
    const std::vector<int> first = raw.of_cell(c);
    const int count = static_cast<int>(first.size()), corners = mesh.cell_nodes[c].size();
    for (int i = 0; i < count; ++i)
      for (int j = 0; j < count; ++j)
        put(entries, first[i], first[j], of_cell.of_unknowns.block<dimension, dimension>(dimension * i, dimension * j));
    constexpr double kept_of_bending = 2;
    const double together = (corners == 4 ? kept_of_bending : 1) * stiffness_together(of_cell.of_unknowns, corners);
    for (int k = 0; k < corners; ++k) {
      const int at = dimension * (corners + k), face = mesh.cell_faces[c][k];
      const Tensor own = of_cell.of_unknowns.block<dimension, dimension>(at, at);
      result.of_face[face] += own;
      result.of_face_in_shares[face] += together * own;
    }
    result.of_interior.push_back(std::move(of_cell.of_interior));
  }
  result.matrix = made(raw.size(), raw.size(), entries);
  return result;
}

/// div u integrated over cells: by the means over faces, since the sides of cells are straight.
SparseMatrix volume_of(const RawDisplacement& raw, const std::vector<int>& tips) {
  const Mesh& mesh = raw.mesh;
  std::vector<Triplet> entries;
  for (int f = 0; f < mesh.face_count(); ++f) {
    const std::array<double, 2> means = means_of_ends(mesh, tips, f);
    for (int side = 0; side < 2; ++side) {
      const int cell = mesh.face_cells[f][side];
      if (cell == none) continue;
      const Point out = (side == 0 ? 1 : -1) * mesh.face_measure[f] * mesh.face_normal[f];
      for (int k = 0; k < dimension; ++k) {
        for (int end = 0; end < 2; ++end)
          entries.emplace_back(cell, raw.of_node(mesh.face_nodes[f][end]) + k, means[end] * out[k]);
        entries.emplace_back(cell, raw.of_face(f) + k, mean_of_face * out[k]);
      }
    }
  }
  return made(mesh.cell_count(), raw.size(), entries);
}

SparseMatrix jump_of(const RawDisplacement& raw, const std::vector<int>& tips) {
  const Mesh& mesh = raw.mesh;
  std::vector<Triplet> entries;
  for (int i = 0; i < mesh.fracture_cell_count(); ++i) {
    const FractureCell& cell = mesh.fracture_cells[i];
    for (int side = 0; side < 2; ++side) {
      const std::array<double, 2> means = means_of_ends(mesh, tips, cell.faces[side]);
      for (int k = 0; k < dimension; ++k) {
        const Point local = (side == 0 ? -1 : 1) * cell.to_local(Point::Unit(k));
        for (int axis = 0; axis < dimension; ++axis) {
          const int row = dimension * i + axis;
          for (int end = 0; end < 2; ++end)
            entries.emplace_back(row, raw.of_node(mesh.face_nodes[cell.faces[side]][end]) + k,
                                 means[end] * local[axis]);
          entries.emplace_back(row, raw.of_face(cell.faces[side]) + k, mean_of_face * local[axis]);
        }
      }
    }
  }
  return made(dimension * mesh.fracture_cell_count(), raw.size(), entries);
}

/// The forces of T on all coefficients, from the work of T in a jump.
SparseMatrix forces_of_traction(const Mesh& mesh, const SparseMatrix& jump) {
  Vector lengths(jump.rows());
  for (int i = 0; i < mesh.fracture_cell_count(); ++i)
    lengths.segment<dimension>(dimension * i).setConstant(mesh.fracture_cells[i].measure);
  return -(lengths.asDiagonal() * jump).transpose();
}

/// The inverse of a stiffness in the directions that are not held.
Tensor free_compliance(const Tensor& stiffness, const HeldDirections& held) {
  if (held.is_held[0] && held.is_held[1]) return Tensor::Zero();
  if (held.is_free()) return stiffness.inverse();
  const Point free = held.axes.col(held.is_held[0] ? 1 : 0);
  return free * free.transpose() / free.dot(stiffness * free);
}

/// All coefficients as functions of the unknowns.
LinearInFem all_coefficients(const RawDisplacement& raw, const RawStiffness& stiffness, const Held& held,
                             const SparseMatrix& volume, const SparseMatrix& traction, ElementOrder order) {
  const Mesh& mesh = raw.mesh;
  const int all = raw.size(), unknowns = order == ElementOrder::second ? all : raw.nodes_size();
  LinearInFem result;
  std::vector<Triplet> ones;
  for (int i = 0; i < unknowns; ++i) ones.emplace_back(i, i, 1.0);
  result.of_displacement = made(all, unknowns, ones);
  if (order == ElementOrder::second) {
    result.of_stress.resize(all, mesh.cell_count());
    result.of_traction.resize(all, traction.cols());
    result.of_force.resize(all, all);
    result.of_given.resize(all, all);
    return result;
  }
  std::vector<Triplet> compliances, given;
  for (int f = 0; f < mesh.face_count(); ++f) {
    const int at = raw.of_face(f);
    const HeldDirections& of_face = held.faces[f];
    const Tensor compliance = free_compliance(stiffness.of_face_in_shares[f], of_face);
    put(compliances, at, at, compliance);
    Tensor axes = Tensor::Zero();
    for (int k = 0; k < dimension; ++k)
      if (of_face.is_held[k]) axes.col(k) = of_face.axes.col(k);
    put(given, at, at, axes - compliance * stiffness.of_face_in_shares[f] * axes);
  }
  const SparseMatrix compliance = made(all, all, compliances);
  result.of_displacement -= SparseMatrix(compliance * stiffness.matrix * result.of_displacement);
  result.of_stress = compliance * SparseMatrix(volume.transpose());
  result.of_traction = compliance * traction;
  result.of_force = compliance;
  result.of_given = made(all, all, given);
  return result;
}

/// How rows of forces become those of the unknowns: in the axes of HeldDirections, without what is held.
struct Rows {
  SparseMatrix kept;   ///< unknowns × all coefficients
  SparseMatrix held;   ///< unknowns × unknowns: stiffness times the displacement along a held axis
  SparseMatrix given;  ///< unknowns × all coefficients: the same times the given one
};

Rows rows_of(const RawDisplacement& raw, const SparseMatrix& stiffness, const Held& held, int unknowns) {
  std::vector<Triplet> kept, of_held, given;
  const int nodes = raw.mesh.node_count();
  for (int entity = 0; entity < unknowns / dimension; ++entity) {
    const HeldDirections& directions = entity < nodes ? held.nodes[entity] : held.faces[entity - nodes];
    const int at = dimension * entity;
    double scale = 0;
    for (int k = 0; k < dimension; ++k) scale = std::max(scale, stiffness.coeff(at + k, at + k));
    for (int k = 0; k < dimension; ++k) {
      std::vector<Triplet>& entries = directions.is_held[k] ? of_held : kept;
      const double factor = directions.is_held[k] ? scale : 1;
      for (int j = 0; j < dimension; ++j)
        if (directions.axes(j, k) != 0) entries.emplace_back(at + k, at + j, factor * directions.axes(j, k));
      if (directions.is_held[k]) given.emplace_back(at + k, at + k, scale);
    }
  }
  return {made(unknowns, raw.size(), kept), made(unknowns, unknowns, of_held), made(unknowns, raw.size(), given)};
}

Vector compliance_of_walls(const Mesh& mesh, const std::vector<Tensor>& stiffness_of_face) {
  Vector compliance = Vector::Zero(dimension * mesh.fracture_cell_count());
  for (int i = 0; i < mesh.fracture_cell_count(); ++i) {
    const FractureCell& cell = mesh.fracture_cells[i];
    for (const int face : cell.faces) {
      const Tensor alone = stiffness_of_face[face].inverse();
      for (int axis = 0; axis < dimension; ++axis) {
        const Point direction = cell.to_global(Point::Unit(axis));
        compliance[dimension * i + axis] +=
            mean_of_face * mean_of_face * cell.measure * direction.dot(alone * direction);
      }
    }
  }
  return compliance;
}

SparseMatrix above(const SparseMatrix& top, const SparseMatrix& bottom) {
  SparseMatrix both(top.rows() + bottom.rows(), top.cols());
  both.middleRows(0, top.rows()) = top;
  both.middleRows(top.rows(), bottom.rows()) = bottom;
  return both;
}

SparseMatrix beside(const SparseMatrix& left, const SparseMatrix& right) {
  return SparseMatrix(above(left.transpose(), right.transpose()).transpose());
}

/// Makes the volumetric stress q of cells an unknown: it acts where s does, with rows q + taken · (mean of div u).
void add_volumetric_stress(const Mesh& mesh, const Vector& taken, FemOperators& operators) {
  const int cells = mesh.cell_count();
  for (LinearInFem* quantity : {&operators.all, &operators.momentum})
    quantity->of_displacement = beside(quantity->of_displacement, quantity->of_stress);
  Vector scale(cells);
  for (int c = 0; c < cells; ++c) scale[c] = taken[c] / mesh.cell_measure[c];
  const SparseMatrix mean = scale.asDiagonal() * operators.volume;
  const LinearInFem& all = operators.all;
  LinearInFem rows{mean * all.of_displacement, mean * all.of_stress, mean * all.of_traction, mean * all.of_force,
                   mean * all.of_given};
  SparseMatrix own(cells, all.of_displacement.cols());
  for (int c = 0; c < cells; ++c) own.insert(c, static_cast<int>(own.cols()) - cells + c) = 1;
  rows.of_displacement += own;
  LinearInFem& momentum = operators.momentum;
  momentum.of_displacement = above(momentum.of_displacement, rows.of_displacement);
  momentum.of_stress = above(momentum.of_stress, rows.of_stress);
  momentum.of_traction = above(momentum.of_traction, rows.of_traction);
  momentum.of_force = above(momentum.of_force, rows.of_force);
  momentum.of_given = above(momentum.of_given, rows.of_given);
}

}  // namespace

FemOperators fem_operators(const Mesh& mesh, const std::vector<Stiffness>& stiffness, const Held& held,
                           ElementOrder order, bool has_volumetric_stress) {
  SPREKK_EXPECT(static_cast<int>(stiffness.size()) == mesh.cell_count(), stiffness.size(), mesh.cell_count());
  SPREKK_EXPECT(order == ElementOrder::first || !has_volumetric_stress);
  const VolumetricSplit split = has_volumetric_stress ? split_volumetric(stiffness) : VolumetricSplit{stiffness, {}};
  const RawDisplacement raw{mesh};
  FemOperators result;
  // At first order nothing of second order stands beside the linear functions of a cell.
  if (order == ElementOrder::second) result.tips = tips_of_faces(mesh);
  RawStiffness forces = raw_stiffness(raw, result.tips, split.kept, order);
  result.volume = volume_of(raw, result.tips);
  result.jump = jump_of(raw, result.tips);
  result.wall_compliance = compliance_of_walls(mesh, forces.of_face);
  const SparseMatrix traction = forces_of_traction(mesh, result.jump);
  result.all = all_coefficients(raw, forces, held, result.volume, traction, order);
  const LinearInFem& all = result.all;
  const Rows rows = rows_of(raw, forces.matrix, held, static_cast<int>(all.of_displacement.cols()));
  const SparseMatrix to_rows = rows.kept * forces.matrix;
  result.momentum.of_displacement = SparseMatrix(to_rows * all.of_displacement) + rows.held;
  result.momentum.of_stress =
      SparseMatrix(to_rows * all.of_stress) - SparseMatrix(rows.kept * result.volume.transpose());
  result.momentum.of_traction = SparseMatrix(to_rows * all.of_traction) - SparseMatrix(rows.kept * traction);
  result.momentum.of_force = SparseMatrix(to_rows * all.of_force) - rows.kept;
  result.momentum.of_given = SparseMatrix(to_rows * all.of_given) - rows.given;
  result.of_interior = std::move(forces.of_interior);
  if (has_volumetric_stress) add_volumetric_stress(mesh, split.taken, result);
  return result;
}

}  // namespace sprekk::poromechanics
