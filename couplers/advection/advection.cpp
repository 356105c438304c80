// What fluid carries in a step: its streams, its balances and its reports.
#include "couplers/advection/advection.hpp"

#include <algorithm>
#include <cmath>

#include "components/capabilities/matrix_border.hpp"
#include "couplers/advection/dispersion.hpp"

namespace sprekk::couplers {

std::vector<Dependence> Advection::dependences() const {
  if (!rock_.value || !fractures_.value) return {};
  const std::string rock = rock_.value->spec().owner, fracture = fractures_.value->spec().owner;
  const std::string because = "what the fluid carries out of the one it carries into the other in the same step";
  return {{rock, fracture, because}, {fracture, rock, because}};
}

void Advection::evaluate_data(const StepTime& step) {
  const auto* border = dynamic_cast<const MatrixBorder*>(matrix_);
  if (border && border->shares_fluid())
    throw DataError(InputError(origin_, "the fluid of coupler " + name() + " passes to another flow",
                               "its " + carried_.quantity + " would be left behind, since one flow carries it",
                               "take one flow whose parameters differ by region, or remove the coupler")
                        .what());
  injected_.clear();
  for (const auto& [name, given] : options_.injected)
    injected_.emplace_back(name, value_in_step(given.value, Place{}, step));
  check_names();
  wells_.injected = injected_by_wells();
  wells_.check(name());
  if (rock_.value) rock_.check(in_rock_->capacity(), name());
  if (fractures_.value) fractures_.check(in_fractures_->capacity(), name());
  disperse(true, true);
}

void Advection::begin_step(const StepTime& step) {
  if (!options_.is_limited()) return;
  begun_with_ = step.dt;
  // Sides with a value are known when data have been evaluated.
  if (rock_.value && !limited_in_rock_) limited_in_rock_.emplace(mesh_, *in_rock_);
  if (fractures_.value && !limited_in_fractures_) limited_in_fractures_.emplace(mesh_, *in_fractures_);
  if (limited_in_rock_) limited_in_rock_->begin_step();
  if (limited_in_fractures_) limited_in_fractures_->begin_step();
}

void Advection::assemble(Assembly& assembly, const StepTime& step) const {
  const auto has_row = [&](const Field& field) { return assembly.has_row(field); };
  const bool is_in_rock = rock_.value && has_row(*rock_.value);
  const bool is_in_fractures = fractures_.value && has_row(*fractures_.value);
  if (!is_in_rock && !is_in_fractures) return;
  // Nothing is carried before the flow has been solved, unless it is solved here: the fluxes of initial values do not
  // balance, and could drain many times the content of a cell.
  const auto is_solved = [&](const Field* field) { return has_row(*field); };
  if (!flow_->has_flowed() && std::ranges::none_of(flow_->fields(), is_solved)) return;
  const FlowRates rates = flow_->rates(has_row, step);
  const Mixtures wells = wells_.mixtures(rates.wells);
  if (is_in_rock)
    add(assembly, rock_, streams_of_rock(sources(), rates, flow_->fluxes_in_rock(has_row, step)), wells, step);
  if (is_in_fractures) add(assembly, fractures_, streams_of_fractures(sources(), rates), wells, step);
}

void Advection::after_solve(const std::vector<Field*>& solved, const StepTime& step) {
  const auto has = [&](const Field& field) {
    return std::ranges::any_of(solved, [&](const Field* each) { return each == &field; });
  };
  flow_->take(has, step);
  if (!flow_->has_flowed()) return;
  const bool is_in_rock = rock_.value && has(*rock_.value);
  const bool is_in_fractures = fractures_.value && has(*fractures_.value);
  disperse(rock_.value && flow_in_rock_ && !is_in_rock && has(flow_in_rock_->pressure()),
           fractures_.value && !is_in_fractures && has(fracture_->flux()));
  if (!is_in_rock && !is_in_fractures) return;
  disperses_late_ = !options_.dispersivity.is_zero() &&
                    std::ranges::any_of(flow_->fields(), [&](const Field* field) { return has(*field); });
  const FlowRates rates = flow_->rates(has, step);
  const Mixtures wells = wells_.mixtures(rates.wells);
  if (is_in_rock) count(rock_, streams_of_rock(sources(), rates, flow_->fluxes_in_rock(has, step)), wells, step);
  if (is_in_fractures) count(fractures_, streams_of_fractures(sources(), rates), wells, step);
}

void Advection::begin_totals() {
  flow_->begin(true);
  for (const FluidContents* place : {&rock_, &fractures_})
    if (place->value) place->cumulative->set_both(Vector::Zero(place->cumulative->size()));
}

void Advection::count_amounts_from_here(const SettledFields& settled) {
  const auto is_settled = [&](const Field* field) { return settled.contain(*field); };
  flow_->begin(std::ranges::any_of(flow_->fields(), is_settled));
  for (const FluidContents* place : {&rock_, &fractures_})
    if (place->value)
      for (Field* amount : {place->received, place->held}) amount->set_both(Vector::Zero(amount->size()));
}

void Advection::balance(std::map<std::string, Balance>& balances) const {
  Balance& balance = balances[carried_.quantity];
  balance.unit = carried_.amount_unit;
  for (const FluidContents* place : {&rock_, &fractures_})
    if (place->value) place->add_to(balance);
}

void Advection::report(std::vector<Quantity>& quantities) const {
  const auto mean = [&](const std::string& place, const Vector& value, auto&& rates) {
    double rate = 0, sum = 0;
    for (const auto& [cell, each] : rates) {
      rate += std::abs(each);
      sum += std::abs(each) * value[cell];
    }
    quantities.push_back({name() + "." + place + "." + carried_.value, carried_.unit, rate > 0 ? sum / rate : 0.0});
  };
  const FlowRates now = flow_->rates([](const Field&) { return true; }, {});
  const Mixtures fluid = wells_.mixtures(now.wells);
  for (std::size_t well = 0; well < fluid.size(); ++well)
    if (fluid[well])
      quantities.push_back(
          {name() + "." + wells_.wells->names()[well] + "." + carried_.value, carried_.unit, fluid[well]->value});
  // Cells that a shared rate passes the other way mix with the others inside of the place.
  const auto mean_of_source = [&](const FluidSource& source, const Vector& value) {
    double net = 0;
    for (const auto& [cell, rate] : source.rates) net += rate;
    std::vector<std::pair<int, double>> rates = source.rates;
    if (source.is_shared) std::erase_if(rates, [&](const auto& rate) { return rate.second * net < 0; });
    mean(source.name, value, rates);
  };
  if (rock_.value)
    for (const FluidSource& source : matrix_->fluid_sources())
      if (source.name != "source") mean_of_source(source, rock_.value->now());
  if (!fractures_.value) return;
  const Vector& value = fractures_.value->now();
  for (const FluidSource& source : fracture_->fluid_sources()) mean_of_source(source, value);
  for (const FluidReservoir& reservoir : fracture_->fluid_reservoirs()) {
    std::vector<std::pair<int, double>> rates;
    for (const Stream& stream : streams_of_fractures(sources(), now))
      if (stream.flux == Stream::Flux::none && std::ranges::count(reservoir.cells, stream.cell))
        rates.emplace_back(stream.cell, stream.rate);
    mean(reservoir.name, value, rates);
  }
}

void Advection::disperse(bool in_rock, bool in_fractures) {
  if (options_.dispersivity.is_zero() || !flow_->has_flowed()) return;
  if (const Vector* fluxes = flow_->last_fluxes_in_rock(); fluxes && in_rock && rock_.value)
    in_rock_->add_conductivity(dispersion_in_rock(mesh_, *fluxes, options_.dispersivity));
  if (in_fractures && fractures_.value)
    in_fractures_->add_conductivity(dispersion_in_fractures(mesh_, fracture_->flux().now(), options_.dispersivity));
}

StreamSources Advection::sources() const {
  StreamSources sources{mesh_, fracture_};
  sources.in_rock = rock_.value ? in_rock_ : nullptr;
  sources.in_fractures = fractures_.value ? in_fractures_ : nullptr;
  sources.unknown = carried_.of_unknown_fluid;
  sources.injected = injected_;
  sources.wells = wells_.wells;
  sources.rock_pressure = wells_.rock.pressure;
  sources.fracture_pressure = wells_.fractures.pressure;
  return sources;
}

}  // namespace sprekk::couplers
