// What the contact reports of its state: columns, fields for pictures, notes.
#include <fmt/format.h>

#include <algorithm>

#include "components/contact/frictional_contact.hpp"
#include "components/contact/note_jumps.hpp"
#include "components/contact/options.hpp"
#include "components/contact/rate_and_state_walls.hpp"
#include "components/contact/shear_load.hpp"
#include "components/contact/trial_state.hpp"
#include "framework/mesh/geometry.hpp"
#include "framework/noticeable.hpp"

namespace sprekk::contact {

void FrictionalContact::report(std::vector<Quantity>& quantities) const {
  int counts[3] = {0, 0, 0};
  for (int i = 0; i < mesh_.fracture_cell_count(); ++i)
    if (is_on_fracture_cell(i)) ++counts[static_cast<int>(state(i))];
  quantities.push_back({name() + ".cells_stick", "1", static_cast<double>(counts[0])});
  quantities.push_back({name() + ".cells_slip", "1", static_cast<double>(counts[1])});
  quantities.push_back({name() + ".cells_open", "1", static_cast<double>(counts[2])});
  if (rate_and_state_) rate_and_state_->report(name(), slipping_walls(), quantities);
}

void FrictionalContact::output(std::vector<OutputField>& fields) const {
  Vector states(mesh_.fracture_cell_count());
  const bool is_at_start = traction_.now().isZero(0) && jump_.now().isZero(0);  // walls touch, and carry nothing yet
  for (int i = 0; i < states.size(); ++i) states[i] = is_at_start ? 0.0 : static_cast<double>(state(i));
  fields.push_back({.name = name() + ".state_0_stick_1_slip_2_open",
                    .unit = "1",
                    .location = Location::fracture_cell,
                    .values = std::move(states),
                    .is_a_choice = true});
  Vector tendency(mesh_.fracture_cell_count()), used(mesh_.fracture_cell_count());
  for (int i = 0; i < tendency.size(); ++i) {
    const Trial t = trial(i);
    const bool has_parted = !is_at_start && t.state() == State::open;  // tractions are round-off then
    const ShearLoad load = shear_load(traction_.now().segment<dimension>(dimension * i), t.strength, has_parted);
    tendency[i] = load.slip_tendency;
    used[i] = load.friction_used;
  }
  fields.push_back({name() + ".slip_tendency", "1", Location::fracture_cell, 1, std::move(tendency)});
  fields.push_back({name() + ".friction_used", "1", Location::fracture_cell, 1, std::move(used)});
  if (rate_and_state_) rate_and_state_->output(fields);
  if (history_) history_->output(fields);
}

void FrictionalContact::note_step(Notes& notes, const StepTime&) const {
  std::vector<char> is_open(mesh_.fracture_cell_count()), slides = is_open;
  for (int i = 0; i < mesh_.fracture_cell_count(); ++i) {
    is_open[i] = is_on_fracture_cell(i) && state(i) == State::open;
    slides[i] = is_on_fracture_cell(i) && state(i) == State::slip;
  }
  std::vector<double> springs;
  if (multiplier_ == Multiplier::none)
    for (int i = 0; i < mesh_.fracture_cell_count(); ++i)
      springs.push_back(is_on_fracture_cell(i) ? compliance(i)[1] : 0);
  note_jumps(notes, name(), mesh_, {traction_, jump_, is_open, slides, options_->large_jump, slip_at_start_, springs});
  if (rate_and_state_) rate_and_state_->note_step(name(), traction_.now(), slipping_walls(), notes);
}

void FrictionalContact::note_start(Notes& notes) const {
  int cells = 0, worst = none;
  double most = 0;
  for (int i = 0; i < mesh_.fracture_cell_count(); ++i) {
    const double beyond = is_on_fracture_cell(i) ? excess(i) : 0;
    if (beyond <= noticeable * traction_.now().segment<dimension>(dimension * i).norm()) continue;
    ++cells;
    if (beyond > most) {
      most = beyond;
      worst = i;
    }
  }
  if (cells == 0) return;
  constexpr double mega = 1e6;
  const Point traction = traction_.now().segment<dimension>(dimension * worst);
  const bool parts = traction[0] > 0;
  notes.add(name() + " out of balance at the start",
            fmt::format("{} cells of '{}' {} under the initial stress: at {} their traction is {:.3g} MPa across and "
                        "{:.3g} MPa along them, by {:.3g} MPa more than they hold (they move at once, in the first "
                        "step) let 'start: settle' find the equilibrium, or change the initial stress, the pressure or "
                        "the friction",
                        cells, name(), parts ? "part" : "slide", to_text(mesh_.fracture_cells[worst].center),
                        traction[0] / mega, traction.tail<dimension - 1>().norm() / mega, most / mega),
            most);
}

double FrictionalContact::excess(int i) const {
  const Strength strength = trial(i).strength;
  const Point traction = traction_.now().segment<dimension>(dimension * i);
  if (traction[0] > strength.tension) return traction[0] - strength.tension;
  if (rate_and_state_) return 0;  // such walls slide under any shear
  return traction.tail<dimension - 1>().norm() - strength.cohesion - strength.friction * std::max(0.0, -traction[0]);
}

void FrictionalContact::note_input(Notes& notes) const {
  if (rate_and_state_) rate_and_state_->note_input(name(), notes);
}

}  // namespace sprekk::contact
