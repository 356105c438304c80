#include "components/poromechanics/fem/fem_operators.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <utility>

#include "components/poromechanics/fem/face_functions.hpp"
#include "components/poromechanics/fem/faces_together.hpp"
#include "components/poromechanics/fem/sparse_blocks.hpp"
#include "components/poromechanics/fem/volumetric_split.hpp"
#include "framework/invariants.hpp"

namespace sprekk::poromechanics {

namespace {

/// The stiffness for all coefficients, and for each face alone.
struct RawStiffness {
  SparseMatrix matrix;
  std::vector<Tensor> of_face;  ///< N/m per m
  FacesTogether together;       ///< at first order
  std::vector<CellPoint::Gradients> of_interior;
  std::vector<Eigen::MatrixXd> of_cells;  ///< at second order
};

RawStiffness raw_stiffness(const RawDisplacement& raw, const std::vector<int>& tips,
                           const std::vector<Stiffness>& stiffness, ElementOrder order, const Springs& springs) {
  const Mesh& mesh = raw.mesh;
  RawStiffness result{.matrix = {},
                      .of_face = std::vector<Tensor>(mesh.face_count(), Tensor::Zero()),
                      .together = FacesTogether(raw, groups_at_tips(mesh, tips)),
                      .of_interior = {},
                      .of_cells = {}};
  std::vector<Triplet> entries;
  for (int c = 0; c < mesh.cell_count(); ++c) {
    const bool is_second =
        order == ElementOrder::second || is_at_tip(mesh, tips, c) || (raw.edges && raw.edges->are_in(c));
    CellStiffness of_cell = cell_stiffness(cell_points(mesh, c, tips, raw.edges), stiffness[c],
                                           is_second ? ElementOrder::second : ElementOrder::first);
    const std::vector<int> first = raw.of_cell(c);
    const int count = static_cast<int>(first.size()), faces = mesh.cell_faces[c].size();
    for (int i = 0; i < count; ++i)
      for (int j = 0; j < count; ++j)
        put(entries, first[i], first[j], of_cell.of_unknowns.block<dimension, dimension>(dimension * i, dimension * j));
    for (int k = 0; k < faces; ++k) {
      const int at = dimension * (count - faces + k);
      result.of_face[mesh.cell_faces[c][k]] += of_cell.of_unknowns.block<dimension, dimension>(at, at);
    }
    if (order == ElementOrder::first) result.together.add(c, of_cell.of_unknowns);
    if (const auto spring = springs.find(c); spring != springs.end()) {
      for (int i = 0; i < count; ++i)
        for (int j = 0; j < count; ++j)
          put(entries, first[i], first[j], spring->second.block<dimension, dimension>(dimension * i, dimension * j));
      if (order == ElementOrder::first) result.together.add_springs(c, spring->second);
    }
    result.of_interior.push_back(std::move(of_cell.of_interior));
    if (order == ElementOrder::second) result.of_cells.push_back(std::move(of_cell.of_unknowns));
  }
  result.matrix = made(raw.size(), raw.size(), entries);
  return result;
}

/// All coefficients as functions of the unknowns where no force is left on functions of faces: at first order they are
/// those of displacements that are linear along every face.
SparseMatrix linear_functions(const RawDisplacement& raw, const std::vector<int>& tips, ElementOrder order) {
  const int unknowns = order == ElementOrder::second ? raw.size() : raw.of_face(0);
  std::vector<Triplet> entries;
  for (int i = 0; i < unknowns; ++i) entries.emplace_back(i, i, 1.0);
  for (int f = 0; order == ElementOrder::first && f < raw.mesh.face_count(); ++f) {
    if (tips[f] == none) continue;
    // The middle node lies a quarter of the face away from the tip.
    for (const int node : raw.mesh.face_nodes[f])
      for (int k = 0; k < dimension; ++k)
        entries.emplace_back(raw.of_face(f) + k, raw.of_node(node) + k, (node == tips[f] ? 1.0 : -1.0) / 4);
  }
  return made(raw.size(), unknowns, entries);
}

/// div u integrated over cells: by what flows through their faces.
SparseMatrix volume_of(const RawDisplacement& raw, const std::vector<int>& tips) {
  const Mesh& mesh = raw.mesh;
  std::vector<Triplet> entries;
  for (int f = 0; f < mesh.face_count(); ++f) {
    const std::vector<FaceFunction> functions = face_functions(raw, tips, f);
    for (int side = 0; side < 2; ++side) {
      const int cell = mesh.face_cells[f][side];
      if (cell == none) continue;
      for (const FaceFunction& function : functions)
        for (int k = 0; k < dimension; ++k)
          entries.emplace_back(cell, function.coefficient + k, (side == 0 ? 1 : -1) * function.flow[k]);
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
      for (const FaceFunction& function : face_functions(raw, tips, cell.faces[side]))
        for (int k = 0; k < dimension; ++k) {
          const Point local = (side == 0 ? -1 : 1) * cell.to_local(Point::Unit(k));
          for (int axis = 0; axis < dimension; ++axis)
            entries.emplace_back(dimension * i + axis, function.coefficient + k, function.mean * local[axis]);
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

/// All coefficients as functions of the unknowns.
LinearInFem all_coefficients(const RawDisplacement& raw, const SparseMatrix& linear, const RawStiffness& stiffness,
                             const Held& held, const SparseMatrix& volume, const SparseMatrix& traction,
                             ElementOrder order) {
  const int all = raw.size();
  LinearInFem result;
  result.of_displacement = linear;
  if (order == ElementOrder::second) {
    result.of_stress.resize(all, raw.mesh.cell_count());
    result.of_traction.resize(all, traction.cols());
    result.of_force.resize(all, all);
    result.of_given.resize(all, all);
    return result;
  }
  FacesTogether::Displaced faces = stiffness.together.displaced(held);
  result.of_displacement -= SparseMatrix(faces.of_force * stiffness.matrix * linear);
  result.of_stress = faces.of_force * SparseMatrix(volume.transpose());
  result.of_traction = faces.of_force * traction;
  result.of_force = std::move(faces.of_force);
  result.of_given = std::move(faces.of_given);
  return result;
}

/// How forces on all coefficients become the rows of the unknowns: the work in displacements of `linear`, in the axes
/// of HeldDirections, without what is held.
struct Rows {
  SparseMatrix kept;   ///< unknowns × all coefficients
  SparseMatrix held;   ///< unknowns × unknowns: stiffness times the displacement along a held axis
  SparseMatrix given;  ///< unknowns × all coefficients: the same times the given one
};

Rows rows_of(const RawDisplacement& raw, const SparseMatrix& linear, const SparseMatrix& stiffness, const Held& held) {
  const int unknowns = static_cast<int>(linear.cols());
  std::vector<Triplet> kept, of_held, given;
  for (int entity = 0; entity < unknowns / dimension; ++entity) {
    const HeldDirections& directions = held.of_entity(entity);
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
  const SparseMatrix along_axes = made(unknowns, unknowns, kept);
  return {along_axes * SparseMatrix(linear.transpose()), made(unknowns, unknowns, of_held),
          made(unknowns, raw.size(), given)};
}

Vector compliance_of_walls(const RawDisplacement& raw, const std::vector<int>& tips,
                           const std::vector<Tensor>& stiffness_of_face) {
  const Mesh& mesh = raw.mesh;
  Vector compliance = Vector::Zero(dimension * mesh.fracture_cell_count());
  for (int i = 0; i < mesh.fracture_cell_count(); ++i) {
    const FractureCell& cell = mesh.fracture_cells[i];
    for (const int face : cell.faces) {
      const Tensor alone = stiffness_of_face[face].inverse();
      const double mean_of_face = face_functions(raw, tips, face).back().mean;
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

FemOperators fem_operators(const RawDisplacement& raw, const std::vector<Stiffness>& stiffness, const Held& held,
                           ElementOrder order, bool has_volumetric_stress, const Springs& springs) {
  const Mesh& mesh = raw.mesh;
  SPREKK_EXPECT(static_cast<int>(stiffness.size()) == mesh.cell_count(), stiffness.size(), mesh.cell_count());
  SPREKK_EXPECT(order == ElementOrder::first || !has_volumetric_stress);
  const VolumetricSplit split = has_volumetric_stress ? split_volumetric(stiffness) : VolumetricSplit{stiffness, {}};
  FemOperators result;
  result.tips = tips_of_faces(mesh);
  const SparseMatrix linear = linear_functions(raw, result.tips, order);
  RawStiffness forces = raw_stiffness(raw, result.tips, split.kept, order, springs);
  result.volume = volume_of(raw, result.tips);
  result.jump = jump_of(raw, result.tips);
  result.wall_compliance = compliance_of_walls(raw, result.tips, forces.of_face);
  const SparseMatrix traction = forces_of_traction(mesh, result.jump);
  result.all = all_coefficients(raw, linear, forces, held, result.volume, traction, order);
  const LinearInFem& all = result.all;
  const Rows rows = rows_of(raw, linear, forces.matrix, held);
  const SparseMatrix to_rows = rows.kept * forces.matrix;
  result.momentum.of_displacement = SparseMatrix(to_rows * all.of_displacement) + rows.held;
  result.momentum.of_stress =
      SparseMatrix(to_rows * all.of_stress) - SparseMatrix(rows.kept * result.volume.transpose());
  result.momentum.of_traction = SparseMatrix(to_rows * all.of_traction) - SparseMatrix(rows.kept * traction);
  result.momentum.of_force = SparseMatrix(to_rows * all.of_force) - rows.kept;
  result.momentum.of_given = SparseMatrix(to_rows * all.of_given) - rows.given;
  result.of_interior = std::move(forces.of_interior);
  result.of_cells = std::move(forces.of_cells);
  result.to_rows = rows.kept;
  if (has_volumetric_stress) add_volumetric_stress(mesh, split.taken, result);
  return result;
}

}  // namespace sprekk::poromechanics
