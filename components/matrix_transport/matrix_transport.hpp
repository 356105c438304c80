// A balance of what is carried, heat or a tracer, in the matrix, for any discretization of what is conducted.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "components/capabilities/carried.hpp"
#include "components/capabilities/flux_discretization.hpp"
#include "framework/assembly/keeps_totals.hpp"
#include "framework/config/spec.hpp"
#include "framework/scene/component.hpp"

namespace sprekk::matrix_transport {

/// The condition on one side of the outer boundary; without value and flux, nothing is conducted through it.
struct SideCondition {
  Origin origin;
  std::optional<Data> value;
  std::optional<Data> flux;  ///< out of the rock, per area (Carried::flux_unit)
};

/// Parameters of a balance in the matrix.
struct Options {
  TensorData conductivity;  ///< heat: W/(m K); tracer: the diffusion in the pores, m^2/s
  Data capacity;            ///< heat: J/(m^3 K); tracer: the retardation factor
  Data porosity = 1;        ///< a factor of both
  Data initial_value;       ///< in Carried::unit
  Data source;              ///< an amount per volume and time
  Data decay;               ///< 1/s
  std::map<std::string, SideCondition> boundary;
};

/// Reads the conditions on sides, with the words of what is carried. `flux_key`: "heat_flux".
void declare_sides(Spec& spec, Options& options, const Carried& carried, const std::string& flux_key);

/// Unknown: the value T (temperature, concentration) of every cell. Each row balances the amount in one cell over the
/// step (J/m or kg/m; in space J or kg):
///   C V (T − T_old) + dt (sum of the conducted fluxes out of it) + dt r C V T − dt H V = 0,  flux = −k grad T,
/// with the capacity C of rock and what is in its pores at the start, the rate r of decay, and the source H. What
/// flowing fluid carries is added by a coupler. Units of members are those of heat in a plane.
class MatrixTransport : public Component,
                        public virtual MatrixCarried,
                        public virtual CarriedWalls,
                        public KeepsTotals {
 public:
  /// Throws InputError for sides that do not exist, and DataError for a conductivity that is not positive definite.
  MatrixTransport(const ComponentContext& context, const Carried& carried, const Options& options,
                  DiscretizeFlux discretize);

  void evaluate_data(const StepTime& step) override;
  bool allows_stages() const override { return true; }
  void begin_step(const StepTime& step) override;
  void assemble(Assembly& assembly, const StepTime& step) const override;
  void after_solve(const std::vector<Field*>& solved, const StepTime& step) override;
  void balance(std::map<std::string, Balance>& balances) const override;
  void note_input(Notes& notes) const override;
  void note_step(Notes& notes, const StepTime& step) const override;
  void begin_totals() override { cumulative_.set_both(Vector::Zero(cumulative_.size())); }
  std::vector<double> switch_times() const override;

  const Carried& carried() const override { return carried_; }
  Field& value() override { return value_; }
  const Vector& capacity() const override { return capacity_; }
  const Vector& initial_value() const override { return initial_value_; }
  std::optional<double> side_value(int face) const override;
  const Vector& decay() const override { return decay_; }
  void add_conductivity(std::vector<Tensor> added) override;
  Field& wall_flux() override { return *wall_flux_; }
  const LinearExpression& wall_value() const override { return wall_value_; }

 private:
  const SideCondition* condition(int face) const;  ///< nullptr inside, on walls and on insulated sides
  void check_sides() const;
  void read_properties(double start);
  void discretize();
  void use_operators();
  void use_boundary();
  Vector face_fluxes() const;  ///< through every face, without those through walls

  const Mesh& mesh_;
  const Carried& carried_;
  Options options_;
  Origin origin_;
  DiscretizeFlux discretize_;
  Field& value_;
  Field* wall_flux_ = nullptr;  ///< exists with fractures only
  Field& cumulative_;           ///< (stored, generated, outflow or decayed) of each cell since the start
  Vector initial_value_;
  Vector capacity_;  ///< J/(m K), m^2; one a cell
  Vector decay_;     ///< 1/s; empty where nothing decays
  std::vector<Tensor> conductivity_;
  std::vector<Tensor> added_;  ///< to the conductivity; empty where there is nothing
  std::uint64_t discretized_mesh_ = 0;
  bool is_discretized_ = false;
  FluxOperators operators_;
  std::vector<FlowCondition> conditions_;
  Operator capacity_of_value_, outflow_of_value_, outflow_of_wall_flux_;
  double largest_conductance_ = 0;  ///< largest sum of absolute entries of a row of the outflow, W/(m K)
  SparseMatrix boundary_of_wall_flux_, flux_of_wall_flux_;  ///< faces × walls
  Vector boundary_values_, boundary_changes_;               ///< one a face, see FluxOperators
  Vector boundary_fluxes_;                                  ///< W/m, one a face
  Vector source_;                                           ///< W/m, one a cell
  LinearExpression wall_value_;
};

/// The discretizations of what is conducted.
inline constexpr char two_point[] = "tpfa", multi_point[] = "mpfa";

/// A component for one kind of amount. `Kind`: Value and Walls, its capabilities, and carried(), what they are about.
template <class Kind, const char* scheme>
class TransportOf : public MatrixTransport, public Kind::Value, public Kind::Walls {
 public:
  TransportOf(const ComponentContext& context, const Options& options)
      : MatrixTransport(context, Kind::carried(), options, flux_discretization(scheme)) {}
};

}  // namespace sprekk::matrix_transport
