// matrix_flow/prescribed: the pressure of the matrix is given, by a formula, a table or the fields of another run.
#include <limits>

#include "components/capabilities/matrix_fluid.hpp"
#include "framework/assembly/property.hpp"
#include "framework/scene/registry.hpp"

namespace sprekk::matrix_flow {
namespace {

struct PrescribedOptions {
  Data pressure;  ///< Pa
  Spec spec() {
    Spec spec("matrix_flow/prescribed",
              "A pressure of the matrix that is given, and loads the rock one way: nothing flows, and no balance is "
              "solved.");
    spec.ignore("type");
    spec.data("pressure", pressure,
              {.unit = "Pa",
               .doc = "Pressure of each cell; that at the start is the pressure of the reference state.",
               .required = true,
               .in_time = true});
    return spec;
  }
};

/// Gives the pressure of every cell at the end of each step. It has no equation, and belongs to no `solve`.
class PrescribedPressure : public Component, public MatrixFluid {
 public:
  PrescribedPressure(const ComponentContext& context, const PrescribedOptions& options)
      : Component(context.name),
        pressure_(context.fields.add(context.mesh, {.owner = context.name,
                                                    .name = "pressure",
                                                    .location = Location::cell,
                                                    .role = Role::derived(),
                                                    .unit = "Pa",
                                                    .doc = "Pressure of the matrix, as given"})),
        values_(options.pressure, cell_places(context.mesh), context.start_time),
        initial_pressure_(values_.values()),
        switch_times_(options.pressure.switch_times()) {
    pressure_.set_both(initial_pressure_);
  }

  void evaluate_data(const StepTime& step) override { values_.evaluate(step); }
  void begin_step(const StepTime&) override { pressure_.set(values_.values()); }
  void assemble(Assembly&, const StepTime&) const override {}
  bool allows_stages() const override { return true; }
  std::vector<double> switch_times() const override { return switch_times_; }

  Field& pressure() override { return pressure_; }
  const Vector& initial_pressure() const override { return initial_pressure_; }
  double largest_given_pressure() const override {
    return std::max(initial_pressure_.lpNorm<Eigen::Infinity>(), values_.values().lpNorm<Eigen::Infinity>());
  }
  const Property* porosity_for_storage() const override { return nullptr; }
  void change_viscosity(const Vector&) override {
    throw DataError(name() + " has no viscosity: its pressure is prescribed (take it out of 'between')");
  }
  double diffusivity(int) const override { return std::numeric_limits<double>::infinity(); }

 private:
  Field& pressure_;
  Property values_;
  Vector initial_pressure_;
  std::vector<double> switch_times_;
};

const RegisterComponent<PrescribedPressure, PrescribedOptions> registration("matrix_flow/prescribed");

}  // namespace
}  // namespace sprekk::matrix_flow
