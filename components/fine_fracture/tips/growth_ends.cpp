// Growth that does not end at the toughness: the notes on it, and tips that cannot go on.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "components/fine_fracture/tips/tips.hpp"
#include "framework/assembly/notes.hpp"
#include "framework/noticeable.hpp"
#include "framework/round_off.hpp"

namespace sprekk::fine_fracture {

void Tips::note_end(const Tip& tip, const TipOutcome& outcome, bool has_joined) {
  const GrowthOptions& growth = options_.growth;
  const Sifs end = felt(tip, outcome.path, outcome.end);
  const double k_eq = equivalent_sif(end) / resistance(tip, outcome.path), excess = k_eq - 1;
  const double shear = end.k2 / end.k1;
  const bool has_grown = outcome.increments > 0;
  // Twice and three times the tolerances: the length and the direction of the last increment may be off by that, and by
  // a rest that is shorter than the shortest increment.
  constexpr double excess_in_tolerances = 2, shear_in_tolerances = 3;  // from where on there is a note
  const double most_excess = excess_in_tolerances * growth.arrest_tolerance,
               most_shear = shear_in_tolerances * growth.direction_tolerance;
  // A tip that has met another fracture ends there, whatever its load.
  const bool is_off =
      growth.seeks_arrest() && !has_joined && (excess > most_excess || (has_grown && excess < -most_excess));
  // The tip is blocked for good; its last increment does not matter.
  const bool is_blocked = outcome.blocked && !has_joined && excess > 0;
  // A tip that did not grow although its load is above the toughness by more than the tolerance.
  const bool waits = growth.seeks_arrest() && !has_grown && excess > growth.arrest_tolerance;
  // A tip that is hardly loaded has no direction.
  const bool is_sheared = growth.is_implicit() && has_grown && k_eq > growth.direction_tolerance &&
                          !(std::abs(end.k2) <= most_shear * end.k1);
  if (!is_off && !is_sheared && !is_blocked && !waits) return;
  std::string why = outcome.reason;
  for (const std::string& note : outcome.notes) why += "; " + note;
  const std::string name = this->name() + "." + tip.name;
  // Before a tip turns, its K_II/K_I is that of the crack it has, and says nothing on the growth.
  const std::string state = has_grown
                                ? fmt::format("at K_eq/K_IC = {:.4g} and K_II/K_I = {:.3g} ({})", k_eq, shear, why)
                                : fmt::format("at K_eq/K_IC = {:.4g} ({})", k_eq, why);
  if (is_blocked)
    notes_.push_back({name + " is stopped above its toughness",
                      fmt::format("{} stops {} it grows no more", name, state), std::abs(excess)});
  else if (is_off && !outcome.arrested)
    notes_.push_back(
        {name + " grows on in the next step",
         fmt::format("{} is still growing at the end of a step, {} smaller time steps follow it closer", name, state),
         std::abs(excess)});
  else if (is_off)
    notes_.push_back({name + " rests off its toughness",
                      fmt::format("{} has come to rest {} try a smaller 'growth.increment', or a smaller "
                                  "'growth.smallest'",
                                  name, state),
                      std::abs(excess)});
  else if (waits)
    notes_.push_back({name + " waits above its toughness",
                      fmt::format("{} waits {} it grows by {:.3g} mm or more, when the load has risen; a smaller "
                                  "'growth.smallest' follows it closer",
                                  name, state, 1e3 * growth.smallest_length()),
                      std::abs(excess)});
  if (is_sheared)
    notes_.push_back({name + " has grown into shear",
                      fmt::format("{} has grown to an end that is {} try a smaller 'growth.increment'", name, state),
                      std::abs(shear)});
}

std::vector<Quantity> Tips::event_figures() const {
  return {{"from", "m", 0}, {"to", "m", 0}, {"largest_load", "1", 0}, {"surplus_energy", "J/m", 0}};
}

std::vector<Event> Tips::events(const StepTime& step) const {
  std::vector<Event> events;
  if (examined_ != step.start) return events;
  for (const EndNote& note : notes_) {
    if (!note.event) continue;
    events.push_back(*note.event);
    Event& event = events.back();
    event.begin = event.end = step.end;
    for (const Tip& tip : tips_)
      if (event.thing == name() + "." + tip.name) event.place = position(tip, tip.now.path);
  }
  return events;
}

void Tips::note_step(Notes& notes, const StepTime&) const {
  for (const EndNote& note : notes_) notes.add(note.topic, note.text, note.measure);
  for (const Tip& tip : tips_) note_narrow_square(tip, notes);
  for (const Tip& tip : tips_)
    if (tip.lacks_contact)
      notes.add("no state of contact around " + name() + "." + tip.name,
                fmt::format("no state of contact was found on the walls around {}.{}, which slide by the law of their "
                            "cells: they carry the tractions of the coarse level, and K may be off by some percent",
                            name(), tip.name));
  if (!options_.toughness) return;
  for (const Tip& tip : tips_) note_shear(tip, notes);
}

/// A square that lies in rock with slanted sides may be too small for its coarse mesh (check_size).
void Tips::note_narrow_square(const Tip& tip, Notes& notes) const {
  const std::vector<Point>& outline = tip.domain.geometry.outline;
  if (outline.empty()) return;
  const double reach = reach_in_rock(mesh_, outline, position(tip, {})),
               least = std::min(tip.coarse_size, 0.5 * options_.size);
  if (reach >= (1 - rounding::same) * least) return;
  const std::string name = this->name() + "." + tip.name;
  notes.add("small square around " + name,
            fmt::format("the square around {} reaches {:.3g} m, less than an edge of the coarse level ({:.3g} m): a "
                        "slanted side of the rock is near, and K is less accurate (with a quarter of an edge half of "
                        "K_II is missing)",
                        name, reach, tip.coarse_size),
            tip.coarse_size / reach);
}

/// Where walls touch at the tip of a wing they carry the load, and K_I = 0; those of the fine level are open there.
void Tips::note_shear(const Tip& tip, Notes& notes) const {
  constexpr double near = 0.9;  // to growth: the note comes before they turn
  const Sifs &sifs = tip.now.sifs, touching{0, sifs.k2, sifs.t_stress};
  const double toughness = this->toughness(tip), load = equivalent_sif(touching) / toughness;
  // Walls that touch have a small K_I from round-off.
  if (!tip.now.has_started || !tip.now.is_evaluated || tip.now.is_stopped || sifs.k1 > noticeable * toughness ||
      load < near)
    return;
  const std::string name = this->name() + "." + tip.name;
  notes.add(
      name + " is closed and sheared",
      fmt::format("{} is closed and sheared, with K_I = {:.3g} and K_II = {:.3g} of the toughness: where walls touch "
                  "K_I is 0, and K_eq/K_IC = {:.3g} instead of {:.3g}; from there it turns out of its plane (Eq. 12 "
                  "of the paper), growth in its plane by shear is not modelled",
                  name, sifs.k1 / toughness, sifs.k2 / toughness, load, equivalent_sif(sifs) / toughness),
      load);
}

void Tips::stop_refused(std::vector<PathExtension>& extensions, const std::vector<TipOutcome>& outcomes) {
  while (!extensions.empty()) {
    try {
      check_extensions(mesh_, extensions, cavity().size);
      return;
    } catch (const ExtensionError& error) {
      const PathExtension refused = extensions[error.extension()];
      extensions.erase(extensions.begin() + error.extension());
      for (std::size_t i = 0; i < tips_.size(); ++i) {
        Tip& tip = tips_[i];
        if (tip.end.fracture != refused.fracture || tip.end.at_end != refused.at_end) continue;
        tip.now.path = tip.accepted.path;
        tip.now.is_stopped = true;
        set_factors(tip, outcomes[i].start);
        notes_.push_back({name() + "." + tip.name + " is stopped: the mesh cannot follow",
                          fmt::format("{}.{} stays where it is for good (the mesh cannot follow it: {})", name(),
                                      tip.name, error.what()),
                          0});
      }
    }
  }
}

}  // namespace sprekk::fine_fracture
