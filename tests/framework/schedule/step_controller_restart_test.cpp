// A controller that is saved and restored at any moment goes on to the bit as if nothing had been.
#include <gmock/gmock.h>

#include <functional>
#include <set>

#include "framework/config/input_error.hpp"
#include "framework/schedule/step_controller.hpp"

namespace sprekk {
namespace {

using State = std::map<std::string, Vector>;
using Event = std::function<void(StepController&)>;

Event accepted(int iterations) {
  return [=](StepController& c) { c.accepted(c.next(), iterations); };
}
Event rejected(double retry = 0) {
  return [=](StepController& c) { c.rejected(c.next(), retry); };
}
/// A size that fails whenever it is tried.
Event tried_up_to(double size) {
  return [=](StepController& c) { c.next().dt > size ? void(c.rejected(c.next())) : c.accepted(c.next(), 1); };
}
Event held(double step, double level) {
  return [=](StepController& c) { c.hold(step, level); };
}
Event released(double level) {
  return [=](StepController& c) { c.release(level); };
}
Event observed(double level) {
  return [=](StepController& c) { c.observe(level); };
}

/// Steps that grow, fail once and again, are held and released, and holds that are expected, come and are overdue. No
/// size or level is a sum of powers of two, so that a value that is lost shows in the bits.
std::vector<Event> course() {
  std::vector<Event> events(20, tried_up_to(1.03));
  events.push_back(accepted(5));
  const std::vector<Event> holds = {held(0.013, 0.97), accepted(1),   released(0.31), rejected(0.37), accepted(1),
                                    held(0.013, 0.83), accepted(1),   released(0.43), accepted(1),    observed(0.61),
                                    accepted(1),       observed(0.7), accepted(1),    observed(0.71), accepted(20),
                                    held(0.013, 0.9),  rejected(),    accepted(1),    released(0.53), accepted(1)};
  events.insert(events.end(), holds.begin(), holds.end());
  events.insert(events.end(), 6, accepted(5));
  return events;
}

StepController fresh(bool adaptive) {
  TimeOptions options;
  options.start = 0.1;
  options.end = 300.7;
  options.step = 1.1;
  options.adaptive = adaptive;
  options.largest = 7.3;
  return {options, {2.9, 4.7}};
}

State state_of(const StepController& controller) {
  State state;
  controller.save(state);
  return state;
}

/// What the rest of the course shows of a controller that goes on at event `begin`.
std::vector<double> rest_of_course(StepController controller, std::size_t begin) {
  const std::vector<Event> events = course();
  std::vector<double> seen;
  for (std::size_t i = begin;; ++i) {
    const StepTime step = controller.next();
    seen.insert(seen.end(), {step.start, step.dt, step.end, controller.held(), double(controller.steps())});
    if (i == events.size()) return seen;
    events[i](controller);
  }
}

StepController at_event(std::size_t event, bool adaptive) {
  StepController controller = fresh(adaptive);
  for (std::size_t i = 0; i < event; ++i) course()[i](controller);
  return controller;
}

TEST(RestartedStepController, GoesOnToTheBitFromEveryMoment) {
  for (const bool adaptive : {false, true})
    for (std::size_t i = 0; i <= course().size(); ++i) {
      const StepController whole = at_event(i, adaptive);
      StepController part = fresh(adaptive);
      part.restore(state_of(whole));
      EXPECT_EQ(rest_of_course(part, i), rest_of_course(whole, i)) << "event " << i << ", adaptive " << adaptive;
      EXPECT_EQ(state_of(part), state_of(whole));
    }
}

/// The test above would not notice a value that no moment of its course depends on.
TEST(RestartedStepController, NeedsEachValueThatItSaves) {
  std::set<std::string> unneeded;
  for (const auto& [name, value] : state_of(fresh(false))) unneeded.insert(name);
  ASSERT_GE(unneeded.size(), 13u);
  for (const bool adaptive : {false, true})
    for (std::size_t i = 0; i <= course().size(); ++i) {
      const StepController whole = at_event(i, adaptive);
      const std::vector<double> expected = rest_of_course(whole, i);
      for (const auto& [name, initial] : state_of(fresh(adaptive))) {
        State lost = state_of(whole);
        if (lost.at(name).size() == initial.size() && lost.at(name) == initial) continue;
        lost.at(name) = initial;
        StepController part = fresh(adaptive);
        part.restore(lost);
        if (rest_of_course(part, i) != expected) unneeded.erase(name);
      }
    }
  EXPECT_THAT(unneeded, testing::IsEmpty());
}

TEST(RestartedStepController, RefusesAStateThatLacksAValueOrHasTwo) {
  const State whole = state_of(at_event(12, false));
  for (const auto& [name, value] : whole) {
    State missing = whole, twice = whole;
    missing.erase(name);
    twice.at(name) = Vector::Ones(2);
    for (const State& damaged : {missing, twice}) {
      StepController controller = fresh(false);
      EXPECT_THROW(controller.restore(damaged), InputError) << name;
    }
  }
}

}  // namespace
}  // namespace sprekk
