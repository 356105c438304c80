// Slip, or opening, that runs away: walls lose strength faster than the rock unloads them.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "components/contact/frictional_contact.hpp"
#include "components/contact/trial_state.hpp"
#include "framework/invariants.hpp"
#include "framework/mesh/planar.hpp"
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

}  // namespace

bool FrictionalContact::has_softened() const {
  constexpr double least = 1e-9;  // of the distance over which strength is lost
  if (!path_) return false;
  for (int i = 0; i < mesh_.fracture_cell_count(); ++i) {
    if (!is_on_fracture_cell(i) || is_bonded(i)) continue;
    const double before = path_->accepted()[i];
    const Strength strength = weakening_.at(friction_[i], dynamic_friction(i), before);
    if (strength.friction_by_path == 0 && strength.cohesion_by_path == 0 && strength.tension_by_path == 0) continue;
    if (path(i, gap(i, traction_.now(), jump_.now())) - before > least * weakening_.distance) return true;
  }
  return false;
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
    const double lost = is_opening
                            ? -t.strength.tension_by_path
                            : t.strength.friction_by_path * std::min(0.0, t.normal) - t.strength.cohesion_by_path;
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

void FrictionalContact::note_passed(const std::string& told, Notes& notes) const {
  double moved = 0;
  for (int i = 0; i < mesh_.fracture_cell_count(); ++i)
    if (is_on_fracture_cell(i))
      moved = std::max(moved, (jump_.now() - jump_.accepted()).segment<dimension>(dimension * i).norm());
  notes.add(name() + " has run away",
            fmt::format("walls jump by {:.3g} m to another equilibrium, and real ones may come to rest elsewhere: {}",
                        moved, told),
            moved);
}

}  // namespace sprekk::contact
