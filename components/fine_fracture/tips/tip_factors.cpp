// Stress intensity factors of tips: from a fine level, or an estimate where none is needed.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "components/fine_fracture/tips/ends.hpp"
#include "components/fine_fracture/tips/tips.hpp"
#include "framework/mesh/plane/original_end.hpp"
#include "framework/round_off.hpp"

namespace sprekk::fine_fracture {
namespace {

bool is_same(const FineGeometry& a, const FineGeometry& b) {
  return a.outline == b.outline && a.beyond == b.beyond &&
         std::equal(a.cracks.begin(), a.cracks.end(), b.cracks.begin(), b.cracks.end(),
                    [](const CrackPath& x, const CrackPath& y) { return x.points == y.points && x.walls == y.walls; });
}

/// Whether the place is in the square, and the rosette of a tip there as well.
bool has_room(const std::vector<Point>& square, const Point& place, double radius) {
  return (place - square[0]).minCoeff() > radius && (square[2] - place).minCoeff() > radius;
}

}  // namespace

InputError Tips::refusal(const UnsuitableRock& rock) const {
  return InputError(origin_, std::string(rock.what()) + ", for " + name(), rock.wanted,
                    "choose fine_fracture/quarter_point, or a smaller 'size'");
}

/// This check is made before the run. Rock that changes, and squares that move with their tips, are checked during the
/// run.
void Tips::check_rock(const Tip& tip) const try {
  const Point center = position(tip, {});
  check_stiffness(fine_domain(mesh_, paths_with(paths_now()), tip.end, center, options_.size, tip.coarse_size,
                              CrackPath::Walls::traction),
                  surroundings_->stiffness(center));
} catch (const UnsuitableRock& rock) {
  throw refusal(rock);
}

void Tips::check_stiffness(const FineDomain& domain, const LameParameters& rock) const {
  constexpr int across = 16;  // places where the stiffness is compared
  const Point low = domain.geometry.outline[0], size = domain.geometry.outline[2] - low;
  for (int i = 0; i <= across; ++i)
    for (int k = 0; k <= across; ++k) {
      const Point x = low + size.cwiseProduct(Point(double(i) / across, double(k) / across));
      const LameParameters there = surroundings_->stiffness(x);
      if (std::abs(there.shear - rock.shear) <= rounding::same * rock.shear &&
          std::abs(there.lambda - rock.lambda) <= rounding::same * std::abs(rock.lambda))
        continue;
      throw UnsuitableRock(fmt::format("the rock at ({:.4g} m, {:.4g} m) has a shear modulus of {:.4g} Pa, and {:.4g} "
                                       "Pa at a tip with this place in its square",
                                       x[0], x[1], there.shear, rock.shear),
                           "boundary elements take rock of one stiffness there");
    }
}

Sifs Tips::evaluate(std::size_t index, const std::vector<TipPath>& paths) try {
  Tip& tip = tips_[index];
  // The square of the fine level stays around the tip of the coarse mesh while the path grows in it.
  const Point center = position(tip, {});
  const auto walls = surroundings_->gives_jumps() ? CrackPath::Walls::jump : CrackPath::Walls::traction;
  // Growth with the state held may leave the square of an earlier trial.
  if (tip.pattern && !has_room(tip.pattern->outline, position(tip, paths[index]), maker_->room(tip.coarse_size)))
    tip.pattern.reset();
  const std::vector<FracturePath> all = paths_with(paths);
  FineDomain domain = fine_domain(mesh_, all, tip.end, center, options_.size, tip.coarse_size, walls,
                                  tip.pattern ? &tip.pattern->outline : nullptr);
  if (maker_->wants_beyond()) add_beyond(domain, all);
  const LameParameters lame = surroundings_->stiffness(center);
  if (maker_->needs_one_stiffness() && !tip.pattern) check_stiffness(domain, lame);
  const FineRock rock =
      maker_->needs_one_stiffness() ? FineRock(Elasticity{lame.lambda, lame.shear}) : rock_around(center);
  if (!tip.level || !(tip.level->rock() == rock) || !is_same(domain.geometry, tip.domain.geometry)) {
    tip.kept_factors.reset();
    tip.lacks_contact = false;
    tip.offsets = nullptr;
    tip.body_forces = nullptr;
    tip.domain = std::move(domain);
    const bool keeps = is_followed(tip);
    const FineLoads loads = loads_of(tip);
    MadeFineLevel made = maker_->make({.domain = tip.domain,
                                       .rock = rock,
                                       .size = options_.size,
                                       .coarse_size = tip.coarse_size,
                                       .anchor = original_end(mesh_, tip.end.fracture, tip.end.at_end),
                                       .keeps = keeps,
                                       .kept = tip.pattern,
                                       .loads = loads,
                                       .profile = profile_});
    tip.level = std::move(made.level);
    meshes_ += made.meshes;
    if (made.factors) {
      solves_ += made.meshes;
      return keep_factors(tip, *made.factors);
    }
    tip.has_pattern = keeps;
    tip.topology = tip.level->topology();
    if (keeps) tip.pattern = std::move(made.kept);
  } else {
    tip.domain = std::move(domain);
  }
  // The kept factors are still valid if only paths outside of its domain have changed, or at the first evaluation of a
  // search.
  if (tip.kept_factors && tip.kept_factors->version == surroundings_->version()) {
    ++kept_;
    tip.now.sif_error = tip.kept_factors->error;
    return tip.kept_factors->sifs;
  }
  ++solves_;
  FineLoads loads = loads_of(tip);
  if (!tip.offsets) {
    const std::vector<Point>& places = tip.level->offset_places();
    tip.offsets = surroundings_->stress_offsets(
        places, arcs_of_last_segments().on_coarse_level(places, tip.domain.geometry.outline));
    tip.body_forces =
        surroundings_->body_forces({}) ? surroundings_->body_forces(tip.level->body_force_places()) : nullptr;
  }
  loads.stress_offset = [&tip](const std::vector<Point>&) { return tip.offsets(); };
  if (tip.body_forces) loads.body_force = [&tip](const std::vector<Point>&) { return tip.body_forces(); };
  tip.lacks_contact = false;
  try {
    return keep_factors(tip, tip.level->solve(loads));
  } catch (const UnsolvedGrowth&) {
    // Friction may allow no state of contact on these walls. The tractions of the coarse level are those of one.
    tip.lacks_contact = true;
    loads.sliding = nullptr;
    return keep_factors(tip, tip.level->solve(loads));
  }
} catch (const UnsuitableRock& rock) {
  throw refusal(rock);
}

FineRock Tips::rock_around(const Point& center) const {
  const auto at = [this](const Point& x) {
    const LameParameters lame = surroundings_->stiffness(x);
    return Elasticity{lame.lambda, lame.shear};
  };
  const std::uint64_t version = surroundings_->stiffness_by_place();
  if (version == 0) return FineRock(at(center));
  // Of rock whose stiffness differs from cell to cell there are too many to cut elements along them.
  constexpr std::size_t most_borders = 200;
  std::vector<FineRock::Border> borders;
  const double reach = 0.5 * largest_enlargement * options_.size;
  for (const FineRock::Border& border : surroundings_->stiffness_borders()) {
    const Point low = border[0].cwiseMin(border[1]) - center, high = border[0].cwiseMax(border[1]) - center;
    if (low.maxCoeff() <= reach && high.minCoeff() >= -reach) borders.push_back(border);
  }
  if (borders.size() > most_borders) borders.clear();
  return FineRock(at, version, std::move(borders));
}

Sifs Tips::keep_factors(Tip& tip, const TipFactors& factors) const {
  tip.now.sif_error = factors.error;
  tip.kept_factors = {surroundings_->version(), factors.sifs, factors.error};
  return factors.sifs;
}

double Tips::toughness(const TipEnd& end, const Point& x) const {
  const Data& data = *options_.toughness;
  return data.at({x, data.is_constant() ? 0 : surroundings_->region(x), 0, end.fracture});
}

double Tips::estimated_load(const Tip& tip) const {
  // Williams' field: the jump at a distance r behind the tip is (8/E') sqrt(r/(2 pi)) K.
  const LameParameters lame = surroundings_->stiffness(position(tip, {}));
  const double distance = 0.5 * end_cell(mesh_, tip.end).measure;
  const double estimate = Elasticity{lame.lambda, lame.shear}.plane_modulus() / 8 *
                          std::sqrt(2 * std::numbers::pi / distance) *
                          surroundings_->jump_at_tip(tip.end.fracture, tip.end.at_end);
  constexpr double shear_to_equivalent = 1.25;  // K_eq over the length of (K_I, K_II), at most
  const double lowest = toughness(tip.end, position(tip, tip.now.path)) * options_.anisotropy.smallest();
  return shear_to_equivalent * estimate / lowest;
}

void Tips::set_factors(Tip& tip, const Sifs& sifs) const {
  tip.now.sifs = sifs;
  tip.now.load = options_.toughness ? equivalent_sif(felt(tip)) / toughness(tip) : 0;
  tip.now.is_evaluated = true;
}

}  // namespace sprekk::fine_fracture
