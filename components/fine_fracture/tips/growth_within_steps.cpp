// What a run asks tips that grow within steps, and the search that they start.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "components/fine_fracture/tips/ends.hpp"
#include "components/fine_fracture/tips/tips_front.hpp"

namespace sprekk::fine_fracture {

namespace {

/// Of an increment, of the fastest tip in one step: tips that accelerate stay below `longest_advance`.
constexpr double wanted_advance = 0.85;
constexpr double wanted_turn = 0.08;  ///< rad, of the path at a tip in one step
constexpr double least_turn =
    0.02;  ///< rad in the last two steps, below which the next one is not expected to turn far

}  // namespace

bool Tips::may_grow_within_steps() const {
  return options_.toughness && options_.growth.seeks_arrest() && options_.growth.is_implicit() && maker_->is_steady();
}

void Tips::grow_within_steps() {
  for (const auto& [is_wrong, option] :
       {std::pair(!options_.growth.seeks_arrest(), std::string("'growth.length: fixed'")),
        std::pair(!options_.growth.is_implicit(), "'growth.direction: " + options_.growth.direction + "'")})
    if (is_wrong)
      throw InputError(origin_, option + " has no meaning with growth within steps",
                       "lengths and directions follow from K_eq = K_IC and K_II = 0 at the end of each step",
                       "leave it out, or choose 'update: after_step'");
  grows_within_steps_ = true;
  options_.growth.follow_kinks();
}

void Tips::note_input(Notes& notes) const {
  if (!surroundings_)
    notes.add(name() + " without a coupler",
              fmt::format("{0} has no factors (no coupler gives it the displacements of the rock) add '- {{type: "
                          "two_level, between: [ROCK, FLOW, {0}]}}' to 'couplers:'",
                          name()));
  if (!options_.growth.has_front_tolerance || grows_within_steps_) return;
  notes.add(
      "front_tolerance without effect",
      fmt::format("'growth.front_tolerance' of {} has no effect (its tips do not grow within steps) leave it out, "
                  "or let them: 'grow' with 'update: within_step'",
                  name()));
}

void Tips::prepare(Growing& other) const {
  for (Tip& tip : dynamic_cast<Tips&>(other).tips_)
    for (const Tip& same : tips_)
      if (is_same(same.end, tip.end)) tip.pattern = same.pattern, tip.next_start = same.next_start;
}

bool Tips::grows_on() const {
  if (!options_.toughness || !grows_within_steps_ || slopes_.size() == 0) return false;
  const auto is_settled = [](const Tip& tip) { return tip.now.is_stopped || tip.now.is_extendable; };
  return std::ranges::all_of(tips_, is_settled) &&
         std::ranges::any_of(tips_, [](const Tip& tip) { return !tip.now.is_stopped && tip.now.speed > 0; });
}

double Tips::longest_step() const {
  double longest = std::numeric_limits<double>::infinity();
  for (const Tip& tip : tips_) {
    if (!grows_within_steps_ || tip.now.is_stopped || tip.now.speed == 0) continue;
    longest = std::min(longest, wanted_advance * options_.growth.increment / tip.now.speed);
    // The end of an arc whose start is fixed turns twice as far as its chord.
    const double of_chord = tip.now.segment_start ? 2 : 1;
    const double turning = of_chord * std::abs(tip.now.turning) * tip.now.speed,  // rad/s
        before = of_chord * std::abs(tip.now.turning_before) * tip.now.speed_before;
    if (tip.now.is_extendable && turning * tip.now.lasted + before * tip.now.lasted_before > least_turn)
      longest = std::min(longest, wanted_turn / turning);
  }
  return longest;
}

std::unique_ptr<FrontSearch> Tips::search_front(const StepTime& step, bool may_shrink, bool goes_on) {
  if (!options_.toughness || !grows_within_steps_) return nullptr;
  if (goes_on) {
    notes_.clear();
    note_start(step);
  }
  auto search = std::make_unique<TipsFront>(*this, step, may_shrink, goes_on);
  if (search->is_needed()) return search;
  search->finish_without_growth();
  return nullptr;
}

}  // namespace sprekk::fine_fracture
