// matrix_heat/prescribed: the temperature of the matrix is given, by a formula, a table or the fields of another run.
#include "components/capabilities/temperature.hpp"
#include "framework/assembly/property.hpp"
#include "framework/scene/registry.hpp"

namespace sprekk::matrix_transport {
namespace {

struct PrescribedOptions {
  Data temperature;  ///< K
  Spec spec() {
    Spec spec("matrix_heat/prescribed",
              "A temperature of the matrix that is given, and acts one way: no balance of heat is solved.");
    spec.ignore("type");
    spec.data("temperature", temperature,
              {.unit = "K",
               .doc = "Temperature of each cell; that at the start is the temperature of the reference state.",
               .required = true,
               .in_time = true});
    return spec;
  }
};

/// Gives the temperature of every cell at the end of each step. It has no equation, and belongs to no `solve`.
class PrescribedTemperature : public Component, public MatrixTemperature {
 public:
  PrescribedTemperature(const ComponentContext& context, const PrescribedOptions& options)
      : Component(context.name),
        temperature_(context.fields.add(context.mesh, {.owner = context.name,
                                                       .name = "temperature",
                                                       .location = Location::cell,
                                                       .role = Role::derived(),
                                                       .unit = "K",
                                                       .doc = "Temperature of the matrix, as given"})),
        values_(options.temperature, cell_places(context.mesh), context.start_time),
        initial_temperature_(values_.values()),
        switch_times_(options.temperature.switch_times()) {
    temperature_.set_both(initial_temperature_);
  }

  void evaluate_data(const StepTime& step) override { values_.evaluate(step); }
  void begin_step(const StepTime&) override { temperature_.set(values_.values()); }
  void assemble(Assembly&, const StepTime&) const override {}
  bool allows_stages() const override { return true; }
  std::vector<double> switch_times() const override { return switch_times_; }

  const Carried& carried() const override { return carried_heat; }
  Field& value() override { return temperature_; }
  const Vector& capacity() const override { return nothing_; }
  const Vector& initial_value() const override { return initial_temperature_; }
  std::optional<double> side_value(int) const override { return std::nullopt; }
  const Vector& decay() const override { return nothing_; }
  void add_conductivity(std::vector<Tensor>) override {}  // nothing is conducted

 private:
  Field& temperature_;
  Property values_;
  Vector initial_temperature_, nothing_;
  std::vector<double> switch_times_;
};

const RegisterComponent<PrescribedTemperature, PrescribedOptions> registration("matrix_heat/prescribed");

}  // namespace
}  // namespace sprekk::matrix_transport
