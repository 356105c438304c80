// Heat in fractures, conducted by two points along piecewise linear fractures.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "components/capabilities/temperature.hpp"
#include "framework/assembly/keeps_totals.hpp"
#include "framework/config/spec.hpp"
#include "framework/scene/component.hpp"
#include "framework/scene/crossings.hpp"

namespace sprekk::fracture_heat {

/// Parameters of heat in fractures.
struct Options {
  Data aperture;             ///< m
  Data conductivity;         ///< W/(m K)
  Data heat_capacity;        ///< J/(m^3 K)
  Data initial_temperature;  ///< K
  std::map<std::string, Data> boundary;
  std::map<std::string, Origin> boundary_origins;
  Crossings crossings;
  Spec spec();
};

/// Unknown: the temperature T of every fracture cell, a mean across the aperture a. Each row balances its heat over the
/// step (J/m):
///   C a L (T − T_old) + dt (sum of the conducted fluxes out of it) = 0,
/// the flux between two cells through the resistances L/(2 k a) of their halves in series. Where more than two cells
/// meet, each half leads through what fills the crossing to its middle, which stores nothing. What comes through the
/// walls, and what flowing fluid carries, is added by couplers; a is the aperture at the start of the run, and fluid
/// that enters later brings its own heat capacity.
class FractureHeat : public Component, public FractureTemperature, public KeepsTotals {
 public:
  FractureHeat(const ComponentContext& context, const Options& options);

  void evaluate_data(const StepTime& step) override;
  void begin_step(const StepTime&) override {}
  void assemble(Assembly& assembly, const StepTime& step) const override;
  void after_solve(const std::vector<Field*>& solved, const StepTime& step) override;
  void balance(std::map<std::string, Balance>& balances) const override;
  void begin_totals() override { cumulative_.set_both(Vector::Zero(cumulative_.size())); }
  std::vector<double> switch_times() const override;
  void note_input(Notes& notes) const override;

  Field& temperature() override { return temperature_; }
  const Vector& heat_capacity() const override { return capacity_; }
  std::optional<double> end_temperature(int point) const override;
  const Vector& wall_conductance() const override { return wall_conductance_; }
  const Vector* thickness() const override { return &thickness_; }

 private:
  const Data* end_condition(int point) const;  ///< nullptr where there is none
  /// `resistivity`: of each cell along it, m K/W; `aperture`: m.
  void connect(const Vector& resistivity, const Vector& aperture);
  double half_length(int cell, int ridge) const;
  double half_conductance(int cell, int ridge) const;
  Vector leaving() const;  ///< W/m, of each cell: what is conducted out through ends on sides

  const Mesh& mesh_;
  Options options_;
  Field& temperature_;
  Vector initial_temperature_;
  Field& cumulative_;               ///< (stored, outflow) of each fracture cell since the start, J/m
  Vector capacity_;                 ///< J/(m K)
  Vector conductance_along_;        ///< conductivity times aperture, W/K
  double largest_conductance_ = 0;  ///< of half a cell, W/(m K)
  Vector wall_conductance_, thickness_;
  Operator capacity_of_temperature_, outflow_of_temperature_;
  Vector conductance_to_end_;  ///< W/(m K), of each ridge on a side with a temperature; else 0
  Vector end_temperature_;     ///< K, of each ridge
};

}  // namespace sprekk::fracture_heat
