// Friction that depends on slip rate and on a state of the walls.
#pragma once

namespace sprekk::contact {

/// The law at one place. At the slip rate V (m/s) and the state theta (s) walls under the pressure N (Pa) hold
///   tau = N a arcsinh( V/(2 V_0) exp((f_0 + b ln(V_0 theta/L))/a) ) + eta V ,
/// the law of Dieterich and Ruina, regularized at V = 0 (Rice and Ben-Zion, Proc. Natl. Acad. Sci. 93 (1996) 3811;
/// Lapusta, Rice, Ben-Zion and Zheng, J. Geophys. Res. 105 (2000) 23765), and radiation damping (Rice, J. Geophys.
/// Res. 98 (1993) 9885). The state ages: d theta/dt = 1 − V theta/L (Dieterich, J. Geophys. Res. 84 (1979) 2161).
struct RateAndStateLaw {
  double friction;     ///< f_0, of steady slip at V_0
  double a, b;         ///< parameters of the direct effect and of the evolution effect
  double distance;     ///< L, m
  double rate;         ///< V_0, m/s
  double damping = 0;  ///< eta, Pa s/m

  /// theta at the end of a step (s) that begins with theta = `state`, by backward Euler: a step without slip is exact,
  /// and so is steady slip.
  double state_after(double state, double dt, double slip_rate) const {
    return (state + dt) / (1 + slip_rate * dt / distance);
  }
  /// The coefficient of friction tau/N without damping.
  double friction_at(double slip_rate, double state) const;

  /// A step at one place on the walls: theta (s) at its start, its length (s), and N >= 0 (Pa).
  struct Step {
    double state, dt, pressure;
  };
  /// The traction of the walls at the end of a step, which fulfils tau + c V dt = trial, and its derivatives.
  struct Returned {
    double slip_rate;    ///< V, m/s
    double traction;     ///< tau, Pa
    double by_trial;     ///< d tau/d trial
    double by_pressure;  ///< d tau/d N
  };
  /// Solves tau(V, theta(V), N) + c V dt = trial for V, with `trial` >= 0 (Pa) and the stiffness c > 0 (Pa/m). If there
  /// are several solutions, the slowest one is returned; all others have V dt > L a/(b − a).
  Returned returned(double trial, double stiffness, const Step& step) const;
};

}  // namespace sprekk::contact
