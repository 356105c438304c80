#include "components/contact/rate_and_state_walls.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "components/contact/fields.hpp"
#include "components/contact/places_of_parameters.hpp"
#include "components/contact/tangents.hpp"
#include "framework/config/units.hpp"
#include "framework/invariants.hpp"
#include "framework/mesh/geometry.hpp"

namespace sprekk::contact {

namespace {

Vector values_at_start(const Data& data, const ComponentContext& context, const std::vector<char>& here) {
  return Property(data, places_of_parameters(context.mesh, here), context.start_time).values();
}

std::string place_of_zero(const Mesh& mesh, const Property& friction) {
  for (int i = 0; i < mesh.fracture_cell_count(); ++i)
    if (!(friction[i] > 0)) return to_text(mesh.fracture_cells[i].center);
  return {};
}

}  // namespace

RateAndStateWalls::RateAndStateWalls(const ComponentContext& context, const RateAndStateOptions& options,
                                     const Property& friction, const std::vector<char>& here)
    : mesh_(context.mesh),
      options_(options),
      here_(here),
      a_(values_at_start(options.a, context, here)),
      b_(values_at_start(options.b, context, here)),
      distance_(values_at_start(options.distance, context, here)),
      state_(add_state(context)),
      slip_rate_(add_slip_rate(context)),
      events_(context, options.event_slip_rate) {
  if (const std::string place = place_of_zero(mesh_, friction); !place.empty())
    throw InputError(context.origin, "'friction' of '" + context.name + "' is 0 at " + place,
                     "with 'rate_and_state' it is the friction of steady slip at the reference rate",
                     "give a positive one, for example 0.6, or remove 'rate_and_state'");
  state_.set_both(options.initial_state
                      ? values_at_start(*options.initial_state, context, here)
                      : Vector(distance_.cwiseQuotient(values_at_start(*options.initial_slip_rate, context, here))));
}

void RateAndStateWalls::evaluate_data(const Property& friction) const {
  if (const std::string place = place_of_zero(mesh_, friction); !place.empty())
    throw DataError("the friction with 'rate_and_state' falls to 0 at " + place + " (it has to be positive)");
}

RateAndStateLaw RateAndStateWalls::law(int cell, double friction) const {
  const double damping = options_.is_damped ? shear_modulus(cell) / (2 * options_.wave_speed) : 0.0;
  return {friction, a_[cell], b_[cell], distance_[cell], options_.reference_rate, damping};
}

RateAndStateLaw::Returned RateAndStateWalls::returned(int cell, double friction, double trial, double pressure,
                                                      double stiffness) const {
  SPREKK_EXPECT(has_step());
  return law(cell, friction).returned(trial, stiffness, {state_.accepted()[cell], step_.dt, pressure});
}

double RateAndStateWalls::slip_rate(int cell) const {
  return slip_rate_.now().segment<tangents>(tangents * cell).norm();
}

Vector RateAndStateWalls::rates_of_cells() const {
  Vector rates(mesh_.fracture_cell_count());
  for (int i = 0; i < rates.size(); ++i) rates[i] = slip_rate(i);
  return rates;
}

void RateAndStateWalls::set_slip_rates(Vector rates) {
  slip_rate_.set(std::move(rates));
  Vector states(mesh_.fracture_cell_count());
  for (int i = 0; i < states.size(); ++i)
    states[i] = law(i, 0).state_after(state_.accepted()[i], step_.dt, slip_rate(i));
  state_.set(std::move(states));
}

double RateAndStateWalls::longest_step() const {
  double longest = std::numeric_limits<double>::infinity();
  for (int i = 0; i < mesh_.fracture_cell_count(); ++i) {
    if (!here_.empty() && !here_[i]) continue;
    longest = std::min(longest, state_.now()[i]);
    if (const double rate = slip_rate(i); rate > 0) longest = std::min(longest, distance_[i] / rate);
  }
  return options_.state_change * longest;
}

std::optional<StepTooLong> RateAndStateWalls::too_long(const Vector& slip, const StepTime& step) const {
  constexpr double more_at_end = 2;  // times the slip that is allowed at the rate of the start
  double most = 0;
  int place = 0;
  for (int i = 0; i < mesh_.fracture_cell_count(); ++i) {
    const double slipped = std::max(slip.segment<tangents>(tangents * i).norm(), slip_rate(i) * step.dt);
    const double over = slipped / (options_.state_change * distance_[i]);
    if (over <= most) continue;
    most = over;
    place = i;
  }
  if (most <= more_at_end) return std::nullopt;
  constexpr double least = 0.1, largest = 0.5;  // of the step
  return StepTooLong{step.dt * std::clamp(1 / most, least, largest),
                     fmt::format("slip at {} has accelerated to {:.3g} m/s",
                                 to_text(mesh_.fracture_cells[place].center), slip_rate(place))};
}

SlipEvents::Step RateAndStateWalls::step_of_events(const SlippingWalls& walls) const {
  return {step_.start, step_.end, walls, rates_of_cells(), shear_modulus_};
}

void RateAndStateWalls::accepted(const SlippingWalls& walls) { events_.accept(step_of_events(walls)); }

std::vector<Event> RateAndStateWalls::events(const std::string& name, const SlippingWalls& walls) const {
  const SlipEvents::Step step = step_of_events(walls);
  if (!events_.ends_with(step)) return {};
  const SlipEvents::Event event = events_.after(step);
  std::vector<Quantity> figures = figures_of(event.rupture);
  figures.push_back({"slip_rate", "m/s", event.peak_slip_rate});
  return {{"slip", name, event.begin, event.end, event.rupture.place, std::move(figures),
           "slip is slower than " + quantity_text(options_.event_slip_rate, "m/s") + " again"}};
}

void RateAndStateWalls::report(const std::string& name, const SlippingWalls& walls,
                               std::vector<Quantity>& quantities) const {
  const SlipEvents::Step step = step_of_events(walls);
  quantities.push_back({name + ".largest_slip_rate", "m/s", step.slip_rate.maxCoeff()});
  SlipEvents::report(name, events_.after(step), quantities);
}

void RateAndStateWalls::output(std::vector<OutputField>& fields) const {
  for (const Field* field : {&state_, &slip_rate_})
    fields.push_back(
        {field->name(), field->spec().unit, Location::fracture_cell, field->spec().components, field->now()});
}

void RateAndStateWalls::note_input(const std::string& name, Notes& notes) const {
  if (!options_.is_damped && (b_ - a_).maxCoeff() > 0)
    notes.add(name + " without radiation damping",
              "slip of '" + name +
                  "' may run away, and then nothing limits its rate (b exceeds a, and the scene has no "
                  "'radiation_damping') add radiation_damping: {wave_speed: ...} to 'rate_and_state'");
}

void RateAndStateWalls::note_step(const std::string& name, const Vector& traction, const SlippingWalls& walls,
                                  Notes& notes) const {
  constexpr double resolved = 1.0 / 3;  // of L_b, the length over which slip concentrates (Rubin and Ampuero 2005)
  double coarsest = 0;
  int place = 0;
  for (int i = 0; i < mesh_.fracture_cell_count() && shear_modulus_.size() > 0; ++i) {
    if (b_[i] <= a_[i]) continue;
    const double pressure = std::max(0.0, -traction[dimension * i]);
    const double parts = mesh_.fracture_cells[i].size() * b_[i] * pressure / (shear_modulus_[i] * distance_[i]);
    if (parts <= coarsest) continue;
    coarsest = parts;
    place = i;
  }
  if (coarsest > resolved)
    notes.add(
        name + " coarse cells",
        fmt::format("fracture cells of '{}' at {} are {:.2g} times L_b = G L/(b N) long (over {:.2g} of it, cells "
                    "slip one by one: the answer is that of the mesh) refine the fracture",
                    name, to_text(mesh_.fracture_cells[place].center), coarsest, resolved),
        coarsest);
  const SlipEvents::Step step = step_of_events(walls);
  if (!events_.ends_with(step)) return;
  const SlipEvents::Event event = events_.after(step);
  notes.add(name + " events",
            fmt::format("slip of '{}' was faster than {} from {:.8g} s to {:.8g} s (event {}: moment {:.4g} {}, {:.4g} "
                        "{}, {:.3g} m/s at most) all events are in events.csv",
                        name, quantity_text(options_.event_slip_rate, "m/s"), event.begin, event.end, event.count,
                        event.rupture.moment, dimension == 2 ? "N m for each m of depth" : "N m", event.rupture.size,
                        dimension == 2 ? "m long" : "m^2 large", event.peak_slip_rate),
            event.rupture.moment);
}

void RateAndStateWalls::save(const std::string& name, std::map<std::string, Vector>& state) const {
  events_.save(name, state);
}

void RateAndStateWalls::restore(const std::string& name, const std::map<std::string, Vector>& state) {
  events_.restore(name, state);
}

}  // namespace sprekk::contact
