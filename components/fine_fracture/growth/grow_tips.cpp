#include "components/fine_fracture/growth/grow_tips.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <utility>

#include "components/fine_fracture/growth/increments.hpp"
#include "framework/invariants.hpp"
#include "framework/parallel/interruption.hpp"

namespace sprekk::fine_fracture {

namespace {

std::string in_mm(double length) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g mm", 1e3 * length);
  return text;
}

Point turned(const Point& direction, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {c * direction[0] - s * direction[1], s * direction[0] + c * direction[1]};
}

constexpr const char* not_finite = "its stress intensity factors are not finite";

/// A tip between rounds, and its increment while one is searched for.
struct State {
  Point end, ahead;
  Sifs sifs;
  bool is_stopped = false;
  bool is_outdated = true;  ///< whether `sifs`, or those of the increment, belong to older paths
  WarmStart warm_start;
  std::unique_ptr<IncrementSearch> search;
  Sifs found;  ///< at the end of the increment once the search is settled
};

class Growth {
 public:
  Growth(const std::vector<GrowingTip>& tips, const GrowthOptions& options, const EvaluateSifs& evaluate,
         const FreeLength& free_length, const InteractsWith& interacts)
      : tips_(tips),
        options_(options),
        evaluate_(evaluate),
        free_length_(free_length),
        interacts_(interacts),
        states_(tips.size()),
        outcomes_(tips.size()) {
    for (const GrowingTip& tip : tips_) paths_.push_back(tip.path);
    for (int i = 0; i < count(); ++i) {
      SPREKK_EXPECT(tips_[i].toughness > 0, i, tips_[i].toughness);
      SPREKK_EXPECT(tips_[i].youngs_prime > 0, i, tips_[i].youngs_prime);
      SPREKK_EXPECT(is_unit(tips_[i].direction), i, tips_[i].direction.norm());
      State& state = states_[i];
      const std::vector<Point>& added = tips_[i].path.added;
      state.end = added.empty() ? tips_[i].tip : added.back();
      state.ahead = tips_[i].direction;
      state.warm_start = tips_[i].warm_start;
      if (!added.empty())
        state.ahead = (added.back() - (added.size() > 1 ? added[added.size() - 2] : tips_[i].tip)).normalized();
    }
  }

  std::vector<TipOutcome> run() {
    update_resting();
    for (int i = 0; i < count(); ++i) outcomes_[i].start = states_[i].sifs;
    while (begin_round()) {
      search_increments();
      end_round();
      update_resting();
    }
    for (int i = 0; i < count(); ++i) {
      if (states_[i].is_outdated && outcomes_[i].reason != not_finite) update(i);
      outcomes_[i].path = paths_[i];
      outcomes_[i].end = states_[i].sifs;
      outcomes_[i].warm_start = states_[i].warm_start;
      if (!states_[i].is_stopped) outcomes_[i].arrested = true;
    }
    return std::move(outcomes_);
  }

 private:
  int count() const { return static_cast<int>(tips_.size()); }

  Sifs evaluate(int i) {
    interruption::poll_alone();
    ++outcomes_[i].evaluations;
    states_[i].is_outdated = false;
    SPREKK_ASSERT(static_cast<int>(paths_.size()) == count(), paths_.size(), count());
    return evaluate_(i, paths_);
  }

  void outdate_those_that_interact(int moved) {
    for (int i = 0; i < count(); ++i)
      if (i != moved && (!interacts_ || interacts_(i, moved))) states_[i].is_outdated = true;
  }

  void stop(int i, const std::string& reason, bool arrested) {
    states_[i].is_stopped = true;
    outcomes_[i].reason = reason;
    outcomes_[i].arrested = arrested;
  }

  /// Renews the outdated factors of tips that may still grow, between two rounds.
  void update_resting() {
    for (int i = 0; i < count(); ++i)
      if (states_[i].is_outdated && !states_[i].is_stopped) update(i);
  }

  void update(int i) {
    states_[i].sifs = evaluate(i);
    if (!is_finite(states_[i].sifs)) stop(i, not_finite, false);
  }

  bool is_to_grow(int i) {
    State& state = states_[i];
    TipOutcome& outcome = outcomes_[i];
    if (state.is_stopped) return false;
    const double ratio = equivalent_sif(state.sifs) / tips_[i].toughness;
    // After an increment the tip is at rest where K_eq is within the tolerance; before the first one the toughness
    // itself decides.
    const double tolerance = outcome.increments > 0 && options_.seeks_arrest() ? options_.arrest_tolerance : 0;
    if (!(ratio > 1 + tolerance)) {
      outcome.reason = outcome.increments == 0                   ? "K_eq does not exceed the toughness"
                       : ratio >= 1 - tolerance && tolerance > 0 ? "K_eq has come down to the toughness"
                                                                 : "K_eq is below the toughness";
      return false;
    }
    if (outcome.increments >= options_.at_most)
      stop(i, "it has grown by the largest number of increments, " + std::to_string(options_.at_most), false);
    else if (options_.longest && *options_.longest - outcome.length < options_.smallest_length())
      stop(i, "it has grown by the largest length, " + in_mm(*options_.longest), false);
    return !state.is_stopped;
  }

