// Slip, or opening, that runs away: walls lose strength faster than the rock unloads them.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "components/contact/frictional_contact.hpp"
#include "components/contact/rate_and_state_walls.hpp"
#include "components/contact/trial_state.hpp"
#include "framework/invariants.hpp"
#include "framework/mesh/geometry.hpp"
#include "framework/output/progress.hpp"
#include "framework/round_off.hpp"

namespace sprekk::contact {

namespace {

/// The connected cells of one fracture around a cell that move, itself among them, ascending.
std::vector<int> nucleus_around(const Mesh& mesh, int cell, const std::vector<char>& moves) {
  std::vector<int> nucleus{cell};
  std::vector<char> is_in(moves.size(), 0);
  is_in[cell] = 1;
  for (std::size_t next = 0; next < nucleus.size(); ++next)
    for (const int ridge : mesh.fracture_cells[nucleus[next]].ridges)
      for (const int other : mesh.ridges[ridge].cells)
        if (moves[other] && !is_in[other] &&
            mesh.fracture_cells[other].fracture == mesh.fracture_cells[cell].fracture) {
          is_in[other] = 1;
          nucleus.push_back(other);
        }
  std::ranges::sort(nucleus);
  return nucleus;
}

/// The loss of strength over opening, Pa/m.
double lost_by_opening(const Strength& strength) { return -strength.tension_by_path; }

}  // namespace

Softened FrictionalContact::softened() const {
  Softened softened{{&traction_, &jump_, {}, {}}};
  if (!may_weaken()) return softened;
  const FreeValues free = free_values();
  std::vector<double> factors;
  for (int i = 0; i < mesh_.fracture_cell_count(); ++i) {
    if (!is_on_fracture_cell(i) || is_bonded(i)) continue;
    const Trial t = trial(i);
    const double normal = std::min({0.0, t.normal, traction_.accepted()[dimension * i]});
    const Strength strength = strength_before(i, normal);
    for (int k = 0; k < dimension; ++k) {
      const double lost = k == 0 ? lost_by_opening(strength) : lost_by_slip(strength, normal, dt_);
      const double moved = jump_.now()[dimension * i + k] - jump_.accepted()[dimension * i + k];
      // Walls that have hardly moved lose no strength.
      if (lost <= 0 || std::abs(moved) <= rounding::same * distance_of_loss(strength, normal)) continue;
      const auto place = std::ranges::lower_bound(free.values, dimension * i + k);
      if (place == free.values.end() || *place != dimension * i + k) {
        softened.spent = std::numeric_limits<double>::infinity();
        continue;
      }
      softened.values.values.push_back(*place);
      factors.push_back(free.factors[place - free.values.begin()]);
      if (lost > (k == 0 ? lost_by_opening(t.strength) : lost_by_slip(t.strength, normal, dt_)))
        softened.spent = std::max(softened.spent, lost);
    }
  }
  softened.values.factors = Eigen::Map<const Vector>(factors.data(), std::ssize(factors));
  return softened;
}

FreeValues FrictionalContact::free_values() const {
  FreeValues free{&traction_, &jump_, {}, {}};
  if (!may_weaken()) return free;
  std::vector<double> factors;
  for (int i = 0; i < mesh_.fracture_cell_count(); ++i) {
    if (!is_on_fracture_cell(i) || is_bonded(i)) continue;
    const Trial t = trial(i);
    const bool parts = t.is_open() && t.strength.tension_by_path < 0;
    const bool slips = !t.sticks() && (!t.is_open() || t.holds_open);
    for (int k = 0; k < dimension; ++k) {
      if (k == 0 ? !parts : !slips) continue;
      free.values.push_back(dimension * i + k);
      factors.push_back(-1 / stiffness()[dimension * i + k]);
    }
  }
  free.factors = Eigen::Map<const Vector>(factors.data(), std::ssize(factors));
  return free;
}

std::string FrictionalContact::tell_loss(const LossOfStability& loss) const {
  SPREKK_EXPECT(std::ssize(loss.values) == loss.motion.size() && loss.motion.size() > 0, loss.motion.size());
  Eigen::Index largest = 0;
  loss.motion.cwiseAbs().maxCoeff(&largest);
  std::vector<char> moves(mesh_.fracture_cell_count(), 0);
  double weakening = 0, weight = 0;
  for (Eigen::Index k = 0; k < loss.motion.size(); ++k) {
    const int i = loss.values[k] / dimension;
    moves[i] = 1;
    const Trial t = trial(i);
    const bool is_opening = loss.values[k] % dimension == 0;
    const double lost =
        is_opening ? lost_by_opening(t.strength) : lost_by_slip(t.strength, std::min(0.0, t.normal), dt_);
    const double share = mesh_.fracture_cells[i].measure * loss.motion[k] * loss.motion[k];
    weakening += share * lost;
    weight += share;
  }
  weakening /= weight;
  const int cell = loss.values[largest] / dimension;
  double size = 0;
  Point centre = Point::Zero();
  for (const int i : nucleus_around(mesh_, cell, moves)) {
    size += mesh_.fracture_cells[i].measure;
    centre += mesh_.fracture_cells[i].measure * mesh_.fracture_cells[i].center;
  }
  centre /= size;
  const char* motion = loss.values[largest] % dimension == 0 ? "opening" : "slip";
  return fmt::format(
      "{0} runs away at {1:.6g} s: along {2:.4g} {7} of fracture '{3}' around {4} walls lose {5:.4g} Pa/m of {0}, and "
      "the "
      "rock takes {6:.4g} Pa/m off them (dynamic {0}: inertia alone limits it, and there is none here) end the run "
      "before, "
      "or take 'rate_and_state' with 'radiation_damping', which follows fast slip",
      motion, loss.time, size, mesh_.fractures[mesh_.fracture_cells[cell].fracture].name, to_text(centre), weakening,
      weakening + loss.stiffness, dimension == 2 ? "m" : "m^2");
}

void FrictionalContact::note_passed(const std::string& told, Notes& notes) {
  passed_ = told;
  double moved = 0;
  for (int i = 0; i < mesh_.fracture_cell_count(); ++i)
    if (is_on_fracture_cell(i))
      moved = std::max(moved, (jump_.now() - jump_.accepted()).segment<dimension>(dimension * i).norm());
  notes.add(name() + " has run away",
            fmt::format("walls jump by {:.3g} m to another equilibrium, and real ones may come to rest elsewhere: {}",
                        moved, told),
            moved);
}

std::vector<Quantity> FrictionalContact::event_figures() const {
  std::vector<Quantity> figures = figures_of(Rupture{});
  if (rate_and_state_) figures.push_back({"slip_rate", "m/s", 0});
  return figures;
}

std::vector<Event> FrictionalContact::events(const StepTime& step) const {
  const SlippingWalls walls = slipping_walls();
  if (rate_and_state_) return rate_and_state_->events(name(), walls);
  if (passed_.empty()) return {};
  Vector slip = walls.slip;
  std::vector<char> slides(mesh_.fracture_cell_count());
  for (int i = 0; i < mesh_.fracture_cell_count(); ++i) {
    slip.segment<dimension - 1>((dimension - 1) * i) -= tangential(jump_.accepted(), i);
    slides[i] = is_on_fracture_cell(i) && state(i) == State::slip;
  }
  const Rupture rupture = rupture_of(mesh_, slip, walls.shear_before - walls.shear, shear_modulus_, slides);
  return {{"runaway", name(), step.end, step.end, rupture.place, figures_of(rupture), passed_}};
}

}  // namespace sprekk::contact
