// Wells that do what binds first: their rate or a limit of their pressure.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "components/capabilities/wells.hpp"
#include "components/wells/options.hpp"
#include "framework/assembly/keeps_totals.hpp"
#include "framework/assembly/piecewise_smooth.hpp"
#include "framework/scene/component.hpp"

namespace sprekk::wells {

/// What holds in a well.
enum class Binding { rate, pressure, shut };

/// What a well is to do in a step. Rates here and below are in m^2/s, in space in m^3/s.
struct Control {
  bool has_pressure = false;  ///< the pressure is given, and no rate
  double rate = 0;            ///< m^2/s
  bool has_limit = false;     ///< of the pressure, on the side to which the rate drives it
  double pressure = 0;        ///< Pa, the given one or the limit
};

/// Which condition holds at a pressure p (Pa) and a rate q (m^2/s, out of the well), with any resistance R (Pa s/m^2).
/// The conditions of a well with the rate Q > 0 and the limit P,
///   q = Q and p <= P,  or  0 <= q <= Q and p = P,  or  q = 0 and p >= P,
/// are one equation, q = min(max(q + (P − p)/R, 0), Q): the second argument says which branch of it holds. With Q < 0
/// the same in the other direction.
Binding binding(const Control& control, double pressure, double rate, double resistance);

/// Unknown: the pressure p of every well, one for all of its places. Its equation is the branch of `binding` in which
/// the values are, divided by the rate or the pressure that the well is to have: so the residual of a well is judged by
/// its own rate and pressure, also beside a well with a million times the rate. Newton's method with it is an
/// active-set method, which changes branches within a solve. The equations of the rates come from a coupler
/// (WellPressures::rate), which knows the cells around the places.
class LimitedWells : public Component, public PiecewiseSmooth, public WellPressures, public KeepsTotals {
 public:
  /// Throws InputError where the scene names no well.
  LimitedWells(const ComponentContext& context, const Options& options);

  void evaluate_data(const StepTime& step) override;
  bool allows_stages() const override { return true; }
  void begin_step(const StepTime&) override {}
  void assemble(Assembly& assembly, const StepTime& step) const override;
  void after_solve(const std::vector<Field*>& solved, const StepTime& step) override;
  void balance(std::map<std::string, Balance>& balances) const override;
  void begin_totals() override { injected_.set_both(Vector::Zero(injected_.size())); }
  std::uint64_t discrete_state() const override;
  std::vector<double> switch_times() const override;
  void report(std::vector<Quantity>& quantities) const override;
  void note_step(Notes& notes, const StepTime& step) const override;

  Field& pressure() override { return pressure_; }
  Field& rate() override { return rate_; }
  const Field& rate() const override { return rate_; }
  const std::vector<WellPlace>& places() const override { return places_; }
  const std::vector<std::string>& names() const override { return names_; }
  bool is_to_inject(int well) const override { return now_[well].rate > 0; }
  void accept_surroundings(std::vector<AroundWell> around) override { surroundings_ = std::move(around); }
  const std::vector<AroundWell>& surroundings() const override { return surroundings_; }
  void begin_with(const Vector& around) override;
  void scale(const Vector& resistance) override;

 private:
  int count() const { return static_cast<int>(names_.size()); }
  Control control(int well, const StepTime& step) const;
  Vector rates() const { return of_places_ * rate_.now(); }  ///< m^2/s, one a well
  Binding binding_now(int well, double rate) const;
  void choose_scales();

  Options options_;
  std::vector<std::string> names_;
  std::vector<WellPlace> places_;
  std::vector<AroundWell> surroundings_;
  Field& pressure_;
  Field& rate_;
  Field& injected_;                ///< m^2, at each place since the start
  SparseMatrix of_places_;         ///< wells × places: ones
  std::vector<Control> now_;       ///< which limit holds in this step, one a well
  Vector at_start_;                ///< Pa, the pressure around the wells, one a well
  Vector resistance_;              ///< Pa s/m^2, one a well
  Vector scale_of_rates_;          ///< m^2/s, one a well: divisor of its equation where that prescribes a rate
  double scale_of_pressures_ = 1;  ///< Pa, divisor of equations that prescribe a pressure
};

}  // namespace sprekk::wells
