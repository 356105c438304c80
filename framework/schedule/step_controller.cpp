#include "framework/schedule/step_controller.hpp"

#include <algorithm>
#include <cmath>

#include "framework/config/units.hpp"
#include "framework/invariants.hpp"
#include "framework/round_off.hpp"

namespace sprekk {
namespace {

/// Of a level: from a smaller rise no rate follows; levels are known to `arrest_tolerance`, 1 %.
constexpr double least_rise = 1e-2;
constexpr double of_failed_size = 0.999;  ///< a step that is shorter by rounding only is as long as the failed one
constexpr double smallest_part = 1e-6;    ///< of the standard step: the smallest, where the scene does not give it
constexpr double shortest_part = 0.1;     ///< of the standard step: the shortest wait for a hold that is expected

std::string key_of(const char* name) { return std::string("time_steps.") + name; }

/// A value becomes a vector of length 1, no value an empty one.
struct Saving {
  std::map<std::string, Vector>& state;
  void operator()(const char* name, double value) const { state[key_of(name)] = Vector::Constant(1, value); }
  void operator()(const char* name, const std::optional<double>& value) const {
    state[key_of(name)] = value ? Vector::Constant(1, *value) : Vector();
  }
};

struct Restoring {
  const std::map<std::string, Vector>& state;
  void operator()(const char* name, double& value) const { value = number(name); }
  void operator()(const char* name, int& value) const { value = static_cast<int>(number(name)); }
  void operator()(const char* name, std::optional<double>& value) const {
    value = values(name).size() == 0 ? std::nullopt : std::optional(number(name));
  }

