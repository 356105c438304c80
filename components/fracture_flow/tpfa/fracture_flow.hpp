// Flow in fractures (Eq. 8) by the two-point flux approximation along piecewise linear fractures.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "components/capabilities/fracture_fluid.hpp"
#include "components/fracture_flow/tpfa/options.hpp"
#include "framework/scene/component.hpp"

namespace sprekk::fracture_flow {

/// Unknown: the pressure p of every fracture cell. Each row balances the volume of fluid of one cell over the step (m^2):
///   L (a − a_old) + L a c_p (p − p_old) + dt (fluxes to its neighbours) − dt q = 0.
class FractureFlow : public Component, public FractureFluid {
 public:
  FractureFlow(const ComponentContext& context, const Options& options);

  void begin_step(const StepTime& step) override;
  void assemble(Assembly& assembly, const StepTime& step) const override;
  void constrain(Assembly& assembly) const override;
  void after_solve(const std::vector<Field*>& solved, const StepTime& step) override;
  void balance(std::map<std::string, Balance>& balances) const override;
  bool is_nonlinear() const override;
  std::vector<double> switch_times() const override;
  void report(std::vector<Quantity>& quantities) const override;

  Field& pressure() override { return pressure_; }
  Field& aperture() override { return aperture_; }
  const Vector& initial_aperture() const override { return initial_aperture_; }
  NormalPermeability normal_permeability() const override;

 private:
  /// K/mu (m^2/(Pa s) times m, Eq. 8) of a cell and its derivative by the aperture.
  struct Transmissivity {
    double value, by_aperture;
  };
  Transmissivity transmissivity(int cell) const;
  double hydraulic_aperture(int cell) const;  ///< the aperture, not below the floor
  struct Link {
    int first, second;  ///< cells; second is none at an open end with a prescribed pressure
    double boundary_pressure = 0;
    double gravity = 0;  ///< rho g·(x_first − x_second), Pa
  };
  struct Flux {
    double value;                     ///< m^2/s, from first to second
    double by_pressure;               ///< d value / d p_first = − d value / d p_second
    double by_first, by_second;       ///< d value / d aperture
  };
  Flux flux(const Link& link) const;
  void check_names() const;
  void make_links();
  void prescribe(const StepTime& step);

  const Mesh& mesh_;
  Options options_;
  Field& pressure_;
  Field& aperture_;
  Field& books_;  ///< (stored, injected, outflow) of each cell since the start, m^2
  Vector initial_aperture_, viscosity_, compressibility_, given_transmissivity_, given_normal_permeability_;
  std::uint64_t linked_version_ = 0;
  bool linked_ = false;
  std::vector<Link> links_;
  Vector source_;  ///< m^2/s, one a cell
  struct Prescribed {
    int cell;
    double pressure, scale;
  };
  std::vector<Prescribed> prescribed_;
};

}  // namespace sprekk::fracture_flow
