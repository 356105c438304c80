// Friction of rate and state: its own equations, and the whole Jacobian against differences.
#include "components/contact/laws/rate_and_state.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/components/contact/contact_alone.hpp"

namespace sprekk::contact {
namespace {

constexpr RateAndStateLaw rock{0.6, 0.01, 0.015, 1e-4, 1e-6, 5e6};

TEST(RateAndState, HasTheDirectEffectAndTheSteadyStateOfTheLogarithms) {
  // mu = f_0 + a ln(V/V_0) + b ln(V_0 theta/L), whose regularization is felt below 1e-20 m/s here.
  for (const double rate : {1e-12, 1e-9, 1e-6, 1.0})
    for (const double state : {1e-3, 1e2, 1e9})
      EXPECT_NEAR(rock.friction_at(rate, state),
                  0.6 + 0.01 * std::log(rate / 1e-6) + 0.015 * std::log(1e-6 * state / 1e-4), 1e-12);
  EXPECT_EQ(rock.friction_at(0, 1e9), 0);
  EXPECT_NEAR(rock.friction_at(1e-5, 10) - rock.friction_at(1e-6, 100), (0.010 - 0.015) * std::log(10), 1e-12);
}

TEST(RateAndState, AgesByTheExactSumAtRestAndStaysInSteadySlip) {
  EXPECT_EQ(rock.state_after(3, 7, 0), 10);
  EXPECT_NEAR(rock.state_after(1e-4 / 1e-7, 1e5, 1e-7), 1e-4 / 1e-7, 1e-9);
  EXPECT_GT(rock.state_after(1e9, 1e12, 10), 0);
}

/// The slip over which friction has evolved by all but 1/e to a new rate is L, and the error of steps is of first
/// order.
TEST(RateAndState, EvolvesOverTheDistanceAfterAVelocityStep) {
  const double before = 1e-6, after = 1e-5;
  const auto error = [&](int steps) {
    double state = 1e-4 / before, largest = 0;
    const double dt = 3e-4 / after / steps;
    for (int i = 1; i <= steps; ++i) {
      state = rock.state_after(state, dt, after);
      const double steady = 1e-4 / after, exact = steady + (1e-4 / before - steady) * std::exp(-after * dt * i / 1e-4);
      largest = std::max(largest, std::abs(rock.friction_at(after, state) - rock.friction_at(after, exact)));
    }
    return largest;
  };
  EXPECT_LT(error(3000), 1e-5);
  EXPECT_NEAR(std::log2(error(1000) / error(2000)), 1, 0.01);
}

TEST(RateAndState, ReturnsATrialToTheLawWithItsDerivatives) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(0, 1);
  const auto decades = [&](double low, double high) { return std::pow(10.0, low + (high - low) * any(random)); };
  int compared = 0;
  for (int sample = 0; sample < 2000; ++sample) {
    RateAndStateLaw law{0.2 + any(random), decades(-4, -1), 0,
                        decades(-6, -1),   decades(-9, -3), any(random) < 0.3 ? 0.0 : decades(5, 8)};
    law.b = law.a * 2 * any(random);
    const double stiffness = decades(6, 11), pressure = any(random) < 0.1 ? 0.0 : decades(3, 9);
    const RateAndStateLaw::Step step{decades(-6, 12), decades(-6, 8), pressure};
    const double trial =
        std::min((pressure + 1) * decades(-6, 0.5), pressure * law.friction + 0.3 * stiffness * law.distance);
    const RateAndStateLaw::Returned held = law.returned(trial, stiffness, step);
    ASSERT_TRUE(std::isfinite(held.slip_rate) && held.slip_rate >= 0) << sample;
    const double round_off = 1e-11 * (trial + pressure * law.a * 700);
    EXPECT_NEAR(held.traction + stiffness * held.slip_rate * step.dt, trial, round_off) << sample;
    if (held.slip_rate > 1e-290) {
      EXPECT_NEAR(held.traction,
                  pressure * law.friction_at(held.slip_rate, law.state_after(step.state, step.dt, held.slip_rate)) +
                      law.damping * held.slip_rate,
                  round_off)
          << sample;
    }
    // A little further the slow solution may have ended.
    if (held.slip_rate * step.dt > 0.5 * law.distance) continue;
    ++compared;
    // Differences over a part of the range of traction in which the exponential bends.
    const double bend = std::max(pressure * law.a, trial), change = 1e-6 * std::min(trial, bend * 0.1);
    const auto by_trial = [&](double sign) { return law.returned(trial + sign * change, stiffness, step).traction; };
    EXPECT_NEAR(held.by_trial, (by_trial(1) - by_trial(-1)) / (2 * change), 1e-4) << sample;
    if (pressure == 0) continue;
    const double more = 1e-6 * pressure;
    const auto by_pressure = [&](double sign) {
      return law.returned(trial, stiffness, {step.state, step.dt, pressure + sign * more}).traction;
    };
    EXPECT_NEAR(held.by_pressure, (by_pressure(1) - by_pressure(-1)) / (2 * more), 1e-3) << sample;
  }
  EXPECT_GT(compared, 1000);
}

/// In units of the stiffness of the walls.
Options at_rate() {
  Options options;
  options.depends_on_rate = true;
  options.rate_and_state.a = 0.1;
  options.rate_and_state.b = 0.15;
  options.rate_and_state.distance = 2;
  options.rate_and_state.reference_rate = 0.3;
  options.rate_and_state.initial_state = Data(4);
  options.rate_and_state.is_damped = true;
  options.rate_and_state.wave_speed = 1;
  options.closure.law = "linear";
  options.closure.stiffness = 20;
  return options;
}

TEST(RateAndState, HasTheDerivativesOfItsConditions) {
  const Mesh mesh = crossing();
  Contact contact(mesh, {}, at_rate());
  const int cells = mesh.fracture_cell_count();
  contact.law().set_wall_stiffness(Vector::LinSpaced(2 * cells, 1, 2));
  contact.law().set_shear_modulus(Vector::Constant(cells, 0.5));
  std::mt19937 random(5);
  int open = 0;
  for (int number = 0; number < 20; ++number) {
    SCOPED_TRACE(number);
    const Sample sample(contact, cells, random);
    for (int i = 0; i < cells; ++i) open += contact.law().state(i) == State::open;
    expect_differences(contact, sample, 1e-5, 1e-6);
  }
  EXPECT_GT(open, 10);
}

}  // namespace
}  // namespace sprekk::contact
