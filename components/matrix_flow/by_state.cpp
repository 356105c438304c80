// The flow where the permeability, the porosity, or both are formulas of the state.
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "components/capabilities/formula_of_cells.hpp"
#include "components/matrix_flow/buoyancy.hpp"
#include "components/matrix_flow/history_of_cells.hpp"
#include "components/matrix_flow/matrix_flow.hpp"
#include "components/matrix_flow/storage_formula.hpp"
#include "framework/config/expression.hpp"
#include "framework/field/ownership.hpp"
#include "framework/field/wall_matrices.hpp"
#include "framework/invariants.hpp"
#include "framework/mesh/cell_sums.hpp"
#include "framework/mesh/geometry.hpp"
#include "framework/parallel/parallel.hpp"

namespace sprekk::matrix_flow {

void MatrixFlow::find_state_permeability() {
  const std::vector<Data> all(options_.permeability.component.begin(), options_.permeability.component.end());
  const History* history = history_ ? &history_->history() : nullptr;
  if (!FormulaOfCells::find(all, mesh_, history)) return;
  if (!options_.permeability.is_diagonal())
    throw InputError(origin_, "a permeability that is a formula of the state has entries beside its diagonal",
                     "a formula is taken for each axis alone", "give one formula, or one each for 'xx' and 'yy'");
  by_state_ = FormulaOfCells::find({all.begin(), all.begin() + dimension}, mesh_, history);
  by_state_->state().offer("p", StateField{&pressure_});
  SPREKK_EXPECT(differentiate_, name());
  if (!inside_.empty())
    throw InputError(options_.regions_origin, "a flow in some 'regions' has a permeability that follows the state",
                     "its derivatives are known for a flow in all cells", "leave 'regions' out");
  properties_change_ = true;
}

void MatrixFlow::find_history(const ComponentContext& context) {
  if (!history_) return;
  std::uint32_t recalled = 0;
  for (const auto* formula : {&pores_, &by_state_})
    if (*formula) recalled |= (*formula)->recalled();
  history_->history().require_named(recalled, "permeability or porosity");
  history_->state().offer("p", StateField{&pressure_});
  history_->history().add_fields(context.fields, mesh_, Location::cell, context.name, pressure_.name());
}

std::vector<StateOfCells*> MatrixFlow::states() const {
  std::vector<StateOfCells*> all;
  if (history_) all.push_back(&history_->state());
  if (stores_) all.push_back(&stores_->state());
  if (by_state_) all.push_back(&by_state_->state());
  if (pores_) all.push_back(&pores_->state());
  return all;
}

void MatrixFlow::offer_state(const std::string& variable, const StateField& source) {
  for (StateOfCells* state : states()) state->offer(variable, source);
}

void MatrixFlow::offer_expression(const std::string& variable, const StateExpression& source) {
  for (StateOfCells* state : states()) state->offer(variable, source);
}

void MatrixFlow::require_state() const {
  const auto remedy = [&](const std::string& variable) {
    return variable == "T"
               ? "add a component of the heat in the rock, and a coupler heat_advection with '" + name() + "'"
               : "add a rock, and '- {type: biot, between: [" + name() + ", ROCK]}' to 'couplers:'";
  };
  if (by_state_) by_state_->state().require("permeability", origin_, remedy);
  if (pores_) pores_->state().require("porosity", origin_, remedy);
  if (stores_) stores_->state().require("storage", origin_, remedy);
}

void MatrixFlow::refuse_with_formula(const std::string& what, const std::string& why) const {
  if (by_state_)
    throw InputError(origin_, "the permeability of '" + name() + "' follows the state, and " + what, why,
                     "give a permeability that does not depend on the state, or leave that part out");
}

void MatrixFlow::take_permeability() {
  const bool has_changed = by_state_->evaluate(evaluated_for_, {}, [&](int cell, double value) {
    if (!(value > 0))
      throw StateError(
          fmt::format("{}: 'permeability' is {} m^2 at {} (fluid could not flow there) keep it above 0: "
                      "\"max(1e-22 m^2, …)\"",
                      origin_.text(), value, to_text(mesh_.cell_center[cell])));
  });
  if (!has_changed && viscosity_of_mobility_ == viscosity_.version()) return;
  viscosity_of_mobility_ = viscosity_.version();
  std::vector<Tensor> mobility(mesh_.cell_count(), Tensor::Zero());
  for (int c = 0; c < mesh_.cell_count(); ++c)
    for (int axis = 0; axis < dimension; ++axis) mobility[c](axis, axis) = by_state_->values(axis)[c] / viscosity_[c];
  for (std::size_t c = 0; c < held_mobility_.size(); ++c)
    mobility[c].diagonal() = held_mobility_[c].diagonal().array().pow(1 - released_share_) *
                             mobility[c].diagonal().array().pow(released_share_);
  if (mobility == mobility_) return;
  mobility_ = std::move(mobility);
  ++mobility_version_;
}

void MatrixFlow::search_by_state(SearchMode mode) {
  if (!by_state_) return;
  is_first_attempt_ = mode == SearchMode::with_shortcuts;
  takes_derivatives_ = true;
  observed_mobility_.clear();
  viscosity_of_mobility_ = 0;
  held_mobility_.clear();
  if (mode != SearchMode::piecewise_linear) return;
  take_permeability();
  held_mobility_ = mobility_;
  release_by_state(0);
}

void MatrixFlow::release_by_state(double share) {
  viscosity_of_mobility_ = 0;
  released_share_ = share;
  if (share == 1) held_mobility_.clear();
}

void MatrixFlow::follow_state(const Assembly& assembly) {
  if (!assembly.has_row(pressure_)) return;
  if (stores_by_state()) take_pores(evaluated_for_);
  if (!by_state_) return;
  SPREKK_EXPECT(discretized_mesh_ == mesh_.version, name());
  take_permeability();
  linearized_.clear();
  if (!is_discretized()) {
    discretize();
    apply_boundary();
    use_density();
  }
  if (assembly.wants_derivatives() && takes_derivatives_) linearize();
}

/// With its derivatives the permeability of cells that a front of pressure has yet to reach leads Newton's method away:
/// fluxes into them may seem to grow with their pressure. So the first attempt leaves them out after an update that has
/// changed a permeability by much.
void MatrixFlow::observe_iterate(const std::vector<Field*>& unknowns) {
  if (!by_state_ || std::ranges::count(unknowns, &pressure_) == 0) return;
  constexpr double little = 0.1;  // of a permeability: with less, quadratic terms are a hundredth
  take_permeability();
  double change = 0;
  for (std::size_t c = 0; c < observed_mobility_.size(); ++c) {
    const double now = mobility_[c].lpNorm<Eigen::Infinity>(), before = observed_mobility_[c].lpNorm<Eigen::Infinity>();
    change = std::max(change, (mobility_[c] - observed_mobility_[c]).lpNorm<Eigen::Infinity>() / std::max(now, before));
  }
  observed_mobility_ = mobility_;
  takes_derivatives_ = !is_first_attempt_ || parallel::max(change) < little;
}

void MatrixFlow::linearize() {
  FluxState state{pressure_.now() - gravity_potential_cell_, boundary_values_, boundary_changes_};
  if (wall_flux_) state.boundary += boundary_of_wall_flux_ * wall_flux_->now();
  for (const OpenBorder& border : borders_) state.boundary += border.boundary * border.outflow->now();
  std::vector<std::vector<Tensor>> by;
  for (std::size_t k = 0; k < by_state_->state().variable_count(); ++k) {
    by.emplace_back(mesh_.cell_count(), Tensor::Zero());
    for (int axis = 0; axis < dimension; ++axis) {
      const Vector &of_axis = by_state_->by(k, axis), &values = by_state_->values(axis);
      for (int c = 0; c < mesh_.cell_count(); ++c) by.back()[c](axis, axis) = of_axis[c] / viscosity_[c];
      for (std::size_t c = 0; c < held_mobility_.size(); ++c)
        by.back()[c](axis, axis) *= released_share_ * mobility_[c](axis, axis) / (values[c] / viscosity_[c]);
    }
  }
  const std::vector<FluxDerivatives> derivatives =
      differentiate_({mesh_, mobility_, conditions_}, nodes_to_discretize(mesh_), state, by);
  for (std::size_t k = 0; k < derivatives.size(); ++k)
    for (const auto& [field, of_variable] : by_state_->state().derivatives_of_variable(k))
      linearized_.push_back({field, derivatives[k].flux * of_variable, derivatives[k].trace * of_variable});
  if (!wall_flux_) return;
  const SparseMatrix pick_walls = owned_walls_of_faces(mesh_);
  wall_pressure_before_ = std::move(wall_pressure_by_state_);
  wall_pressure_by_state_ = wall_pressure_;
  for (const ByState& by_field : linearized_) {
    const SparseMatrix at_walls = pick_walls * by_field.trace;
    if (at_walls.nonZeros() == 0) continue;
    wall_pressure_by_state_.constant -= at_walls * by_field.field->now();
    wall_pressure_by_state_.terms.push_back({by_field.field, Operator(at_walls)});
  }
}

void MatrixFlow::assemble_by_state(Assembly& assembly, double dt) const {
  if (!assembly.wants_derivatives()) return;
  std::vector<char> is_outer(mesh_.face_count()), is_inner(mesh_.face_count());
  for (int f = 0; f < mesh_.face_count(); ++f) is_inner[f] = !(is_outer[f] = mesh_.face_cells[f][1] == none);
  for (const ByState& by : linearized_) {
    if (!assembly.has_row(*by.field)) continue;
    const auto outflow = [&](const std::vector<char>& faces) {
      return cell_sums(mesh_, SparseMatrix(dt * keep_rows(by.flux, faces)), 1, parallel::rank());
    };
    assembly.exchange_derivative(pressure_, *by.field, outflow(is_inner));
    assembly.derivative(pressure_, *by.field, outflow(is_outer));
  }
}

}  // namespace sprekk::matrix_flow
