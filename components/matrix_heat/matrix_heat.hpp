// Heat in the matrix, for any discretization of the flux.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "components/capabilities/flux_discretization.hpp"
#include "components/capabilities/temperature.hpp"
#include "framework/assembly/keeps_totals.hpp"
#include "framework/config/spec.hpp"
#include "framework/scene/component.hpp"

namespace sprekk::matrix_heat {

/// The condition on one side of the outer boundary; without temperature and flux, no heat is conducted through it.
struct SideCondition {
  Origin origin;
  std::optional<Data> temperature;  ///< K
  std::optional<Data> heat_flux;    ///< W/m^2, out of the rock
};

/// Parameters of heat in the matrix.
struct Options {
  TensorData conductivity;   ///< W/(m K)
  Data heat_capacity;        ///< J/(m^3 K)
  Data initial_temperature;  ///< K
  Data source;               ///< W/m^3
  std::map<std::string, SideCondition> boundary;
  Spec spec(const std::string& type, const std::string& doc);
};

/// Unknown: the temperature T of every cell. Each row balances the heat of one cell over the step (J/m):
///   C V (T − T_old) + dt (sum of the conducted fluxes out of it) − dt H V = 0,  flux = −k grad T,
/// with the heat capacity C of rock and what is in its pores at the start. What flowing fluid carries is added by a
/// coupler.
class MatrixHeat : public Component, public MatrixTemperature, public HeatWalls, public KeepsTotals {
 public:
  MatrixHeat(const ComponentContext& context, const Options& options, DiscretizeFlux discretize);

  void evaluate_data(const StepTime& step) override;
  void begin_step(const StepTime& step) override;
  void assemble(Assembly& assembly, const StepTime& step) const override;
  void after_solve(const std::vector<Field*>& solved, const StepTime& step) override;
  void balance(std::map<std::string, Balance>& balances) const override;
  void note_input(Notes& notes) const override;
  void note_step(Notes& notes, const StepTime& step) const override;
  void begin_totals() override { cumulative_.set_both(Vector::Zero(cumulative_.size())); }
  std::vector<double> switch_times() const override;

  Field& temperature() override { return temperature_; }
  const Vector& heat_capacity() const override { return capacity_; }
  const Vector& initial_temperature() const override { return initial_temperature_; }
  std::optional<double> side_temperature(int face) const override;
  Field& wall_heat_flux() override { return *wall_heat_flux_; }
  const LinearExpression& wall_temperature() const override { return wall_temperature_; }

 private:
  const SideCondition* condition(int face) const;  ///< nullptr inside, on walls and on insulated sides
  void check_sides() const;
  void read_properties(double start);
  void discretize();
  void use_operators();
  void use_boundary();
  Vector face_heat_fluxes() const;  ///< W/m, through every face, without those through walls

  const Mesh& mesh_;
  Options options_;
  Origin origin_;
  DiscretizeFlux discretize_;
  Field& temperature_;
  Field* wall_heat_flux_ = nullptr;  ///< exists with fractures only
  Field& cumulative_;                ///< (stored, generated, outflow) of each cell since the start, J/m
  Vector initial_temperature_;
  Vector capacity_;  ///< J/(m K), one a cell
  std::vector<Tensor> conductivity_;
  std::uint64_t discretized_mesh_ = 0;
  bool is_discretized_ = false;
  FluxOperators operators_;
  std::vector<FlowCondition> conditions_;
  Operator capacity_of_temperature_, outflow_of_temperature_, outflow_of_wall_flux_;
  double largest_conductance_ = 0;  ///< largest sum of absolute entries of a row of the outflow, W/(m K)
  SparseMatrix boundary_of_wall_flux_, flux_of_wall_flux_;  ///< faces × walls
  Vector boundary_values_, boundary_changes_;               ///< one a face, see FluxOperators
  Vector boundary_fluxes_;                                  ///< W/m, one a face
  Vector source_;                                           ///< W/m, one a cell
  LinearExpression wall_temperature_;
};

}  // namespace sprekk::matrix_heat
