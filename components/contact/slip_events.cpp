#include "components/contact/slip_events.hpp"

#include <algorithm>
#include <array>

#include "components/contact/fields.hpp"
#include "framework/invariants.hpp"

namespace sprekk::contact {

namespace {

Vector values_of(const SlipEvents::Event& event) {
  const Rupture& rupture = event.rupture;
  const std::array values = {event.goes_on ? 1.0 : 0.0, event.count,    event.begin,  event.end,
                             event.peak_slip_rate,      rupture.moment, rupture.size, rupture.stress_drop,
                             rupture.largest_slip};
  Vector all(std::ssize(values) + dimension);
  all << Eigen::Map<const Vector>(values.data(), std::ssize(values)), rupture.place;
  return all;
}

}  // namespace

SlipEvents::SlipEvents(const ComponentContext& context, double rate)
    : mesh_(context.mesh),
      rate_(rate),
      slip_before_(add_slip_before_event(context)),
      shear_before_(add_shear_before_event(context)),
      peak_rate_(add_peak_slip_rate(context)) {}

Vector SlipEvents::peaks_after(const Step& step) const {
  SPREKK_EXPECT(step.slip_rate.size() == mesh_.fracture_cell_count(), step.slip_rate.size());
  return latest_.goes_on ? Vector(peak_rate_.accepted().cwiseMax(step.slip_rate)) : step.slip_rate;
}

void SlipEvents::begin_step(const SlippingWalls& walls) {
  if (!latest_.goes_on) shear_before_.set_both(walls.shear_before);
}

SlipEvents::Event SlipEvents::after(const Step& step) const {
  Event event = latest_;
  const bool is_fast = step.slip_rate.size() > 0 && step.slip_rate.maxCoeff() > rate_;
  if (!event.goes_on && !is_fast) return event;
  if (!event.goes_on) event = {true, event.count + 1, step.start, step.end, 0, {}};
  event.goes_on = is_fast;
  event.end = step.end;
  const Vector peaks = peaks_after(step);
  event.peak_slip_rate = peaks.maxCoeff();
  std::vector<char> takes_part(peaks.size());
  for (int i = 0; i < peaks.size(); ++i) takes_part[i] = peaks[i] > rate_;
  event.rupture = rupture_of(mesh_, step.walls.slip - slip_before_.accepted(),
                             shear_before_.accepted() - step.walls.shear, step.shear_modulus, takes_part);
  return event;
}

void SlipEvents::accept(const Step& step) {
  Vector peaks = peaks_after(step);
  latest_ = after(step);
  if (!latest_.goes_on) {
    slip_before_.set_both(step.walls.slip);
    peaks.setZero();
  }
  peak_rate_.set_both(std::move(peaks));
}

void SlipEvents::begin_anew(const Vector& slip) {
  latest_ = {};
  slip_before_.set_both(slip);
  peak_rate_.set_both(Vector::Zero(peak_rate_.size()));
}

void SlipEvents::report(const std::string& name, const Event& event, std::vector<Quantity>& quantities) {
  quantities.push_back({name + ".events", "1", event.count});
  quantities.push_back({name + ".event_begin", "s", event.begin});
  quantities.push_back({name + ".event_end", "s", event.end});
  const bool is_plane = dimension == 2;
  quantities.push_back({name + ".event_moment", is_plane ? "N" : "N*m", event.rupture.moment});
  quantities.push_back(
      {name + (is_plane ? ".event_length" : ".event_area"), is_plane ? "m" : "m^2", event.rupture.size});
  quantities.push_back({name + ".event_peak_slip_rate", "m/s", event.peak_slip_rate});
}

void SlipEvents::save(const std::string& name, std::map<std::string, Vector>& state) const {
  state[name + ".event"] = values_of(latest_);
}

void SlipEvents::restore(const std::string& name, const std::map<std::string, Vector>& state) {
  const auto found = state.find(name + ".event");
  if (found == state.end() || found->second.size() != values_of({}).size())
    throw InputError("cannot restart: the events of '" + name +
                     "' are missing or damaged in the checkpoint start the run from its beginning, without --restart");
  const Vector& v = found->second;
  latest_ = {v[0] != 0, v[1], v[2], v[3], v[4], {v[5], v[6], v[7], v[8], v.tail<dimension>()}};
}

}  // namespace sprekk::contact
