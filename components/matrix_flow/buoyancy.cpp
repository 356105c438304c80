#include "components/matrix_flow/buoyancy.hpp"

#include "framework/discretization/changes_along_face.hpp"
#include "framework/field/ownership.hpp"
#include "framework/field/wall_matrices.hpp"
#include "framework/invariants.hpp"
#include "framework/matrix_of.hpp"
#include "framework/mesh/cell_sums.hpp"

namespace sprekk::matrix_flow {

/// Makes the rows of one quantity.
class Buoyancy::RowMaker {
 public:
  RowMaker(const Buoyancy& of, const std::vector<FlowCondition>& conditions)
      : of_(of), mesh_(of.mesh_), conditions_(conditions) {}

  /// Subtracts matrix · P of cells, of faces with unknowns, and of prescribed pressures.
  void subtract_cells(const SparseMatrix& matrix) {
    for_each(matrix, [&](int row, int cell, double value) { add_to_cell(row, -value, cell); });
  }
  void subtract_faces(const SparseMatrix& matrix) {
    for_each(matrix, [&](int row, int face, double value) {
      // By the middle of its cells, so that densities that are linear need no value at the face itself.
      const Point g = gravity(row), from = middle(row), to = middle(face);
      const double half = -0.5 * value * g.dot(to - from);
      add_mean(row, half, row);
      add_mean(row, half - value * g.dot(mesh_.face_center[face] - to), face);
    });
  }
  void subtract_boundary(const SparseMatrix& matrix, const SparseMatrix& change) {
    for_each(matrix, [&](int row, int face, double value) {
      if (conditions_[face] == FlowCondition::pressure) add_to_boundary(row, -value, face);
    });
    for_each(change, [&](int row, int column, double value) {
      const int face = column / directions_of_faces;
      if (conditions_[face] != FlowCondition::pressure) return;
      const Point direction = directions_of_face(mesh_, face)[column % directions_of_faces];
      add_boundary(row, -value * gravity(row).dot(direction), face);
    });
  }
  /// Adds P at walls.
  void add_walls() {
    for (int w = 0; w < mesh_.wall_count(); ++w) {
      const int face = mesh_.wall_face(w);
      const double half = 0.5 * gravity(face).dot(mesh_.face_center[face] - middle(face));
      add_mean(face, half, face);
      if (of_.in_fractures_)
        walls_.emplace_back(face, w / 2, half);
      else
        add_mean(face, half, face);
    }
  }
  /// Adds P at leaky sides, with the density of the cell.
  void add_sides(const std::vector<char>& leaky) {
    for (int face = 0; face < static_cast<int>(leaky.size()); ++face)
      if (leaky[face]) add_mean(face, gravity(face).dot(mesh_.face_center[face] - middle(face)), face);
  }

  Rows rows() const {
    const auto matrix = [&](const std::vector<Triplet>& entries, int columns) {
      return matrix_of(mesh_.face_count(), columns, entries);
    };
    return {matrix(cells_, mesh_.cell_count()), matrix(boundaries_, mesh_.face_count()),
            matrix(walls_, mesh_.fracture_cell_count())};
  }

 private:
  template <class Do>
  static void for_each(const SparseMatrix& matrix, const Do& act) {
    for (int row = 0; row < matrix.outerSize(); ++row)
      for (SparseMatrix::InnerIterator entry(matrix, row); entry; ++entry)
        act(static_cast<int>(entry.row()), static_cast<int>(entry.col()), entry.value());
  }
  Point gravity(int row) const { return of_.gravity_.at({mesh_.face_center[row], 0, 0}); }
  Point middle(int face) const {
    const auto [cell, other] = mesh_.face_cells[face];
    if (other == none) return mesh_.cell_center[cell];
    return 0.5 * (mesh_.cell_center[cell] + mesh_.cell_center[other]);
  }
  /// Adds factor · d in the middle of the cells at a face.
  void add_mean(int row, double factor, int face) {
    const auto [cell, other] = mesh_.face_cells[face];
    cells_.emplace_back(row, cell, other == none ? factor : 0.5 * factor);
    if (other != none) cells_.emplace_back(row, other, 0.5 * factor);
  }
  void add_boundary(int row, double factor, int face) {
    if (of_.in_rock_.at_boundary(face, 0))
      boundaries_.emplace_back(row, face, factor);
    else
      cells_.emplace_back(row, mesh_.face_cells[face][0], factor);
  }
  /// Adds factor · P at the centre of a cell.
  void add_to_cell(int row, double factor, int cell) {
    const double half = 0.5 * factor * gravity(row).dot(mesh_.cell_center[cell] - middle(row));
    add_mean(row, half, row);
    cells_.emplace_back(row, cell, half);
  }
  /// Adds factor · P at the centre of a face with a pressure; without a density there, by the centre of its cell.
  void add_to_boundary(int row, double factor, int face) {
    const int cell = mesh_.face_cells[face][0];
    if (!of_.in_rock_.at_boundary(face, 0)) {
      add_to_cell(row, factor, cell);
      return add_boundary(row, factor * gravity(row).dot(mesh_.face_center[face] - mesh_.cell_center[cell]), face);
    }
    const double half = 0.5 * factor * gravity(row).dot(mesh_.face_center[face] - middle(row));
    add_mean(row, half, row);
    add_boundary(row, half, face);
  }

