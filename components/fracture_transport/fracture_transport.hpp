// A balance of what is carried, heat or a tracer, in fractures; conducted by two points along piecewise linear
// fractures.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "components/capabilities/carried.hpp"
#include "framework/assembly/keeps_totals.hpp"
#include "framework/config/spec.hpp"
#include "framework/scene/component.hpp"
#include "framework/scene/crossings.hpp"

namespace sprekk::fracture_transport {

/// Parameters of a balance in fractures.
struct Options {
  Data aperture;       ///< m
  Data conductivity;   ///< heat: W/(m K); tracer: the diffusion, m^2/s
  Data capacity;       ///< heat: J/(m^3 K); tracer: the retardation factor
  Data initial_value;  ///< in Carried::unit
  Data decay;          ///< 1/s
  std::map<std::string, Data> boundary;
  std::map<std::string, Origin> boundary_origins;
  Crossings crossings;
};

/// Reads the conditions on sides, with the words of what is carried.
void declare_sides(Spec& spec, Options& options, const Carried& carried);

/// Unknown: the value T (temperature, concentration) of every fracture cell, a mean across the aperture a. Each row
/// balances the amount in one cell over the step (J/m or kg/m; in space J or kg, with the area of the cell for L):
///   C a L (T − T_old) + dt (sum of the conducted fluxes out of it) + dt r C a L T = 0,
/// the flux between two cells through the resistances L/(2 k a) of their halves in series. Where more than two cells
/// meet, each half leads through what fills the crossing to its middle, which stores nothing. What comes through the
/// walls, and what flowing fluid carries, is added by couplers; a is the aperture at the start of the run, and fluid
/// that enters later brings its own capacity. Units of members are those of heat in a plane.
class FractureTransport : public Component, public virtual FractureCarried, public KeepsTotals {
 public:
  /// Throws InputError for a scene without fractures, and for sides that do not exist.
  FractureTransport(const ComponentContext& context, const Carried& carried, const Options& options);

  void evaluate_data(const StepTime& step) override;
  bool allows_stages() const override { return true; }
  void begin_step(const StepTime&) override {}
  void assemble(Assembly& assembly, const StepTime& step) const override;
  void after_solve(const std::vector<Field*>& solved, const StepTime& step) override;
  void balance(std::map<std::string, Balance>& balances) const override;
  void begin_totals() override { cumulative_.set_both(Vector::Zero(cumulative_.size())); }
  std::vector<double> switch_times() const override;
  void note_input(Notes& notes) const override;

  const Carried& carried() const override { return carried_; }
  Field& value() override { return value_; }
  const Vector& capacity() const override { return capacity_; }
  std::optional<double> end_value(int point) const override;
  const Vector& wall_conductance() const override { return wall_conductance_; }
  const Vector* thickness() const override { return &thickness_; }
  const Vector& decay() const override { return decay_; }
  void add_conductivity(std::vector<Tensor> added) override;

 private:
  const Data* end_condition(int point) const;  ///< nullptr where there is none
  void connect();
  double half_length(int cell, int ridge) const;
  double half_conductance(int cell, int ridge) const;
  Vector leaving() const;  ///< W/m, of each cell: what is conducted out through ends on sides

  const Mesh& mesh_;
  const Carried& carried_;
  Options options_;
  Field& value_;
  Vector initial_value_;
  Field& cumulative_;               ///< (stored, outflow or decayed) of each fracture cell since the start
  Vector capacity_;                 ///< J/(m K)
  Vector conductance_along_;        ///< conductivity times aperture, W/K
  std::vector<Tensor> added_;       ///< to it; empty where there is nothing
  Vector resistivity_;              ///< along each cell, m K/W
  double largest_conductance_ = 0;  ///< of half a cell, W/(m K)
  Vector wall_conductance_, thickness_;
  Vector decay_;  ///< 1/s; empty where nothing decays
  Operator capacity_of_value_, outflow_of_value_;
  Vector conductance_to_end_;  ///< W/(m K), of each ridge on a side with a value; else 0
  Vector end_value_;           ///< of each ridge
};

}  // namespace sprekk::fracture_transport
