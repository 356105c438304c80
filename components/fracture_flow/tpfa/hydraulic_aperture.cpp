// The hydraulic aperture of a cell by its law or formula, and what it conducts.
#include <algorithm>
#include <cmath>

#include "components/fracture_flow/tpfa/fracture_flow.hpp"

namespace sprekk::fracture_flow {

void FractureFlow::prepare_formula(FieldStore& fields) {
  const Data* data = options_.conduction_formula();
  const std::vector<Place> places = fracture_cell_places(mesh_);
  history_ = History::find(options_.history, conduction_variables(), places, wet_);
  if (data) formula_.emplace(*data, conduction_variables(), places, history_.get());
  if (history_) {
    history_->require_named(formula_ ? formula_->recalled() : 0, "transmissivity");
    history_->add_fields(fields, mesh_, Location::fracture_cell, name(), pressure_.name());
  }
  if (!data) return;
  lowest_ = least_aperture();
  for (std::size_t k = of_pressure; k < conduction_variable_count; ++k)
    if (formula_->names(k)) named_.push_back(k);
  state_.offer("a", {&aperture_});
  state_.offer("p", {&pressure_});
}

double FractureFlow::least_aperture() const {
  return std::max(options_.aperture_floor, options_.law.residual.value_or(0));
}

void FractureFlow::require_state() const {
  if (!formula_) return;
  state_.require(*formula_, "transmissivity", origin_, [&](const std::string& variable) {
    return variable == "T"
               ? "add a component of the heat in fractures, and a coupler heat_advection with '" + name() + "'"
               : "add a contact, and '- {type: aperture, between: [CONTACT, " + name() + "]}' to 'couplers:'";
  });
}

ConductionState FractureFlow::state_in(int cell) const {
  ConductionState state{aperture_.now()[cell]};
  for (const std::size_t k : named_) state[k] = state_.now(k, cell);
  return state;
}

History::StateAt FractureFlow::state_remembered() const {
  return [this](int cell, std::span<double> state) {
    ConductionState now = state_in(cell);
    now[of_aperture] = std::max(now[of_aperture], lowest_);
    std::ranges::copy(now, state.begin());
  };
}

void FractureFlow::output(std::vector<OutputField>& fields) const {
  if (history_) history_->output(fields);
}

FractureFlow::Hydraulic FractureFlow::hydraulic_by_law(int cell, ConductionState state) const {
  if (!formula_) {
    const auto [value, by_aperture] = law_->at(state[0]);
    return {value, by_aperture};
  }
  const auto [value, by] = hydraulic_state(*formula_, cell, lowest_, state);
  return {value, by[0], by};
}

FractureFlow::Hydraulic FractureFlow::hydraulic_aperture(int cell, double present, double held) const {
  ConductionState state = state_in(cell);
  state[0] = present;
  Hydraulic now = hydraulic_by_law(cell, state);
  if (!is_held()) return now;
  ConductionState held_state = formula_ ? held_state_[cell] : state;
  held_state[0] = held;
  const double before = hydraulic_by_law(cell, held_state).value;
  const double value = std::pow(before, 1 - released_share_) * std::pow(now.value, released_share_);
  const double share = released_share_ * value / now.value;
  for (double& by : now.by_state) by *= share;
  return {value, share * now.by_aperture, now.by_state};
}

FractureFlow::Hydraulic FractureFlow::hydraulic_aperture(int cell) const {
  return hydraulic_aperture(cell, aperture_.now()[cell], is_held() ? held_aperture_[cell] : 0);
}

FractureFlow::Transmissivity FractureFlow::cubic_law(int cell) const {
  const double viscosity = viscosity_[cell];
  auto [a, by_present, by_state] = hydraulic_aperture(cell);
  for (double& by : by_state) by *= a * a / (4 * viscosity);
  return {a * a * a / (12 * viscosity), a * a / (4 * viscosity) * by_present, by_state};
}

void FractureFlow::append_by_state(Derivatives& derivatives, int cell, double factor, const ByState& by_state) const {
  int column = cell;
  for (const std::size_t k : named_)
    derivatives.emplace_back(column += mesh_.fracture_cell_count(), factor * by_state[k]);
}

}  // namespace sprekk::fracture_flow
