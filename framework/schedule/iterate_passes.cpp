// The passes of one attempt of an iteration, one after the other, until they converge or cannot.
#include <fmt/format.h>

#include <cmath>
#include <set>
#include <utility>

#include "framework/assembly/assemble_all.hpp"
#include "framework/assembly/piecewise_smooth.hpp"
#include "framework/config/state.hpp"
#include "framework/schedule/iterate_step.hpp"
#include "framework/schedule/passes/ends_of_passes.hpp"
#include "framework/schedule/passes/pass_changes.hpp"
#include "framework/schedule/passes/stalled_acceleration.hpp"

namespace sprekk {

namespace {

constexpr std::size_t without_progress = 25;  // passes that change nothing and bring the residual no lower
constexpr std::size_t patience = 10, patience_accelerated = 20;  // passes whose changes stay large

/// "pore" of "pore.pressure".
std::string owner_of(const std::string& field) { return field.substr(0, field.find('.')); }

}  // namespace

/// What the passes of an attempt know of those before them.
class IterateStep::Passes {
 public:
  Passes(IterateStep& iteration, const StepTime& step) : own_(iteration), step_(step) {
    own_.scales_.assign(own_.fields_.size(), 1);
  }

  StepStatus run() {
    try {
      for (number_ = 1; number_ <= own_.options_.until.at_most; ++number_)
        if (const std::optional<StepStatus> end = pass()) return *end;
    } catch (const StateError& error) {  // passes that diverge lead to states for which formulas are not made
      return failed(fmt::format("pass {}: {}", number_, error.what()));
    }
    return without_convergence();
  }

 private:
  using End = std::optional<StepStatus>;
  bool has_substeps() const { return own_.options_.has_substeps; }
  StepStatus failed(const std::string& reason) const { return {false, reason, number_}; }
  StepStatus converged() { return own_.converged(step_, {true, "", number_, 0, of_newton_}); }

  /// One pass, and what follows from it.
  End pass() {
    *own_.pass_ = number_;
    before_ = number_ > 1 ? own_.scaled_values() : Vector();
    const Vector accelerated = own_.accelerator_ ? own_.accelerated_values() : Vector();
    values_before_.clear();
    if (own_.criteria_.need_changes() || has_substeps())
      for (const Field* field : own_.fields_) values_before_.push_back(field->now());
    if (const End end = solve()) return end;
    std::uint64_t state = 0;
    for (const auto* part : parts_with<PiecewiseSmooth>(own_.parts_)) state = state * 1000003 + part->discrete_state();
    if (const End end = look()) return end;
    if (number_ == 1) {
      own_.choose_scales();
      if (!own_.accelerator_) return std::nullopt;
      own_.begin_acceleration();
      last_state_ = state;
      own_.accelerate(accelerated);
      return std::nullopt;
    }
    if (const End end = judge_balances()) return end;
    if (const End end = judge_changes()) return end;
    go_on(state, accelerated);
    return std::nullopt;
  }

  End solve() {
    // If all rows hold but balances do not, each solve may disturb the balances of the others by round-off, which no
    // pass reduces. The pass then ends after the solve with which the balances hold.
    const bool misses_balances_alone = check_.rows_hold && !check_.balances_hold;
    const StepStatus inner =
        misses_balances_alone ? own_.inside_->run_until(step_, [&] { return own_.coupled_residual(step_).converged; })
                              : own_.inside_->run(step_);
    of_newton_ = std::max(of_newton_, inner.effort());
    if (inner.converged) return std::nullopt;
    StepStatus status = failed(fmt::format("pass {}: {}", number_, inner.reason));
    if (!inner.lost_at) return status;
    const std::optional<double> size = own_.losses_.size_to_repeat(step_, *inner.lost_at);
    status.is_hopeless = !size;
    status.retry_dt = size.value_or(0);
    return status;
  }

  /// Checks the equations, or where steps inside have substeps the changes of values.
  End look() {
    Assembly assembly(own_.inside_->unknowns(), Assembly::Request::residual);
    if (!has_substeps()) assemble_all(assembly, own_.parts_, step_);
    if (has_substeps() && number_ == 1) own_.find_round_off(step_);
    const double change_before = check_.largest, tightest = own_.options_.until.tightest();
    check_ = has_substeps() ? own_.check_changes(values_before_) : check_residual(assembly, own_.system_, tightest);
    change_ = number_ > 1 ? Vector(own_.scaled_values() - before_) : Vector();
    if (own_.log_)
      own_.log_({step_, "iterate", number_, check_.largest, check_.equation, change_.norm(), 1, check_.of_equations});
    if (!check_.finite) return failed(has_substeps() ? check_.equation + " is not finite" : check_.why_not_finite());
    const auto residual_holds = [&](double bound) {
      if (has_substeps()) return number_ > 2 && is_error_below(bound, check_.largest, change_before);
      return bound == tightest ? check_.converged : check_residual(assembly, own_.system_, bound).converged;
    };
    if (own_.criteria_.hold(number_, residual_holds, check_.of_equations, values_before_)) return converged();
    return std::nullopt;
  }

