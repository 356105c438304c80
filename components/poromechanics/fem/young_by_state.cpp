// Finite elements of rock whose Young's modulus is a formula of the state.
#include <algorithm>

#include "components/poromechanics/fem/fem_rock.hpp"
#include "components/poromechanics/fem/sparse_blocks.hpp"
#include "framework/field/ownership.hpp"
#include "framework/mesh/cell_sums.hpp"

namespace sprekk::poromechanics {

void FemRock::follow_state(const Assembly& assembly) {
  if (!young_ || !assembly.has_row(displacement_) || !take_young()) return;
  if (std::ranges::any_of(loads_, &PoreLoad::follows_stiffness)) {
    used_alpha_ = 0;  // coefficients have changed
    use_loads();
    use_given();
  }
  use_young();
}

/// The stiffness of a cell is in proportion to its modulus, and so are the forces of its displacements.
void FemRock::use_young() {
  const RawDisplacement numbers = raw();
  std::vector<Triplet> entries;
  for (int c = 0; c < mesh_.cell_count(); ++c) {
    const std::vector<int> first = numbers.of_cell(c);
    const int functions = static_cast<int>(first.size());
    const Eigen::MatrixXd more = (ratio_[c] - 1) * operators_.of_cells[c];
    for (int i = 0; i < functions; ++i)
      for (int j = 0; j < functions; ++j)
        put(entries, first[i], first[j], more.block<dimension, dimension>(dimension * i, dimension * j));
  }
  const SparseMatrix more = operators_.to_rows * made(numbers.size(), numbers.size(), entries);
  int row = 0;
  for (std::size_t i = 0; i < momentum_.size(); ++i) {
    const Field& field = *unknowns()[i];
    const SparseMatrix rows = owned_rows(SparseMatrix(more.middleRows(row, field.size())), field);
    row += field.size();
    const SparseMatrix whole = momentum_[i].operators.of_displacement + rows;
    int column = 0;
    for (std::size_t k = 0; k < momentum_.size(); ++k) {
      const int size = unknowns()[k]->size();
      momentum_[i].value.terms[k].matrix = Operator(SparseMatrix(whole.middleCols(column, size)));
      column += size;
    }
  }
}

void FemRock::assemble_young(Assembly& assembly) const {
  const std::vector<Field*> fields = unknowns();
  if (std::ranges::none_of(fields, [&](const Field* field) { return assembly.has_row(*field); })) return;
  const RawDisplacement numbers = raw();
  const Vector all = coefficients();
  std::vector<Triplet> entries;
  for (int c = 0; c < mesh_.cell_count(); ++c) {
    const std::vector<int> first = numbers.of_cell(c);
    const int functions = static_cast<int>(first.size());
    Eigen::VectorXd displacement(dimension * functions);
    for (int i = 0; i < functions; ++i)
      displacement.segment<dimension>(dimension * i) = all.segment<dimension>(first[i]);
    const Eigen::VectorXd forces = operators_.of_cells[c] * displacement;
    for (int i = 0; i < functions; ++i)
      for (int k = 0; k < dimension; ++k) entries.emplace_back(first[i] + k, c, forces[dimension * i + k]);
  }
  // The derivative of the rows by `ratio_` of each cell.
  SparseMatrix of_ratio = operators_.to_rows * made(numbers.size(), mesh_.cell_count(), entries);
  for (const PoreLoad& load : loads_)
    if (load.follows_stiffness)
      of_ratio +=
          operators_.momentum.of_stress * load.alpha.cwiseProduct(load.pressure->now() - load.reference).asDiagonal();
  for (std::size_t k = 0; k < young_->state().variable_count(); ++k) {
    const SparseMatrix of_variable = of_ratio * young_->by(k).cwiseQuotient(initial_young_).asDiagonal();
    for (const auto& [column, of_field] : young_->state().derivatives_of_variable(k)) {
      const SparseMatrix whole = of_variable * of_field;
      int row = 0;
      for (const Field* field : fields) {
        if (assembly.has_row(*field) && assembly.has_row(*column))
          assembly.derivative(*field, *column, owned_rows(SparseMatrix(whole.middleRows(row, field->size())), *field));
        row += field->size();
      }
    }
  }
}

SparseMatrix FemRock::owned_rows(SparseMatrix rows, const Field& field) const {
  const int components = field.spec().components;
  std::vector<char> owned(field.size());
  for (int i = 0; i < field.size(); ++i) owned[i] = is_owned(mesh_, field.spec().location, i / components);
  return std::ranges::count(owned, 0) > 0 ? keep_rows(rows, owned) : rows;
}

std::vector<Stiffness> FemRock::present_stiffness() const {
  std::vector<Stiffness> present = stiffness_.of_cells();
  for (std::size_t c = 0; young_ && c < present.size(); ++c) present[c] *= ratio_[static_cast<Eigen::Index>(c)];
  return present;
}

}  // namespace sprekk::poromechanics
