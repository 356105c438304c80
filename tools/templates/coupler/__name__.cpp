// __type__: fluid leaks out of the matrix into a reservoir of constant pressure, per area a (p − p_0). Replace it by
// your terms.
#include <algorithm>

#include "components/capabilities/matrix_fluid.hpp"
#include "framework/assembly/balance_rows.hpp"
#include "framework/scene/registry.hpp"

namespace __name__ {

using namespace sprekk;

/// The parameters. From this one declaration come reading with units, messages, `sprekk explain` and the schema.
struct Options {
  double conductance = 0, reservoir_pressure = 0;
  Spec spec() {
    Spec spec("__type__", "Fluid leaks out of the matrix.");
    spec.ignore("type").ignore("between");
    spec.quantity(
        "conductance", conductance,
        {.unit = "1/(Pa*s)", .range = non_negative(), .doc = "a, volume a time, area and pressure.", .required = true});
    spec.quantity("reservoir_pressure", reservoir_pressure, {.unit = "Pa", .doc = "p_0."});
    return spec;
  }
};

/// Adds dt V a (p − p_0) to the balance of fluid of each cell, which is in m^2. A coupler knows capabilities, and no
/// component: whatever determines the pressure of the matrix can stand in `between`.
class __Class__ : public Coupler {
 public:
  __Class__(const CouplerContext& context, const Options& options)
      : Coupler(context.name),
        mesh_(context.mesh),
        options_(options),
        pressure_(context.the<MatrixFluid>().pressure()),
        leaked_(context.fields.add(mesh_, {.owner = context.name,
                                           .name = "leaked",
                                           .location = Location::cell,
                                           .role = Role::derived(),
                                           .unit = "m^2",
                                           .doc = "Fluid that has leaked since the start",
                                           .accepted_with = pressure_.name(),
                                           .is_amount = true})) {}

  void begin_step(const StepTime&) override {
    conductance_ = options_.conductance * Eigen::Map<const Vector>(mesh_.cell_measure.data(), mesh_.cell_count());
  }

  void assemble(Assembly& assembly, const StepTime& step) const override {
    if (!assembly.has_row(pressure_)) return;
    BalanceRows(assembly, pressure_).supply(-step.dt * outflow());
    assembly.diagonal(pressure_, pressure_, step.dt * conductance_);
  }

  void after_solve(const std::vector<Field*>& solved, const StepTime& step) override {
    if (std::find(solved.begin(), solved.end(), &pressure_) != solved.end())
      leaked_.set(leaked_.accepted() + step.dt * outflow());
  }

  /// What has leaked belongs to the balance of the scene: `fluid_balance_error` in history.csv stays zero.
  void balance(std::map<std::string, Balance>& balances) const override {
    balances["fluid"].outflow += leaked_.now().sum();
    balances["fluid"].throughput += leaked_.now().lpNorm<1>();
  }

 private:
  Vector outflow() const {
    return conductance_.cwiseProduct((pressure_.now().array() - options_.reservoir_pressure).matrix());
  }

  const Mesh& mesh_;
  Options options_;
  Field& pressure_;
  Field& leaked_;
  Vector conductance_;  ///< of each cell, times its area
};

const RegisterCoupler<__Class__, Options> registration("__type__");

}  // namespace __name__