  End judge_balances() {
    changes_.add(change_.norm(), own_.relative_change(change_, before_));
    // If passes change no more than round-off, the imbalance that is left is round-off of the fields.
    if (check_.rows_hold && changes_.are_round_off()) return converged();
    if (!check_.rows_hold || check_.balances_hold) imbalances_.clear();
    if (check_.rows_hold && !check_.balances_hold) imbalances_.push_back(check_.imbalance);
    if (are_round_off_of_balances(imbalances_)) return converged();
    return std::nullopt;
  }

  /// Whether the changes of passes say that they do not converge.
  End judge_changes() {
    residuals_.push_back(check_.largest);
    if (changes_.are_round_off() && !has_substeps() && hardly_fall(residuals_, without_progress))
      return failed(
          fmt::format("the iteration stagnates after {} passes: the residual of {} stays at {:.2g} of its terms, and "
                      "passes change {} most, by round-off, {:.3g} times as much as the one before (the fields have "
                      "no more digits in this split) solve '{}' with what it is coupled to in one 'solve'{}",
                      number_, check_.equation, check_.largest, own_.most_changed(change_), changes_.factor(),
                      owner_of(check_.equation), looser_tolerance(check_.largest)));
    if (const bool explode = !own_.accelerator_ && changes_.explode(); explode || changes_.only_grow()) {
      const double factor = explode ? changes_.last_factor() : changes_.factor();
      return own_.without_end(step_,
                              fmt::format("the iteration diverges: each pass changes {} {:.3g} times as much as the "
                                          "one before",
                                          own_.most_changed(change_), factor),
                              factor, number_);
    }
    if (changes_.stay_large(own_.accelerator_ ? patience_accelerated : patience))
      return own_.without_end(
          step_,
          fmt::format("the iteration does not converge: after {} passes each one still changes {} "
                      "by {:.2g} of its largest value, {:.3g} times as much as the one before",
                      number_, own_.most_changed(change_), changes_.last_relative(), changes_.factor()),
          changes_.factor(), number_);
    return std::nullopt;
  }

  /// Sets the fields for the next pass. `accelerated`: values before this one.
  void go_on(std::uint64_t state, const Vector& accelerated) {
    // Passes may cycle between discrete states, like Newton's method. Then a pass that changes the state is halved, and
    // passes are not accelerated.
    const bool is_other_state = state != last_state_;
    last_state_ = state;
    if (is_other_state) {
      is_cycling_ = is_cycling_ || seen_states_.count(state) > 1;
      seen_states_.insert(state);
    }
    if (is_cycling_ && is_other_state) {
      own_.set_scaled_values(before_ + 0.5 * change_);
      return;
    }
    if (!own_.accelerator_ || is_cycling_) return;
    // The accelerator may use earlier passes only as long as all of them belong to one smooth map.
    if (is_other_state) {
      own_.accelerator_->forget();
      stalled_.forget();
      is_plain_ = false;
    }
    const StalledAcceleration::Next next = stalled_.after(change_.norm());
    const bool was_plain = std::exchange(is_plain_, next == StalledAcceleration::Next::plain);
    if (next == StalledAcceleration::Next::accelerated) {
      own_.accelerate(accelerated);
      return;
    }
    own_.accelerator_->forget();
    if (!was_plain || !is_plain_) changes_.begin_again();
    if (next == StalledAcceleration::Next::back)
      own_.set_scaled_values(unaccelerated_);
    else if (!was_plain)
      unaccelerated_ = own_.scaled_values();
  }

  StepStatus without_convergence() const {
    const int passes = own_.options_.until.at_most;
    std::string reason = fmt::format("no convergence in {} passes: {} of {} is {:.2g} of its {}", passes,
                                     has_substeps() ? "the last change" : "the residual", check_.equation,
                                     check_.largest, has_substeps() ? "largest value" : "terms");
    if (change_.size() > 0 && changes_.have_a_factor())
      reason += fmt::format(", and a pass changes {} most, {:.3g} times as much as the one before",
                            own_.most_changed(change_), changes_.factor());
    return {false, reason, passes};
  }

  IterateStep& own_;
  const StepTime& step_;
  int number_ = 0, of_newton_ = 0;
  Vector before_, change_;             ///< scaled values before the pass, and how it has changed them
  std::vector<Vector> values_before_;  ///< of each field, where they are looked at
  ResidualCheck check_;
  PassChanges changes_;
  StalledAcceleration stalled_;
  bool is_plain_ = false;
  Vector unaccelerated_;  ///< the values at the start of the plain passes
  std::uint64_t last_state_ = 0;
  std::multiset<std::uint64_t> seen_states_;
  bool is_cycling_ = false;
  std::vector<double> residuals_;   ///< after each pass but the first
  std::vector<double> imbalances_;  ///< after the last passes, while they leave balances alone
};

StepStatus IterateStep::make_passes(const StepTime& step) { return Passes(*this, step).run(); }

}  // namespace sprekk