  bool begin_round() {
    std::vector<int> growing;
    std::vector<double> energies;
    for (int i = 0; i < count(); ++i)
      if (is_to_grow(i)) {
        growing.push_back(i);
        energies.push_back(energy_release_rate(states_[i].sifs, tips_[i].youngs_prime));
      }
    const std::vector<double> lengths = increment_lengths(energies, options_.increment, options_.energy_exponent);
    for (std::size_t k = 0; k < growing.size(); ++k) {
      const int i = growing[k];
      double length = std::max(lengths[k], options_.smallest_length());
      if (options_.longest) length = std::min(length, *options_.longest - outcomes_[i].length);
      states_[i].search = std::make_unique<IncrementSearch>(options_, states_[i].sifs, tips_[i].toughness, length,
                                                            states_[i].warm_start);
      paths_[i].added.push_back(states_[i].end);
      place(i);
    }
    return !growing.empty();
  }

  Point trial_end(const State& state) const {
    SPREKK_ASSERT(state.search && state.search->length() > 0 && std::isfinite(state.search->angle()));
    return state.end + state.search->length() * turned(state.ahead, state.search->angle());
  }

  /// Puts the end of the increment to the place that the search asks for, as far as its free length allows.
  void place(int i) {
    State& state = states_[i];
    TipPath before = paths_[i];
    before.added.pop_back();
    if (state.search->length() > 0) state.search->limit_length(free_length_(i, before, trial_end(state)));
    if (state.search->length() > 0) {
      paths_[i].added.back() = trial_end(state);
      state.is_outdated = true;
    } else {
      paths_[i] = std::move(before);
    }
    outdate_those_that_interact(i);
  }

  void search_increments() {
    for (bool changed = true; changed;) {
      changed = false;
      std::vector<std::pair<int, Sifs>> found;
      for (int i = 0; i < count(); ++i)
        if (states_[i].search && states_[i].search->length() > 0 && states_[i].is_outdated)
          found.emplace_back(i, evaluate(i));
      // All tips are evaluated with the same paths before any of them is moved: their order does not matter.
      for (const auto& [i, sifs] : found) {
        learn(i, sifs);
        changed = true;
      }
    }
  }

  void learn(int i, const Sifs& sifs) {
    State& state = states_[i];
    if (!is_finite(sifs)) {
      abandon(i);
      return stop(i, not_finite, false);
    }
    const double angle = state.search->angle(), length = state.search->length();
    state.search->learn(sifs);
    if (state.search->is_settled() && state.search->length() > 0) {
      state.found = sifs;
      return;
    }
    if (state.search->angle() != angle || state.search->length() != length)
      place(i);
    else
      state.is_outdated = true;
  }

  void abandon(int i) {
    SPREKK_ASSERT(!paths_[i].added.empty(), i);
    paths_[i].added.pop_back();
    states_[i].search.reset();
    outdate_those_that_interact(i);
  }

  bool others_advance(int i) const {
    for (int j = 0; j < count(); ++j)
      if (j != i && states_[j].search && states_[j].search->length() > 0 && (!interacts_ || interacts_(i, j)))
        return true;
    return false;
  }

  void end_round() {
    for (int i = 0; i < count(); ++i) {
      State& state = states_[i];
      if (!state.search) continue;
      const IncrementSearch& search = *state.search;
      if (!search.note().empty())
        outcomes_[i].notes.push_back("increment " + std::to_string(outcomes_[i].increments + 1) + ": " + search.note());
      state.warm_start = search.warm_start();
      const Point ahead = turned(state.ahead, search.angle());
      if (search.length() > 0) {
        state.sifs = state.found;
        state.ahead = ahead;
        state.end = paths_[i].added.back();
        ++outcomes_[i].increments;
        outcomes_[i].length += search.length();
      } else {
        state.is_outdated = others_advance(i);
      }
      outcomes_[i].blocked = search.is_limited();
      outcomes_[i].ahead = ahead;
      if (search.is_limited())
        stop(i, "it has no free length ahead", false);
      else if (search.length() == 0)
        stop(i, "it would grow by less than the shortest increment", true);
    }
    for (State& state : states_) state.search.reset();
  }

  const std::vector<GrowingTip>& tips_;
  const GrowthOptions& options_;
  const EvaluateSifs& evaluate_;
  const FreeLength& free_length_;
  const InteractsWith& interacts_;
  std::vector<State> states_;
  std::vector<TipPath> paths_;
  std::vector<TipOutcome> outcomes_;
};

}  // namespace

std::vector<TipOutcome> grow_tips(const std::vector<GrowingTip>& tips, const GrowthOptions& options,
                                  const EvaluateSifs& evaluate, const FreeLength& free_length,
                                  const InteractsWith& interacts) {
  return Growth(tips, options, evaluate, free_length, interacts).run();
}

}  // namespace sprekk::fine_fracture
