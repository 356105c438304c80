#include "components/contact/slip_events.hpp"

#include <algorithm>

#include "components/contact/fields.hpp"
#include "framework/invariants.hpp"

namespace sprekk::contact {

SlipEvents::SlipEvents(const ComponentContext& context, double rate)
    : mesh_(context.mesh),
      rate_(rate),
      slip_before_(add_slip_before_event(context)),
      peak_rate_(add_peak_slip_rate(context)) {}

Vector SlipEvents::peaks_after(const Step& step) const {
  SPREKK_EXPECT(step.slip_rate.size() == mesh_.fracture_cell_count(), step.slip_rate.size());
  return latest_.goes_on ? Vector(peak_rate_.accepted().cwiseMax(step.slip_rate)) : step.slip_rate;
}

SlipEvents::Event SlipEvents::after(const Step& step) const {
  Event event = latest_;
  const bool is_fast = step.slip_rate.size() > 0 && step.slip_rate.maxCoeff() > rate_;
  if (!event.goes_on && !is_fast) return event;
  if (!event.goes_on) event = {true, event.count + 1, step.start};
  event.goes_on = is_fast;
  event.end = step.end;
  const Vector peaks = peaks_after(step);
  event.peak_slip_rate = peaks.maxCoeff();
  event.moment = event.length = 0;
  for (int i = 0; i < mesh_.fracture_cell_count(); ++i) {
    const double measure = mesh_.fracture_cells[i].measure;
    constexpr int tangents = dimension - 1;
    const double slip = (step.slip - slip_before_.accepted()).segment<tangents>(tangents * i).norm();
    if (step.shear_modulus.size() > 0) event.moment += step.shear_modulus[i] * slip * measure;
    if (peaks[i] > rate_) event.length += measure;
  }
  return event;
}

void SlipEvents::accept(const Step& step) {
  Vector peaks = peaks_after(step);
  latest_ = after(step);
  if (!latest_.goes_on) {
    slip_before_.set_both(step.slip);
    peaks.setZero();
  }
  peak_rate_.set_both(std::move(peaks));
}

void SlipEvents::report(const std::string& name, const Event& event, std::vector<Quantity>& quantities) {
  quantities.push_back({name + ".events", "1", event.count});
  quantities.push_back({name + ".event_begin", "s", event.begin});
  quantities.push_back({name + ".event_end", "s", event.end});
  quantities.push_back({name + ".event_moment", "N", event.moment});
  quantities.push_back({name + ".event_length", "m", event.length});
  quantities.push_back({name + ".event_peak_slip_rate", "m/s", event.peak_slip_rate});
}

void SlipEvents::save(const std::string& name, std::map<std::string, Vector>& state) const {
  Vector values(7);
  values << (latest_.goes_on ? 1.0 : 0.0), latest_.count, latest_.begin, latest_.end, latest_.moment, latest_.length,
      latest_.peak_slip_rate;
  state[name + ".event"] = std::move(values);
}

void SlipEvents::restore(const std::string& name, const std::map<std::string, Vector>& state) {
  const auto found = state.find(name + ".event");
  if (found == state.end() || found->second.size() != 7)
    throw InputError("cannot restart: the events of '" + name +
                     "' are missing or damaged in the checkpoint start the run from its beginning, without --restart");
  const Vector& v = found->second;
  latest_ = {v[0] != 0, v[1], v[2], v[3], v[4], v[5], v[6]};
}

}  // namespace sprekk::contact
