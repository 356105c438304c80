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

namespace sprekk::contact {

namespace {

/// Neighbours on one fracture, all of which move.
struct Nucleus {
  int first, last;  ///< fracture cells
};

Nucleus nucleus_around(const Mesh& mesh, int cell, const std::vector<char>& moves) {
  const Fracture& fracture = mesh.fractures[mesh.fracture_cells[cell].fracture];
  Nucleus nucleus{cell, cell};
  while (nucleus.first > fracture.first_cell && moves[nucleus.first - 1]) --nucleus.first;
  while (nucleus.last + 1 < fracture.first_cell + fracture.cell_count && moves[nucleus.last + 1]) ++nucleus.last;
  return nucleus;
}

/// The loss of strength over slip, Pa/m, under this normal traction, and over opening.
double lost_by_slip(const Strength& strength, double normal) {
  return strength.friction_by_path * normal - strength.cohesion_by_path;
}
double lost_by_opening(const Strength& strength) { return -strength.tension_by_path; }

}  // namespace

Softened FrictionalContact::softened() const {
  constexpr double least = 1e-9;  // of the distance over which strength is lost: far below any loss of strength
  Softened softened{{&traction_, &jump_, {}, {}}};
  if (!path_) return softened;
  const FreeValues free = free_values();
  std::vector<double> factors;
  for (int i = 0; i < mesh_.fracture_cell_count(); ++i) {
    if (!is_on_fracture_cell(i) || is_bonded(i)) continue;
    const Strength strength = weakening_.at(friction_[i], dynamic_friction(i), path_->accepted()[i]);
    const Trial t = trial(i);
    const double normal = std::min({0.0, t.normal, traction_.accepted()[dimension * i]});
    for (int k = 0; k < dimension; ++k) {
      const double lost = k == 0 ? lost_by_opening(strength) : lost_by_slip(strength, normal);
      const double moved = jump_.now()[dimension * i + k] - jump_.accepted()[dimension * i + k];
      if (lost <= 0 || std::abs(moved) <= least * weakening_.distance) continue;
      const auto place = std::ranges::lower_bound(free.values, dimension * i + k);
      if (place == free.values.end() || *place != dimension * i + k) {
        softened.spent = std::numeric_limits<double>::infinity();
        continue;
      }
      softened.values.values.push_back(*place);
      factors.push_back(free.factors[place - free.values.begin()]);
      if (lost > (k == 0 ? lost_by_opening(t.strength) : lost_by_slip(t.strength, normal)))
        softened.spent = std::max(softened.spent, lost);
    }
  }
  softened.values.factors = Eigen::Map<const Vector>(factors.data(), std::ssize(factors));
  return softened;
}

FreeValues FrictionalContact::free_values() const {
  FreeValues free{&traction_, &jump_, {}, {}};
  if (!path_) return free;
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
    const double lost = is_opening ? lost_by_opening(t.strength) : lost_by_slip(t.strength, std::min(0.0, t.normal));
    const double share = mesh_.fracture_cells[i].measure * loss.motion[k] * loss.motion[k];
    weakening += share * lost;
    weight += share;
  }
  weakening /= weight;
  const int cell = loss.values[largest] / dimension;
  const auto [first, last] = nucleus_around(mesh_, cell, moves);
  double length = 0;
  Point centre = Point::Zero();
  for (int i = first; i <= last; ++i) {
    length += mesh_.fracture_cells[i].measure;
    centre += mesh_.fracture_cells[i].measure * mesh_.fracture_cells[i].center;
  }
  centre /= length;
  const char* motion = loss.values[largest] % dimension == 0 ? "opening" : "slip";
  return fmt::format(
      "{0} runs away at {1:.6g} s: along {2:.4g} m of fracture '{3}' around {4} walls lose {5:.4g} Pa/m of {0}, and "
      "the "
      "rock takes {6:.4g} Pa/m off them (dynamic {0}: inertia alone limits it, and there is none here) end the run "
      "before, "
      "or take 'rate_and_state' with 'radiation_damping', which follows fast slip",
      motion, loss.time, length, mesh_.fractures[mesh_.fracture_cells[cell].fracture].name, to_text(centre), weakening,
      weakening + loss.stiffness);
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
