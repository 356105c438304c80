// The flow where the porosity or the storage is a formula of the state: what rock stores is the change of what it
// holds.
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "components/capabilities/formula_of_cells.hpp"
#include "components/capabilities/rest_of_balances.hpp"
#include "components/matrix_flow/history_of_cells.hpp"
#include "components/matrix_flow/matrix_flow.hpp"
#include "components/matrix_flow/storage_formula.hpp"
#include "framework/assembly/balance_rows.hpp"
#include "framework/field/counted_amounts.hpp"
#include "framework/field/ownership.hpp"
#include "framework/field/units_of_amounts.hpp"
#include "framework/mesh/geometry.hpp"
#include "framework/mesh/mesh_change.hpp"

namespace sprekk::matrix_flow {
namespace {

/// What the pores hold is phi (1 + c (p − p_0)) per volume that the rock had at the start, with the compressibility c
/// of the fluid, whose volume is counted at its initial pressure p_0. phi and phi c (p − p_0) are kept apart: where the
/// porosity does not change, its large values then leave no round-off in the small changes of the other part.
constexpr int parts = 2;

}  // namespace

void MatrixFlow::find_pores(const ComponentContext& context) {
  const History* history = history_ ? &history_->history() : nullptr;
  if (options_.storage)
    stores_ = StorageFormula::find(*options_.storage, mesh_, pressure_, history, origin_);
  else if (options_.porosity)
    pores_ = FormulaOfCells::find({*options_.porosity}, mesh_, history);
  if (!pores_ && !stores_) return;
  (pores_ ? pores_->state() : stores_->state()).offer("p", StateField{&pressure_});
  if (pores_ && options_.fluid_compressibility->depends_on_time())
    throw InputError(origin_,
                     "the porosity of '" + name() + "' follows the state, and 'fluid_compressibility' depends on time",
                     "what pores hold would change at once with a property of the fluid",
                     "give one compressibility, or a porosity that does not depend on the state");
  content_ = &context.fields.add(
      mesh_,
      amounts_with(pressure_, context.name, "content", volume_unit,
                   "Volume of pores, and what their fluid is compressed by, that the balance has counted", parts));
}

bool MatrixFlow::porosity_depends_on(const std::string& variable) const {
  return pores_ && pores_->state().names(variable);
}

void MatrixFlow::take_pores(const StepTime& step) {
  if (stores_) {
    if (!stores_->evaluate(step, initial_pressure_, inside_) && storage_.values().size() > 0) return;
    storage_.set(stores_->by_pressure().cwiseMax(0));
    return use_storage();
  }
  if (!pores_->evaluate(step, inside_) && storage_.values().size() > 0) return;
  const Vector &phi = pores_->values(), &c = compressibility_.values();
  Vector by_pressure = phi.cwiseProduct(c);
  for (std::size_t k = 0; k < pores_->state().variable_count(); ++k)
    if (rock_variables()[pores_->state().variable(k)].name == "p")
      by_pressure += pores_->by(k).cwiseProduct(density_ratio());
  for (int cell = 0; cell < mesh_.cell_count(); ++cell)
    if (by_pressure[cell] < 0) {
      pores_->state().forget();
      throw StateError(fmt::format(
          "{}: pores of '{}' hold less fluid where its pressure rises: {:.3g} 1/Pa at {} (fluid would gather "
          "by itself) let 'porosity' not fall with p",
          origin_.text(), name(), by_pressure[cell], to_text(mesh_.cell_center[cell])));
    }
  storage_.set(std::move(by_pressure));
  use_storage();
}

Vector MatrixFlow::density_ratio() const {
  return (1 + compressibility_.values().array() * (pressure_.now() - initial_pressure_).array()).matrix();
}

Vector MatrixFlow::content_now() const {
  Vector content(parts * mesh_.cell_count());
  if (stores_) {
    for (int c = 0; c < mesh_.cell_count(); ++c)
      content.segment<parts>(parts * c) << mesh_.cell_measure[c] * stores_->stored()[c], 0;
    return content;
  }
  const Vector& phi = pores_->values();
  for (int c = 0; c < mesh_.cell_count(); ++c) {
    content[parts * c] = mesh_.cell_measure[c] * phi[c];
    content[parts * c + 1] =
        mesh_.cell_measure[c] * phi[c] * compressibility_[c] * (pressure_.now()[c] - initial_pressure_[c]);
  }
  return content;
}

Vector MatrixFlow::stored_by_state() const {
  const Vector change = content_now() - content_->accepted();
  return change(Eigen::seq(0, Eigen::last, parts)) + change(Eigen::seq(1, Eigen::last, parts));
}

void MatrixFlow::assemble_stored_by_state(Assembly& assembly, BalanceRows& fluid) const {
  // Round-off of the formula and of the sums: some last digits of each of the two parts.
  constexpr double last_digits = 4 * BalanceRows::round_off_of_change;
  Vector stored = stored_by_state();
  for (int c = 0; c < mesh_.cell_count(); ++c)
    if (!is_in_cell(c)) stored[c] = capacity_[c] * (pressure_.now()[c] - pressure_.accepted()[c]);
  fluid.store(stored, last_digits * content_->accepted().lpNorm<Eigen::Infinity>());
  if (!assembly.wants_derivatives()) return;
  assembly.diagonal(pressure_, pressure_, capacity_);
  Vector volumes = Eigen::Map<const Vector>(mesh_.cell_measure.data(), mesh_.cell_count());
  if (pores_) volumes = density_ratio().cwiseProduct(volumes);
  const StateOfCells& state = pores_ ? pores_->state() : stores_->state();
  for (std::size_t k = 0; k < state.variable_count(); ++k) {
    if (rock_variables()[state.variable(k)].name == "p") continue;
    const Vector factors = volumes.cwiseProduct(pores_ ? pores_->by(k) : stores_->by(k));
    for (const auto& [field, of_variable] : state.derivatives_of_variable(k))
      if (assembly.has_row(*field))
        assembly.derivative(pressure_, *field, SparseMatrix(factors.asDiagonal() * of_variable));
  }
}

void MatrixFlow::count_content() {
  take_pores(evaluated_for_);
  content_->set(content_now());
}

/// What remains of a balance after the last pass is in the rock, although its pores do not hold it yet: the next step
/// stores it.
void MatrixFlow::count_rest_later(const Assembly& assembly) {
  if (!stores_by_state() || !assembly.has_row(pressure_)) return;
  const Vector rest = rest_of_balances(assembly, pressure_, mesh_, [&](int cell) { return is_in_cell(cell); });
  Vector content = content_->now(), sums = cumulative_.now();
  for (int c = 0; c < mesh_.cell_count(); ++c) {
    content[parts * c] -= rest[c];
    sums[3 * c] -= rest[c];
  }
  content_->set(std::move(content));
  cumulative_.set(std::move(sums));
}

void MatrixFlow::count_amounts_from_here(const SettledFields&) {
  if (!stores_by_state()) return;
  take_pores({evaluated_for_.start, 0, evaluated_for_.start});
  content_->set_both(content_now());
}

/// A change of the mesh must not change the fluid in the pores: from now on they hold what the state says, without what
/// was not counted before, and the difference of both totals is spread evenly over the new cells.
void MatrixFlow::settled(const MeshChange& change) {
  if (history_) history_->history().hold(false);
  if (!stores_by_state() || change.is_at_start) return;
  take_pores(evaluated_for_);
  Vector content = content_now();
  content(Eigen::seq(0, Eigen::last, parts)) -= uncounted_;
  double difference = 0, area = 0;
  for (int c = 0; c < mesh_.cell_count(); ++c) {
    for (int part = 0; part < parts; ++part)
      difference += content[parts * c + part] - content_->accepted()[parts * c + part];
    if (change.cell[c] == none && is_in_cell(c)) area += mesh_.cell_measure[c];
  }
  for (int c = 0; c < mesh_.cell_count(); ++c)
    if (change.cell[c] == none && is_in_cell(c)) content[parts * c] -= difference / area * mesh_.cell_measure[c];
  content_->set_both(std::move(content));
}

}  // namespace sprekk::matrix_flow
