// What the options of tips must fit: the mesh, and each other.
#include <fmt/format.h>

#include <algorithm>

#include "components/fine_fracture/tips/tips.hpp"

namespace sprekk::fine_fracture {

void Tips::require_loads() const {
  if (surroundings_) return;
  throw InputError(origin_, fmt::format("nothing loads the tips of {}", name()),
                   "no coupler 'two_level' names it: its tips would see neither rock nor fluid",
                   fmt::format("add '- {{type: two_level, between: [ROCK, FLOW, {}]}}' to 'couplers:', with the names "
                               "of your rock and of the flow in its fractures",
                               name()));
}

/// Displacements of the outline are linear over coarse cells, so the outline has to be at least one coarse cell away
/// from the tip. With a quarter of a cell K_II would be half of what it is.
void Tips::check_size(const Tip& tip) const {
  const double least = 2 * tip.coarse_size / largest_enlargement;
  if (options_.size >= least) return;
  throw InputError(
      origin_,
      fmt::format("'size' of {} is {:.4g} m, and the mesh at the tip {} has edges of {:.4g} m", name(), options_.size,
                  tip.name, tip.coarse_size),
      fmt::format("the square around a tip, made up to twice as wide, must reach one of them beyond it: 'size' is "
                  "at least {:.4g} m; ten of them give factors within 1 %",
                  least),
      "choose a larger 'size', or a smaller mesh.fracture_size");
}

/// A path grows in the square before the coarse level takes it over. It ends before the sides of the rock.
void Tips::check_increment() const {
  const double increment = options_.growth.increment, half = 0.5 * options_.size;
  if (options_.toughness && increment == 0)
    throw InputError(origin_, "'growth' of " + name() + " is missing", "tips with a toughness grow by increments",
                     "add 'growth: {increment: …}', half of mesh.fracture_size for example, or leave out 'toughness'");
  const auto is_near_the_first = [&](const Point& x) {
    return (x - mesh_.nodes[0]).cwiseAbs().maxCoeff() <= options_.size;
  };
  if (!options_.toughness || increment <= half || std::ranges::all_of(mesh_.nodes, is_near_the_first)) return;
  throw InputError(
      origin_,
      fmt::format("'growth.increment' of {} is {:.4g} m, and 'size' is {:.4g} m", name(), increment, options_.size),
      fmt::format("an increment has to end in the square around its tip, which reaches {:.4g} m", half),
      "choose a shorter increment, or a larger 'size'");
}

/// Within steps each increment is a cell or two of the coarse level, in the held procedure an edge or two of the fine
/// one.
void Tips::check_shortest(const Tip& tip) const {
  constexpr double shortest = 0.01;  // of the cell at the tip
  const double least = shortest * tip.coarse_size;
  if (!options_.toughness || options_.growth.increment >= least) return;
  throw InputError(origin_,
                   fmt::format("'growth.increment' of {} is {:.4g} m, and the mesh at the tip {} has edges of {:.4g} m",
                               name(), options_.growth.increment, tip.name, tip.coarse_size),
                   fmt::format("segments of a path that are shorter than a hundredth of an edge ({:.4g} m) make a run "
                               "longer and no answer better: the edges limit it",
                               least),
                   "choose a longer increment, of half an edge for example, or a smaller mesh.fracture_size");
}

void Tips::check_anisotropy() const {
  const double strength = options_.anisotropy.strength;
  if (strength == 0) return;
  if (!(strength > Anisotropy::low && strength < Anisotropy::high))
    throw InputError(origin_, fmt::format("'toughness_anisotropy.strength' of {} is {:.4g}", name(), strength),
                     "in rock with strong anisotropy tips that grow straight are not where G/G_c is largest, and paths "
                     "zigzag between two directions, as finely as the increment lets them",
                     fmt::format("choose one between {} and {}, both exclusive", Anisotropy::low, Anisotropy::high));
  if (options_.toughness && !options_.growth.is_implicit())
    throw InputError(origin_,
                     fmt::format("'growth.direction' of {} is '{}', and its toughness is anisotropic", name(),
                                 options_.growth.direction),
                     "the rules for a kink at the old tip are those of isotropic rock",
                     "take 'implicit', or leave 'toughness_anisotropy' out");
}

void Tips::check_longest() const {
  const GrowthOptions& growth = options_.growth;
  if (!options_.toughness || !growth.longest || *growth.longest >= growth.smallest_length()) return;
  throw InputError(origin_,
                   fmt::format("'growth.longest' of {} is {:.4g} m, and its shortest increment is {:.4g} m", name(),
                               *growth.longest, growth.smallest_length()),
                   "a tip grows by no less than 'smallest' times 'increment' at once: it could never grow",
                   "choose a larger 'longest', or leave it out: there is no limit then");
}

}  // namespace sprekk::fine_fracture
