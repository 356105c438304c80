#include "components/contact/laws/rate_and_state.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "framework/invariants.hpp"

namespace sprekk::contact {

namespace {

/// arcsinh(w) as a function of ln w, for which w may be too large for a floating-point number, and its derivative by ln
/// w.
struct ArcSinh {
  double value, slope;
};

ArcSinh arcsinh_of_log(double log_w) {
  constexpr double large = 20;  // ln w from where arcsinh w = ln 2w to all digits
  if (log_w > large) return {log_w + std::numbers::ln2, 1};
  const double w = std::exp(log_w);
  return {std::asinh(w), w / std::sqrt(1 + w * w)};
}

/// ln sinh(y), y > 0.
double log_sinh(double y) { return y + std::log(-std::expm1(-2 * y)) - std::numbers::ln2; }

}  // namespace

double RateAndStateLaw::friction_at(double slip_rate, double state) const {
  if (slip_rate == 0) return 0;
  return a * arcsinh_of_log(std::log(slip_rate / (2 * rate)) + (friction + b * std::log(rate * state / distance)) / a)
                 .value;
}

RateAndStateLaw::Returned RateAndStateLaw::returned(double trial, double stiffness, const Step& step) const {
  SPREKK_EXPECT(trial >= 0 && stiffness > 0, trial, stiffness);
  SPREKK_EXPECT(step.dt > 0 && step.pressure >= 0, step.dt, step.pressure);
  // In a step that is far too long the extrapolated state may be negative. Such a step is refused later.
  const double before = std::max(step.state, std::numeric_limits<double>::min());
  const double resistance = damping + stiffness * step.dt;  // Pa s/m, of what is linear in V
  const double strength = step.pressure * a;                // Pa
  if (!(strength > 0) || trial == 0) {
    const double slip_rate = trial / resistance;
    return {slip_rate, damping * slip_rate, strength > 0 ? 1 : damping / resistance, 0};
  }
  // Unknown: x = ln V. The exponent of the law at x is x + shift − (b/a) ln(1 + V dt/L).
  const double shift = (friction + b * std::log(rate * (before + step.dt) / distance)) / a - std::log(2 * rate);
  struct Value {
    double excess, slope;  ///< of the left side over the trial, and its derivative by x, Pa
    ArcSinh arc;
    double factor;  ///< of the derivative of the exponent by x
  };
  const auto at = [&](double x) {
    const double slip_rate = std::exp(x), slips = slip_rate * step.dt / distance;
    const ArcSinh arc = arcsinh_of_log(x + shift - b / a * std::log1p(slips));
    const double factor = 1 - b / a * slips / (1 + slips);
    return Value{strength * arc.value + resistance * slip_rate - trial,
                 strength * arc.slope * factor + resistance * slip_rate, arc, factor};
  };
  // The lower bound: both terms are below half of the trial, with the largest state. The upper bound: one term alone is
  // the whole trial.
  const double of_resistance = std::log(trial / resistance);
  double low = std::min(of_resistance - std::numbers::ln2, log_sinh(trial / strength / 2) - shift);
  double high = of_resistance;
  if (b > a) {
    // The left side rises up to the slip at which friction begins to fall. It meets the trial once before that slip, or
    // once after it.
    const double turn = std::log(a / (b - a) * distance / step.dt);
    if (turn > low && turn < high) (at(turn).excess > 0 ? high : low) = turn;
  }
  double x = std::clamp(log_sinh(trial / strength) - shift, low, high);
  constexpr int most = 200;                                                 // bisection alone needs 60
  constexpr double round_off = 4 * std::numeric_limits<double>::epsilon();  // some roundings of the unknown
  Value value = at(x);
  for (int i = 0; i < most; ++i) {
    (value.excess > 0 ? high : low) = x;
    double next = x - value.excess / value.slope;
    if (!(next > low && next < high)) next = (low + high) / 2;
    const double change = std::abs(next - x);
    x = next;
    value = at(x);
    if (change <= round_off * std::max(1.0, std::abs(x))) break;
  }
  const double slip_rate = std::exp(x), friction_now = a * value.arc.value;
  // Derivatives by x = ln V: d trial = (slope of tau + c dt V) dx.
  const double of_rock = stiffness * step.dt * slip_rate;
  const double share = of_rock / value.slope;
  return {slip_rate, step.pressure * friction_now + damping * slip_rate, 1 - share, friction_now * share};
}

}  // namespace sprekk::contact
