#include "components/wells/limited_wells.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "framework/field/units_of_amounts.hpp"
#include "framework/invariants.hpp"
#include "framework/matrix_of.hpp"
#include "framework/mesh/medium.hpp"
#include "framework/mesh/search/line_in_cells.hpp"
#include "framework/round_off.hpp"
#include "framework/scene/registry.hpp"

namespace sprekk::wells {
namespace {

std::vector<std::string> names_of(const Options& options, const Origin& origin) {
  if (options.wells.empty())
    throw InputError(origin, "there is no well", "'wells' is empty", "name a well, or remove the component");
  std::vector<std::string> names;
  for (const auto& [name, well] : options.wells) names.push_back(name);
  return names;
}

/// The pieces of a line, each a place with its part of a given index.
void add_line(std::vector<WellPlace>& places, const WellPlace& whole, const std::vector<Point>& line,
              const Mesh& mesh) {
  std::vector<PieceInCell> pieces;
  try {
    pieces = line_in_cells(mesh, line);
  } catch (const std::invalid_argument& outside) {
    throw InputError(whole.origin, "well '" + whole.name + "' lies outside the " + medium_name(), outside.what(),
                     "move it inside");
  }
  double length = 0;
  for (const PieceInCell& piece : pieces) length += (piece.to - piece.from).norm();
  for (const PieceInCell& piece : pieces) {
    WellPlace place = whole;
    place.at = 0.5 * (piece.from + piece.to);
    place.piece = {piece.cell, piece.from, piece.to, line};
    if (place.index) *place.index *= place.piece->length() / length;
    places.push_back(place);
  }
}

std::vector<WellPlace> places_of(const Options& options, const Mesh& mesh) {
  std::vector<WellPlace> places;
  int number = 0;
  for (const auto& [name, well] : options.wells) {
    const auto add = [&, &well = well](const std::string& label, const Perforation& place, const Origin& origin) {
      const Point at = place.at ? *place.at : place.points.front();
      const WellPlace whole{number, label, origin, at, place.fracture, well.radius, well.skin, place.index, {}};
      place.at ? places.push_back(whole) : add_line(places, whole, place.points, mesh);
    };
    if (well.places.empty()) add(name, well.only, well.origin);
    for (const auto& [label, place] : well.places) add(name + "." + label, place, place.origin);
    ++number;
  }
  return places;
}

FieldSpec listed(const ComponentContext& context, const char* name, std::size_t count, Role role, const char* unit,
                 const char* doc) {
  return {.owner = context.name,
          .name = name,
          .location = Location::listed,
          .listed = static_cast<int>(count),
          .role = role,
          .unit = unit,
          .doc = doc};
}

FieldSpec rate_spec(const ComponentContext& context, std::size_t count) {
  FieldSpec spec = listed(context, "rate", count, Role::input(BlockKind::interface), volume_rate_unit,
                          "Rate out of the wells at each of their places");
  spec.needs_coupler = "well_exchange";
  return spec;
}

FieldSpec injected_spec(const ComponentContext& context, std::size_t count) {
  FieldSpec spec =
      listed(context, "injected", count, Role::derived(), volume_unit, "Fluid that the wells have injected");
  spec.accepted_with = context.name + ".rate";
  return spec;
}

}  // namespace

Binding binding(const Control& control, double pressure, double rate, double resistance) {
  if (control.has_pressure) return Binding::pressure;
  if (!control.has_limit || control.rate == 0) return Binding::rate;
  const double sign = control.rate > 0 ? 1 : -1;
  const double candidate = sign * (rate + (control.pressure - pressure) / resistance);
  if (candidate >= sign * control.rate) return Binding::rate;
  return candidate <= 0 ? Binding::shut : Binding::pressure;
}

LimitedWells::LimitedWells(const ComponentContext& context, const Options& options)
    : Component(context.name),
      options_(options),
      names_(names_of(options_, context.origin)),
      places_(places_of(options_, context.mesh)),
      pressure_(
          context.fields.add(context.mesh, listed(context, "pressure", names_.size(),
                                                  Role::unknown(BlockKind::interface), "Pa", "Pressure in the wells"))),
      rate_(context.fields.add(context.mesh, rate_spec(context, places_.size()))),
      injected_(context.fields.add(context.mesh, injected_spec(context, places_.size()))),
      resistance_(Vector::Ones(count())),
      scale_of_rates_(Vector::Ones(count())) {
  std::vector<Triplet> ones;
  for (std::size_t k = 0; k < places_.size(); ++k) ones.emplace_back(places_[k].well, static_cast<int>(k), 1.0);
  of_places_ = matrix_of(count(), static_cast<int>(places_.size()), ones);
  evaluate_data({context.start_time, 0, context.start_time});
}

Control LimitedWells::control(int well, const StepTime& step) const {
  const WellOptions& options = options_.wells.at(names_[well]);
  const auto place = std::ranges::find(places_, well, &WellPlace::well);
  SPREKK_ASSERT(place != places_.end(), well);
  const auto value = [&](const Data& data) { return value_in_step(data, {place->at, 0, 0}, step); };
  if (options.lowest_pressure && options.highest_pressure &&
      value(*options.lowest_pressure) > value(*options.highest_pressure))
    throw DataError(InputError(options.origin, "the limits of well '" + names_[well] + "' contradict one another",
                               fmt::format("lowest_pressure is {:.6g} Pa and highest_pressure {:.6g} Pa at {:.6g} s",
                                           value(*options.lowest_pressure), value(*options.highest_pressure), step.end),
                               "exchange them")
                        .what());
  if (options.pressure) return {.has_pressure = true, .pressure = value(*options.pressure)};
  Control control{.rate = value(*options.rate)};
  const std::optional<Data>& limit = control.rate > 0 ? options.highest_pressure : options.lowest_pressure;
  control.has_limit = limit && control.rate != 0;
  if (control.has_limit) control.pressure = value(*limit);
  return control;
}

void LimitedWells::evaluate_data(const StepTime& step) {
  now_.clear();
  for (int w = 0; w < count(); ++w) now_.push_back(control(w, step));
}

void LimitedWells::begin_with(const Vector& around) {
  SPREKK_EXPECT(around.size() == static_cast<Eigen::Index>(places_.size()), around.size(), places_.size());
  for (std::size_t k = 0; k < places_.size(); ++k) {
    const Control& control = now_[places_[k].well];
    if (!control.has_limit) continue;
    if ((control.rate > 0 ? 1 : -1) * (control.pressure - around[k]) > 0) continue;
    throw InputError(
        places_[k].origin, "the limit of well '" + places_[k].name + "' is on the wrong side",
        fmt::format("the pressure around it is {:.6g} Pa at the start, and it is to {} with at {} {:.6g} Pa", around[k],
                    control.rate > 0 ? "inject" : "extract", control.rate > 0 ? "most" : "least", control.pressure),
        control.rate > 0 ? "raise highest_pressure above the pressure around the well"
                         : "lower lowest_pressure below the pressure around the well");
  }
  const Vector places = of_places_ * Vector::Ones(around.size());
  at_start_ = (of_places_ * around).cwiseQuotient(places);
  pressure_.set_both(at_start_);
}

void LimitedWells::scale(const Vector& resistance) {
  SPREKK_EXPECT(resistance.size() == static_cast<Eigen::Index>(places_.size()), resistance.size(), places_.size());
  SPREKK_EXPECT(resistance.minCoeff() > 0 && is_finite(resistance), resistance.minCoeff());
  resistance_ = (of_places_ * resistance.cwiseInverse()).cwiseInverse();  // places are parallel
  choose_scales();
}

void LimitedWells::choose_scales() {
  double largest_rate = 0, largest_pressure = pressure_.accepted().lpNorm<Eigen::Infinity>();
  for (const Control& control : now_) {
    largest_rate = std::max(largest_rate, std::abs(control.rate));
    largest_pressure = std::max(largest_pressure, std::abs(control.pressure));
  }
  scale_of_pressures_ = largest_pressure > 0 ? largest_pressure : 1;
  scale_of_rates_ = scale_of_pressures_ * resistance_.cwiseInverse();  // where no well has a rate
  for (int w = 0; w < count(); ++w)
    if (largest_rate > 0) scale_of_rates_[w] = now_[w].rate != 0 ? std::abs(now_[w].rate) : largest_rate;
  SPREKK_ASSERT(scale_of_rates_.minCoeff() > 0 && is_finite(scale_of_rates_), scale_of_rates_.minCoeff());
}

Binding LimitedWells::binding_now(int well, double rate) const {
  return binding(now_[well], pressure_.now()[well], rate, resistance_[well]);
}

void LimitedWells::assemble(Assembly& assembly, const StepTime&) const {
  if (!assembly.has_row(pressure_)) return;
  const Vector rates = this->rates();
  Vector of_rate = Vector::Zero(count()), of_pressure = Vector::Zero(count()), given = Vector::Zero(count());
  for (int w = 0; w < count(); ++w) switch (binding_now(w, rates[w])) {
      case Binding::rate:
        of_rate[w] = 1 / scale_of_rates_[w];
        given[w] = now_[w].rate / scale_of_rates_[w];
        break;
      case Binding::pressure:
        of_pressure[w] = 1 / scale_of_pressures_;
        given[w] = now_[w].pressure / scale_of_pressures_;
        break;
      case Binding::shut:
        of_rate[w] = 1 / scale_of_rates_[w];
        break;
    }
  assembly.add(pressure_, of_rate.cwiseProduct(rates));
  assembly.add(pressure_, of_pressure.cwiseProduct(pressure_.now()));
  assembly.add(pressure_, -given);
  if (!assembly.wants_derivatives()) return;
  assembly.derivative(pressure_, rate_, SparseMatrix(of_rate.asDiagonal() * of_places_));
  assembly.diagonal(pressure_, pressure_, of_pressure);
}

void LimitedWells::after_solve(const std::vector<Field*>& solved, const StepTime& step) {
  if (std::ranges::find(solved, &rate_) != solved.end()) injected_.set(injected_.accepted() + step.dt * rate_.now());
}

void LimitedWells::balance(std::map<std::string, Balance>& balances) const {
  Balance& fluid = balances["fluid"];
  fluid.unit = volume_unit;
  fluid.injected += injected_.now().sum();
  fluid.throughput += injected_.now().lpNorm<1>();
}

std::uint64_t LimitedWells::discrete_state() const {
  const Vector rates = this->rates();
  std::uint64_t state = 0;
  for (int w = 0; w < count(); ++w) state = 3 * state + static_cast<std::uint64_t>(binding_now(w, rates[w]));
  return state;
}

std::vector<double> LimitedWells::switch_times() const {
  std::vector<const Data*> data;
  for (const auto& [name, well] : options_.wells)
    for (const std::optional<Data>* given : {&well.rate, &well.pressure, &well.lowest_pressure, &well.highest_pressure})
      if (*given) data.push_back(&**given);
  return merged_switch_times(data);
}

void LimitedWells::report(std::vector<Quantity>& quantities) const {
  const Vector rates = this->rates();
  for (int w = 0; w < count(); ++w) {
    const std::string column = name() + "." + names_[w];
    quantities.push_back({column + ".rate", volume_rate_unit, rates[w]});
    quantities.push_back({column + ".pressure", "Pa", pressure_.now()[w]});
    quantities.push_back(
        {column + ".binds_0_rate_1_pressure_2_shut", "1", static_cast<double>(binding_now(w, rates[w]))});
  }
  for (std::size_t k = 0; k < places_.size(); ++k) {
    if (places_[k].name == names_[places_[k].well]) continue;
    const double rate = rate_.now()[static_cast<int>(k)];
    const bool is_same_line = k > 0 && places_[k].piece && places_[k - 1].name == places_[k].name;
    if (is_same_line)
      quantities.back().value += rate;
    else
      quantities.push_back({name() + "." + places_[k].name + ".rate", volume_rate_unit, rate});
  }
}

void LimitedWells::note_step(Notes& notes, const StepTime&) const {
  const Vector rates = this->rates();
  for (int w = 0; w < count(); ++w)
    if (binding_now(w, rates[w]) == Binding::shut)
      notes.add(name() + "." + names_[w] + " is shut",
                fmt::format("well '{}' does not {} (the pressure around it is beyond its limit, and it does not flow "
                            "back); look at the limit, or give its 'pressure' if it may flow back",
                            names_[w], now_[w].rate > 0 ? "inject" : "extract"));
  // As for the rock: pressures that begin above zero are absolute, and others may be relative to any reference.
  for (int w = 0; w < count(); ++w)
    if (const double pressure = pressure_.now()[w]; at_start_[w] > 0 && pressure < -rounding::far_above * at_start_[w])
      notes.add(
          name() + "." + names_[w] + " below zero",
          fmt::format("the pressure in well '{}' falls to {:.3g} Pa (around it it began at {:.3g} Pa, and no fluid "
                      "sustains tension: this rate is not possible) give it a 'lowest_pressure', or a smaller "
                      "rate",
                      names_[w], pressure, at_start_[w]),
          -pressure);
}

namespace {

const RegisterComponent<LimitedWells, Options> registration("wells/limited");

}  // namespace
}  // namespace sprekk::wells
