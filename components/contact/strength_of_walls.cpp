// The strength of walls, their opening by slip and their closure under pressure: by numbers, built-in laws, or
// formulas.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "components/contact/frictional_contact.hpp"
#include "components/contact/laws/closure.hpp"
#include "components/contact/options.hpp"
#include "framework/invariants.hpp"
#include "framework/mesh/geometry.hpp"

namespace sprekk::contact {

void FrictionalContact::evaluate_formulas() {
  const int count = mesh_.fracture_cell_count();
  // It scales the search for the state of walls; the answer does not depend on it.
  if (formulas_->friction()) friction_.set(Vector::Ones(count));
  check_closure();
  if (!formulas_->dilation()) return;
  for (int i = 0; i < count; ++i) {
    std::array<double, 1> by;
    const double opening = formulas_->dilation()->at(i, std::array{0.0}, by, Memory::none);
    dilation_[i] = by[0];
    if (opening != 0 && is_on_fracture_cell(i))
      throw DataError(InputError(origin_,
                                 fmt::format("'dilation' is {:.6g} m without slip, at {}", opening,
                                             to_text(mesh_.fracture_cells[i].center)),
                                 "it is the opening that slip makes", "subtract its value at slip = 0")
                          .what());
    if (dilation_[i] < 0)
      throw DataError(InputError(origin_,
                                 fmt::format("'dilation' falls with slip, by {:.6g} at slip = 0, at {}", -dilation_[i],
                                             to_text(mesh_.fracture_cells[i].center)),
                                 "walls that slide apart open", "give a formula that rises from 0, or none")
                          .what());
  }
}

void FrictionalContact::check_closure() const {
  const StateFormula* formula = formulas_->closure();
  for (int i = 0; formula && i < mesh_.fracture_cell_count(); ++i) {
    std::array<double, 1> by;
    const double without_pressure = formula->at(i, std::array{0.0}, by, Memory::none);
    if (!is_on_fracture_cell(i) || (without_pressure == 0 && by[0] >= 0)) continue;
    const std::string where = to_text(mesh_.fracture_cells[i].center);
    const InputError error =
        without_pressure != 0
            ? InputError(origin_, fmt::format("'closure' is {:.6g} m without pressure, at {}", without_pressure, where),
                         "the fracture has its initial aperture there", "subtract its value at sigma_n = 0")
            : InputError(
                  origin_,
                  fmt::format("'closure' falls with pressure, by {:.6g} m/Pa without pressure, at {}", -by[0], where),
                  "pressure closes walls", "give a formula that rises from 0");
    throw DataError(error.what());
  }
}

double FrictionalContact::closure(int i, double normal_traction) const {
  if (const StateFormula* formula = formulas_->closure()) {
    std::array<double, 1> by;
    const double pressure = std::max(0.0, -normal_traction);
    const double closure = formula->at(i, std::array{pressure}, by);
    return normal_traction <= 0 ? closure : closure - by[0] * normal_traction;
  }
  return closure_ ? closure_->at(-normal_traction).closure : 0.0;
}

double FrictionalContact::closure_by_traction(int i, double normal_traction) const {
  if (const StateFormula* formula = formulas_->closure()) {
    std::array<double, 1> by;
    formula->at(i, std::array{std::max(0.0, -normal_traction)}, by);
    return -by[0];
  }
  return closure_ ? -closure_->at(-normal_traction).by_pressure : 0.0;
}

double FrictionalContact::dilated(int i, double slip) const {
  if (const StateFormula* formula = formulas_->dilation()) return formula->at(i, std::array{slip}, {});
  return std::min(slip, dilation_limit_.value_or(slip)) * dilation_[i];
}

double FrictionalContact::dilation_at(int i, double slip) const {
  if (const StateFormula* formula = formulas_->dilation()) {
    std::array<double, 1> by;
    formula->at(i, std::array{slip}, by);
    return by[0];
  }
  return dilation_limit_ && slip > *dilation_limit_ ? 0.0 : dilation_[i];
}

WallState FrictionalContact::wall_state(int i, double path, const SlipOfStep& step, double pressure) const {
  const double slip = step.is_first ? step.size : magnitude<dimension - 1>(tangential(jump_.now(), i));
  return {slip, path, dt_ > 0 ? step.size / dt_ : 0, pressure};
}

History::StateAt FrictionalContact::state_remembered(bool has_moved) const {
  return [this, has_moved](int i, std::span<double> state) {
    const double path = path_ ? path_->now()[i] : 0, pressure = std::max(0.0, -traction_.now()[dimension * i]);
    const SlipOfStep step = has_moved ? slip_of_step(i, trial(i).tangential) : SlipOfStep{0, TangentialVector::Zero()};
    std::ranges::copy(wall_state(i, path, step, pressure), state.begin());
  };
}

OfWalls FrictionalContact::friction_by_law(int i, const FrictionLaw& law, const WallState& state) const {
  OfWalls f = law.at(friction_[i], state);
  const bool is_finite = std::ranges::all_of(f.by, [](double by) { return std::isfinite(by); });
  if (f.value >= 0 && std::isfinite(f.value) && is_finite) return f;
  throw DataError(InputError(origin_,
                             fmt::format("the law of friction '{}' gives {:.6g}, with the derivatives {:.6g}, at {}",
                                         options_->friction_law.type, f.value, fmt::join(f.by, ", "),
                                         to_text(mesh_.fracture_cells[i].center)),
                             fmt::format("slip {:.6g} m, path {:.6g} m, slip rate {:.6g} m/s, pressure {:.6g} Pa; a "
                                         "coefficient is finite and not negative",
                                         state[slip_of_walls], state[path_of_walls], state[slip_rate_of_walls],
                                         state[pressure_of_walls]),
                             "correct the law, or its parameters")
                      .what());
}

Strength FrictionalContact::strength_by_laws(int i, const WallState& state) const {
  const StateFormula *friction = formulas_->friction(), *cohesion = formulas_->cohesion();
  const FrictionLaw* law = formulas_->friction_law();
  if (!friction && !cohesion && !law) return weakening_.at(friction_[i], dynamic_friction(i), state[path_of_walls]);
  OfWalls f{friction_[i]}, c{weakening_.cohesion};
  if (friction) f.value = friction->at(i, state, f.by);
  if (law) f = friction_by_law(i, *law, state);
  SPREKK_ASSERT(f.value >= 0, i, f.value);
  if (cohesion) c.value = cohesion->at(i, state, c.by);
  Weakening weakening = weakening_;
  weakening.cohesion = c.value;
  Strength s = weakening.at(f.value, friction || law ? f.value : dynamic_friction(i), state[path_of_walls]);
  const double left = c.value > 0 ? s.cohesion / c.value : 0;
  s.friction_by_path += f.by[path_of_walls];
  s.cohesion_by_path += left * c.by[path_of_walls];
  s.friction_by_slip = f.by[slip_of_walls];
  s.cohesion_by_slip = left * c.by[slip_of_walls];
  s.friction_by_rate = f.by[slip_rate_of_walls];
  s.cohesion_by_rate = left * c.by[slip_rate_of_walls];
  s.friction_by_pressure = f.by[pressure_of_walls];
  s.cohesion_by_pressure = left * c.by[pressure_of_walls];
  return s;
}

std::string FrictionalContact::accept_friction_factor(const Field& factor) {
  if (rate_and_state_) return "'" + name() + "' has a friction of rate and state, which has no single coefficient";
  if (friction_factor_ && friction_factor_ != &factor)
    return "'" + name() + "' has the factor of " + friction_factor_->name() + " already";
  friction_factor_ = &factor;
  return {};
}

Strength FrictionalContact::strength(int i, const WallState& state) const {
  Strength s = strength_by_laws(i, state);
  if (!friction_factor_) return s;
  const double factor = friction_factor_->now()[i];
  for (double* friction :
       {&s.friction, &s.friction_by_path, &s.friction_by_slip, &s.friction_by_rate, &s.friction_by_pressure})
    *friction *= factor;
  return s;
}

Strength FrictionalContact::strength_before(int i, double normal_traction) const {
  const double slip = magnitude<dimension - 1>(tangential(jump_.accepted(), i));
  return strength(i, {slip, path_ ? path_->accepted()[i] : 0, 0, std::max(0.0, -normal_traction)});
}

double FrictionalContact::distance_of_loss(const Strength& strength, double normal_traction) const {
  if (weakening_.is_on()) return weakening_.distance;
  const double lost = lost_by_slip(strength, normal_traction, dt_);
  return (strength.cohesion - strength.friction * normal_traction) / std::max(lost, std::numeric_limits<double>::min());
}

}  // namespace sprekk::contact