  const Buoyancy& of_;
  const Mesh& mesh_;
  const std::vector<FlowCondition>& conditions_;
  std::vector<Triplet> cells_, boundaries_, walls_;
};

Buoyancy::Buoyancy(const Mesh& mesh, const VectorData& gravity, double constant_density, const FluidDensity& in_rock,
                   const FluidDensity* in_fractures)
    : mesh_(mesh),
      gravity_(gravity),
      constant_density_(constant_density),
      in_rock_(in_rock),
      in_fractures_(in_fractures) {}

void Buoyancy::discretize(const FluxOperators& operators, const std::vector<FlowCondition>& conditions,
                          const std::vector<char>& leaky_sides) {
  RowMaker flux(*this, conditions), trace(*this, conditions), continuity(*this, conditions);
  flux.subtract_cells(operators.flux_cell);
  flux.subtract_faces(operators.faces.flux);
  flux.subtract_boundary(operators.flux_boundary, operators.flux_change);
  flux_ = flux.rows();
  trace.subtract_cells(operators.trace_cell);
  trace.subtract_faces(operators.faces.trace);
  trace.subtract_boundary(operators.trace_boundary, operators.trace_change);
  trace.add_walls();
  trace.add_sides(leaky_sides);
  trace_ = trace.rows();
  continuity.subtract_cells(operators.faces.continuity_cell);
  continuity.subtract_faces(operators.faces.continuity_face);
  continuity.subtract_boundary(operators.faces.continuity_boundary, SparseMatrix());
  continuity_ = continuity.rows();
  for (const int side : {0, 1}) {
    RowMaker limited(*this, conditions);
    limited.subtract_cells(operators.limited[side].cell);
    limited.subtract_boundary(operators.limited[side].boundary, operators.limited[side].change);
    limited_[side] = limited.rows();
  }
}

void Buoyancy::begin_step(const std::vector<FlowCondition>& conditions, const Vector& boundary_pressure) {
  Vector excess = Vector::Zero(mesh_.face_count());
  for (int f = 0; f < mesh_.face_count(); ++f)
    if (conditions[f] == FlowCondition::pressure)
      if (const std::optional<double> density = in_rock_.at_boundary(f, boundary_pressure[f]))
        excess[f] = *density - constant_density_;
  SPREKK_ASSERT(is_finite(excess));
  for (Rows* rows : {&flux_, &trace_, &continuity_, &limited_[0], &limited_[1]})
    rows->of_boundaries = rows->boundaries * excess;
}

Vector Buoyancy::excess(FluidDensity::State state) const { return in_rock_.values(state).array() - constant_density_; }

std::array<FluidDensity::Version, 2> Buoyancy::wall_versions() const {
  const auto now = FluidDensity::State::now;
  return {in_rock_.version(now), in_fractures_ ? in_fractures_->version(now) : FluidDensity::Version{}};
}

/// Adds matrix · density to an expression, linearized about the current state.
void Buoyancy::add_linearized(LinearExpression& expression, const SparseMatrix& matrix,
                              const FluidDensity& density) const {
  expression.constant += matrix * Vector(density.values(FluidDensity::State::now).array() - constant_density_);
  for (const FluidDensity::Derivative& by : density.derivatives()) {
    const Operator term{SparseMatrix(matrix * by.values.asDiagonal())};
    expression.constant -= term.entries() * by.field->now();
    expression.terms.push_back({by.field, term});
  }
}

void Buoyancy::add_to_sides(LinearExpression& expression, const std::vector<char>& leaky_sides) const {
  std::vector<char> owned = leaky_sides;
  for (int f = 0; f < mesh_.face_count(); ++f) owned[f] = owned[f] && is_owned(mesh_, Location::face, f);
  for (int f = 0; f < mesh_.face_count(); ++f)
    if (owned[f]) expression.constant[f] += trace_.of_boundaries[f];
  add_linearized(expression, keep_rows(trace_.cells, owned), in_rock_);
}

void Buoyancy::add_to_walls(LinearExpression& expression) const {
  const SparseMatrix pick_walls = owned_walls_of_faces(mesh_);
  expression.constant += pick_walls * trace_.of_boundaries;
  add_linearized(expression, pick_walls * trace_.cells, in_rock_);
  if (in_fractures_) add_linearized(expression, pick_walls * trace_.walls, *in_fractures_);
}

}  // namespace sprekk::matrix_flow