 private:
  const Vector& values(const char* name) const {
    const auto found = state.find(key_of(name));
    if (found == state.end()) throw unusable("has no " + key_of(name));
    return found->second;
  }
  double number(const char* name) const {
    const Vector& found = values(name);
    if (found.size() != 1) throw unusable(key_of(name) + " is not one number");
    return found[0];
  }
  static InputError unusable(const std::string& why) {
    return InputError("cannot restart: the state of the time steps is damaged (" + why +
                      ") start the run from its beginning, without --restart");
  }
};

}  // namespace

void TimeOptions::StopTerm::declare(Spec& spec) {
  spec.text("of", of, {.doc = "A column of history.csv without its unit."});
  spec.text("reaches", reaches,
            {.doc = "The value, with its unit, that ends the run: the quantity has it or a larger one."});
  spec.text("falls_to", falls_to,
            {.doc = "The value, with its unit, that ends the run: the quantity has it or a smaller one."});
}

void TimeOptions::StopTerm::check(const Node& node) {
  origin = node.origin;
  if (of && reaches.has_value() != falls_to.has_value()) return;
  throw InputError(node.origin, "'stop' is not complete",
                   "a run ends where a quantity 'of' history.csv 'reaches' or 'falls_to' a value",
                   of ? "give one of the two" : "add 'of:', or lists of such terms, 'any' or 'all'");
}

Spec TimeOptions::Stop::spec() {
  Spec spec("stop", "Ends the run early.");
  only.declare(spec);
  static StopTerm example;
  const auto term = [](StopTerm& of_run) {
    Spec inner("term", "A quantity that has reached a value.");
    of_run.declare(inner);
    inner.check([&of_run](const Node& node) { of_run.check(node); });
    return inner;
  };
  const auto list = [&](const char* name, std::list<StopTerm>& terms, const char* doc) {
    spec.list_of_sections(name, term(example),
                          [&terms, term](int, const Origin&) {
                            terms.emplace_back();
                            return term(terms.back());
                          },
                          {.doc = doc});
  };
  list("any", any, "Terms as above, of which one has to hold.");
  list("all", all, "Terms as above, which all have to hold at the end of one step.");
  spec.check([this](const Node& node) {
    const bool has_only = only.of || only.reaches || only.falls_to;
    if (has_only + !any.empty() + !all.empty() > 1)
      throw InputError(node.origin, "'stop' says twice when the run ends", "it is one term, 'any' of several or 'all'",
                       "write all terms into one list");
    if (any.empty() && all.empty()) only.check(node);
  });
  return spec;
}

Spec TimeOptions::spec() {
  Spec spec("time", "From when to when, and in which steps.");
  spec.quantity("start", start, {.unit = "s", .doc = "Start of the run."});
  spec.quantity("end", end, {.unit = "s", .doc = "End of the run.", .required = true});
  spec.quantity("step", step,
                {.unit = "s", .range = positive(), .doc = "Time step; the first one when adaptive.", .required = true});
  spec.choice("scheme", scheme_name,
              {{"backward_euler", "first order: one stage"},
               {"sdirk2", "second order: two stages, each at the cost of a step of backward Euler"}},
              {.doc = "The scheme in time.", .source = "Alexander 1977"});
  spec.quantity(
      "smallest", smallest,
      {.unit = "s", .range = positive(), .doc = "A rejected step is not cut below this; by default step/1e6."});
  Spec changing("adaptive", "Steps that follow the effort of the solver.");
  changing.quantity("largest", largest, {.unit = "s", .range = positive(), .doc = "Largest step.", .required = true});
  changing.quantity("grow", grow, {.range = {.low = 1, .low_allowed = false}, .doc = "Factor of growing steps."});
  changing.quantity("shrink", shrink, {.range = strictly_between(0, 1), .doc = "Factor of shrinking steps."});
  changing.integer(
      "iterations", iterations,
      {.range = between(1, 1000),
       .doc = "Steps grow while no solve needs more than half of these iterations of Newton's method, and shrink "
              "beyond them. Passes of an 'iterate' do not count: shorter steps need as many."});
  spec.section("adaptive", changing, {.doc = "Steps that follow the effort of the solver; else they are constant."},
               &adaptive);
  spec.section("stop", stop.spec(), {.doc = "Ends the run after the step in which a quantity reaches a value."},
               &has_stop);
  spec.quantity("stop_when_steady", stop_when_steady,
                {.range = strictly_between(0, 1),
                 .doc = "Ends the run after the last jump of the data, once changes like those of the last step, up to "
                        "the end, would add up to less than this share of the largest value of every unknown."});
  spec.check([this](const Node& node) {
    if (const Node* given = node.find("scheme")) scheme_origin = given->origin;
    scheme = scheme_name == "sdirk2" ? TimeScheme::sdirk2 : TimeScheme::backward_euler;
    if (end <= start)
      throw InputError(node.origin, "the run has no duration", "its end is not after its start", "raise 'end'");
    constexpr double most_steps = 1e9;  // more than any run can take
    if ((!adaptive && (end - start) / step > most_steps) || start + step == start)
      throw InputError(node.origin, "the step of " + quantity_text(step, "s") + " is too small",
                       "the run is " + quantity_text(end - start, "s") + " long", "raise 'step'");
    if (smallest && *smallest > step)
      throw InputError(node.origin, "'smallest' is larger than 'step'",
                       "a rejected step is cut from 'step' down to 'smallest'", "lower 'smallest'");
    if (adaptive && largest < step)
      throw InputError(node.origin, "'largest' is smaller than 'step'", "the first step is 'step'", "raise 'largest'");
  });
  return spec;
}

StepController::StepController(const TimeOptions& options, std::vector<double> targets)
    : options_(options), time_(options.start), wanted_(options.step) {
  SPREKK_EXPECT(options_.step > 0, options_.step);
  SPREKK_EXPECT(options_.end > options_.start, options_.start, options_.end);
  targets.push_back(options_.end);
  std::sort(targets.begin(), targets.end());
  // Targets that differ by round-off (an output time at a switch) count as one. The end keeps its exact value.
  for (const double target : targets) {
    if (targets_.empty() || target - targets_.back() > rounding::same * options_.step)
      targets_.push_back(target);
    else if (target == options_.end)
      targets_.back() = target;
  }
}

StepTime StepController::next() const {
  SPREKK_ASSERT(wanted_ > 0, wanted_);
  SPREKK_ASSERT(is_ascending(targets_), targets_.size());
  const bool is_due = recurrence_.expected && *recurrence_.expected > time_ + rounding::same * options_.step;
  const double size = is_due ? std::min(wanted_, std::max(*recurrence_.expected - time_, shortest_wait())) : wanted_;
  const auto target = std::upper_bound(targets_.begin(), targets_.end(), time_);
  StepTime step{time_, size, time_ + size};
  if (target == targets_.end()) return step;
  // A rest that is longer than the step by rounding is taken in one step, so that no tiny step is left. In an adaptive
  // run a rest of less than two steps is taken in two equal ones.
  const double rest = *target - time_;
  if (rest <= size * (1 + rounding::same)) {
    step.dt = rest;
    step.end = *target;
  } else if (options_.adaptive && size == wanted_ && rest < 2 * size) {
    step.dt = rest / 2;
    step.end = time_ + step.dt;
  }
  return step;
}

StepTime StepController::next(double longest) const {
  SPREKK_EXPECT(longest > 0, longest);
  StepTime step = next();
  if (step.dt <= longest * (1 + rounding::same)) return step;
  const auto target = std::upper_bound(targets_.begin(), targets_.end(), time_);
  const double rest = target == targets_.end() ? step.dt : *target - time_;
  const double part = rest / std::ceil(rest / longest - rounding::same);
  step.dt = part > smallest() ? part : longest;
  step.end = step.start + step.dt;
  return step;
}

double StepController::smallest() const { return options_.smallest.value_or(options_.step * smallest_part); }

double StepController::grown() const {
  const double size = wanted_ * options_.grow;
  return failed_.wait > 0 && size >= failed_.size ? wanted_ : size;
}

void StepController::remember_success(const StepTime& step) {
  if (failed_.size == 0) return;
  if (step.dt >= of_failed_size * failed_.size)
    failed_ = {};
  else
    failed_.wait = std::max(0, failed_.wait - 1);
}

void StepController::accepted(const StepTime& step, int iterations) {
  SPREKK_EXPECT(step.start == time_, step.start, time_);
  SPREKK_EXPECT(step.end > time_, step.end, time_);
  SPREKK_EXPECT(step.end <= options_.end, step.end, options_.end);
  SPREKK_EXPECT(iterations >= 0, iterations);
  time_ = step.end;
  ++steps_;
  remember_success(step);
  if (held_ > 0) {
    wanted_ = std::min(held_, grown());
    return;
  }
  if (!options_.adaptive) {
    wanted_ = std::min(options_.step, grown());
    return;
  }
  if (iterations > options_.iterations)
    wanted_ = std::max(smallest(), wanted_ * options_.shrink);
  else if (2 * iterations <= options_.iterations)
    wanted_ = std::min(options_.largest, grown());
}

bool StepController::rejected(const StepTime& step, double retry) {
  SPREKK_EXPECT(step.start == time_, step.start, time_);
  const double shortest = smallest();
  if (step.dt <= shortest) return false;
  if (retry <= 0) {                       // a step that asks for another size has not failed
    constexpr int longest_patience = 48;  // steps; half as many were tried, too
    if (failed_.size > 0 && step.dt >= of_failed_size * failed_.size)
      failed_.patience = std::min(longest_patience, 2 * failed_.patience);
    failed_.size = step.dt;
    failed_.wait = failed_.patience;
  }
  wanted_ = std::max(shortest, retry > 0 ? std::min(retry, step.dt) : step.dt * options_.shrink);
  return true;
}

void StepController::hold(double step, double level) {
  SPREKK_EXPECT(step > 0, step);
  SPREKK_EXPECT(std::isfinite(level), level);
  Recurrence& last = recurrence_;
  if (held_ == 0 && last.released) {
    last.pause = time_ - *last.released;
    last.rise = std::min(level, 1.0) - last.level;
  }
  last.expected = std::nullopt;
  held_ = wanted_ = step;
}

void StepController::hold(double step) {
  SPREKK_EXPECT(step > 0, step);
  held_ = wanted_ = step;
}

void StepController::release() {
  if (held_ == 0) return;
  held_ = 0;
  wanted_ = options_.step;
}

void StepController::release(double level) {
  if (held_ == 0) return;
  release();
  Recurrence& last = recurrence_;
  last.released = time_;
  last.level = level;
  last.patience = 0;
  if (last.pause == 0) return;
  constexpr double sooner = 0.5, later = 2;  // bounds of the next pause over the last one
  const double share = last.rise > least_rise ? std::clamp((1 - level) / last.rise, sooner, later) : 1;
  last.expected = time_ + last.pause * share;
}

void StepController::observe(double level) {
  Recurrence& last = recurrence_;
  if (!last.released || !last.expected || *last.expected > time_ + rounding::same * options_.step || level >= 1) return;
  const double rest = (time_ - *last.released) * (1 - level) / std::max(level - last.level, least_rise);
  last.patience = std::max({rest, 2 * last.patience, shortest_wait()});
  last.expected = time_ + last.patience;
}

double StepController::shortest_wait() const {
  return std::max(shortest_part * options_.step, options_.smallest.value_or(0));
}

/// The list of the values that a controller keeps, each with its name in checkpoints.
template <class Controller, class Visit>
void StepController::visit_values(Controller& controller, const Visit& visit) {
  visit("time", controller.time_);
  visit("steps", controller.steps_);
  visit("wanted", controller.wanted_);
  visit("held", controller.held_);
  visit("failed.size", controller.failed_.size);
  visit("failed.wait", controller.failed_.wait);
  visit("failed.patience", controller.failed_.patience);
  visit("recurrence.released", controller.recurrence_.released);
  visit("recurrence.level", controller.recurrence_.level);
  visit("recurrence.pause", controller.recurrence_.pause);
  visit("recurrence.rise", controller.recurrence_.rise);
  visit("recurrence.expected", controller.recurrence_.expected);
  visit("recurrence.patience", controller.recurrence_.patience);
}

void StepController::save(std::map<std::string, Vector>& state) const { visit_values(*this, Saving{state}); }

void StepController::restore(const std::map<std::string, Vector>& state) {
  visit_values(*this, Restoring{state});
  SPREKK_ASSERT(wanted_ > 0 && steps_ >= 0 && held_ >= 0, wanted_, steps_, held_);
}

}  // namespace sprekk
