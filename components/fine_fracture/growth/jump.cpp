#include "components/fine_fracture/growth/jump.hpp"

#include <algorithm>
#include <cmath>

#include "components/fine_fracture/growth/turn_slope.hpp"
#include "framework/invariants.hpp"

namespace sprekk::fine_fracture {

namespace {

constexpr double part_of_increment = 0.25;  ///< that the leading tip advances from trial to trial
constexpr double length_power = 0.35;       ///< Eq. 13 of the paper
constexpr double largest_turn = 0.3;        ///< rad, between two trials
constexpr double close_enough = 1e-3;       ///< |ln(K_eq/K_IC)| of the leading tip where a jump ends
constexpr double least_part = 0.1;          ///< of the last part that regula falsi leaves
constexpr double shortest_part = 1e-2;  ///< of an increment: a trial that cannot be solved is shortened down to this
constexpr double least_drop = 0.02;     ///< ln(K_eq/K_IC) by which two trials this near to each other differ at a drop
constexpr double drop_part = 1e-4;      ///< of an increment: a drop is found to this
constexpr double at_limit = 1e-9;       ///< of a length that is at its limit, but for rounding
constexpr double least_load = 1e-3;     ///< for the logarithm

double log_load(double load) { return std::log(std::max(least_load, load)); }

/// The change of direction that makes K_II vanish at the end of a segment, by the expansion of a kink.
double turn_of(const Sifs& sifs, double length, bool is_bent) {
  if (!(sifs.k1 > 0)) return 0;
  const double slope = short_kink_turn_slope + std::max(0.0, -sifs.t_stress) * std::sqrt(length) / sifs.k1;
  return std::clamp(-std::atan2(sifs.k2, sifs.k1) / (is_bent ? 2 * slope : slope), -largest_turn, largest_turn);
}

}  // namespace

FrontJump::FrontJump(std::vector<FrontTip> tips, const std::vector<FrontState>& without_growth,
                     const FrontOptions& options)
    : tips_(std::move(tips)),
      options_(options),
      is_laid_(tips_.size(), 0),
      is_stopped_(tips_.size(), 0),
      records_(tips_.size()) {
  SPREKK_EXPECT(without_growth.size() == tips_.size(), without_growth.size(), tips_.size());
  SPREKK_EXPECT(options_.increment > 0 && options_.shortest > 0, options_.increment, options_.shortest);
  for (int i = 0; i < count(); ++i) {
    const FrontTip& tip = tips_[i];
    now_.length.push_back(tip.covered);
    now_.angle.push_back(tip.angle);
    now_.load.push_back(counts(i, without_growth) ? without_growth[i].load : 0);
    records_[i].largest_load = now_.load.back();
    if (!(tip.first_length > 0)) continue;
    is_laid_[i] = 1;
    now_.length[i] = tip.first_length;
    now_.angle[i] = tip.first_angle;
  }
  from_ = now_;
  from_.excess = log_load(largest_load(without_growth));
  advance(without_growth);
}

void FrontJump::stop(int tip) {
  SPREKK_EXPECT(is_index(tip, count()), tip);
  is_stopped_[tip] = 1;
  const bool has_advanced = records_[tip].advance > 0;
  const double length = has_advanced ? from_.length[tip] : tips_[tip].covered,
               angle = has_advanced ? from_.angle[tip] : tips_[tip].angle;
  is_laid_[tip] = has_advanced;
  for (Place* place : {&from_, &to_, &now_}) {
    if (place->length.empty()) continue;
    place->length[tip] = length;
    place->angle[tip] = angle;
  }
  from_.load[tip] = 0;
  from_.excess = log_load(*std::ranges::max_element(from_.load));
}

double FrontJump::largest_load(const std::vector<FrontState>& states) const {
  double largest = 0;
  for (int i = 0; i < count(); ++i)
    if (counts(i, states)) largest = std::max(largest, states[i].load);
  return largest;
}

/// From the last trial, `from_`, to the next one.
void FrontJump::advance(const std::vector<FrontState>& states) {
  now_ = from_;
  const double largest = largest_load(states);
  bool has_advanced = false;
  for (int i = 0; i < count(); ++i) {
    if (!counts(i, states)) continue;
    const FrontTip& tip = tips_[i];
    const bool grows = states[i].load > 1 && from_.length[i] < tip.longest * (1 - at_limit);
    if (grows) {
      const double part = part_of_increment * std::pow(states[i].load / largest, 2 * length_power);
      now_.length[i] = std::min(tip.longest, from_.length[i] + part * options_.increment);
      has_advanced = true;
    }
    if (!grows && !is_laid_[i]) continue;
    now_.angle[i] += turn_of(states[i].sifs, now_.length[i], tips_[i].is_bent);
    is_laid_[i] = 1;
  }
  if (!has_advanced) verdict_ = Front::Verdict::too_far;
}

/// The next trial between one above the toughness and one below it, by regula falsi. From two trials on one side in
/// turn on the interval is halved, since the load may drop within it.
void FrontJump::interpolate() {
  const double zero = from_.excess / (from_.excess - to_.excess);
  const double part = halves_ ? 0.5 : std::clamp(zero, least_part, 1 - least_part);
  for (int i = 0; i < count(); ++i) {
    now_.length[i] = from_.length[i] + part * (to_.length[i] - from_.length[i]);
    now_.angle[i] = from_.angle[i] + part * (to_.angle[i] - from_.angle[i]);
  }
}

/// Whether no tip advances by more than this part of an increment between `from_` and the place.
bool FrontJump::is_near(const Place& place, double part) const {
  for (int i = 0; i < count(); ++i)
    if (place.length[i] - from_.length[i] > part * options_.increment) return false;
  return true;
}

bool FrontJump::retreat() {
  for (int i = 0; i < count(); ++i) {
    now_.length[i] = 0.5 * (from_.length[i] + now_.length[i]);
    now_.angle[i] = 0.5 * (from_.angle[i] + now_.angle[i]);
  }
  return !is_near(now_, shortest_part);
}

void FrontJump::learn(const std::vector<FrontState>& states) {
  SPREKK_EXPECT(verdict_ == Front::Verdict::again);
  SPREKK_EXPECT(static_cast<int>(states.size()) == count(), states.size(), count());
  for (int i = 0; i < count(); ++i) now_.load[i] = counts(i, states) ? states[i].load : 0;
  worst_ = now_.excess = log_load(largest_load(states));
  if (std::abs(now_.excess) <= close_enough || is_last_) {
    conclude();
    verdict_ = Front::Verdict::found;
  } else if (now_.excess > 0) {
    conclude();
    from_ = now_;
    if (is_closing_)
      close_in();
    else
      advance(states);
  } else {
    to_ = now_;
    is_closing_ = true;
    close_in();
  }
}

/// After a trial that is an end of the interval between `from_` and `to_`.
void FrontJump::close_in() {
  const bool is_below = now_.excess < 0;
  halves_ = halves_ || is_below == was_below_;
  was_below_ = is_below;
  const bool drops = from_.excess - to_.excess > least_drop;
  if (!is_near(to_, drops ? drop_part : shortest_part)) return interpolate();
  if (drops) drop_ = Drop{std::exp(from_.excess), std::exp(to_.excess)};
  is_last_ = true;
  now_ = to_;
  if (!is_below) return;  // one more trial, for the state there
  conclude();
  verdict_ = Front::Verdict::found;
}

/// Adds the part from `from_` to the trial to what is known of the jump.
void FrontJump::conclude() {
  for (int i = 0; i < count(); ++i) {
    Record& record = records_[i];
    const double advance = now_.length[i] - from_.length[i];
    if (!(advance > 0)) continue;
    const auto excess = [](double load) { return load * load - 1; };
    record.surplus += 0.5 * (excess(from_.load[i]) + excess(now_.load[i])) * advance;
    record.largest_load = std::max(record.largest_load, now_.load[i]);
    // The first part begins on another mesh.
    if (record.advance > 0 && now_.load[i] > from_.load[i]) record.is_unstable = true;
    record.advance += advance;
  }
}

}  // namespace sprekk::fine_fracture
