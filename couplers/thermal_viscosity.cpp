// thermal_viscosity: the viscosity of the fluid follows its temperature.
#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "components/capabilities/fracture_fluid.hpp"
#include "components/capabilities/matrix_fluid.hpp"
#include "components/capabilities/temperature.hpp"
#include "components/capabilities/usual_ranges.hpp"
#include "framework/scene/registry.hpp"

namespace sprekk::couplers {
namespace {

struct ThermalViscosityOptions {
  std::string law = "water";
  std::optional<double> reference_viscosity, reference_temperature, decay;
  Spec spec() {
    Spec spec(
        "thermal_viscosity",
        "The viscosity of the fluid follows the temperature at the start of each step, in the rock, in fractures, "
        "or in both; a viscosity that the flow gives is not used then.");
    spec.ignore("type").ignore("between");
    spec.choice("law", law,
                {{"water", "2.414e-5 Pa s times 10^(247.8 K/(T - 140 K)), for liquid water from 273 to 640 K"},
                 {"exponential", "reference_viscosity times exp(-decay (T - reference_temperature))"}},
                {.doc = "How it follows the temperature.", .source = "Vogel 1921; Al-Shemmeri 2012"});
    spec.quantity("reference_viscosity", reference_viscosity,
                  {.unit = "Pa*s", .range = positive(), .doc = "Of the exponential law."});
    usually(spec, "reference_viscosity", usual_viscosity());
    spec.quantity("reference_temperature", reference_temperature, {.unit = "K", .doc = "Of the exponential law."});
    spec.quantity("decay", decay, {.unit = "1/K", .range = non_negative(), .doc = "Of the exponential law."});
    spec.check([this](const Node& node) {
      const bool has_any = reference_viscosity || reference_temperature || decay;
      const bool has_all = reference_viscosity && reference_temperature && decay;
      if (law == "exponential" && !has_all)
        throw InputError(node.origin, "the exponential law of the viscosity lacks a parameter",
                         "it needs 'reference_viscosity', 'reference_temperature' and 'decay'", "give all three");
      if (law != "exponential" && has_any)
        throw InputError(node.origin, "parameters of the exponential law have no effect", "the law is that of " + law,
                         "write 'law: exponential', or remove them");
    });
    return spec;
  }
};

/// Gives the flow the viscosity at the accepted temperature: that of the start of the step, so that the equations of a
/// step stay linear in its unknowns; an error of first order in the step. Nothing is kept: a repeated step has the same
/// viscosity.
class ThermalViscosity : public Coupler {
 public:
  ThermalViscosity(const CouplerContext& context, const ThermalViscosityOptions& options)
      : Coupler(context.name),
        options_(options),
        origin_(context.origin),
        matrix_(context.find<MatrixFluid>()),
        rock_(context.find<MatrixTemperature>()),
        fracture_(context.find<FractureFluid>()),
        water_(context.find<FractureTemperature>()) {
    if (!(matrix_ && rock_) && !(fracture_ && water_))
      throw InputError(context.origin, "coupler " + name() + " has no flow with a temperature",
                       "it needs the flow and the heat of the matrix, of the fractures, or of both",
                       "name such components in `between`");
  }

  void evaluate_data(const StepTime&) override {
    if (matrix_ && rock_) matrix_->change_viscosity(viscosities(rock_->temperature()));
    if (fracture_ && water_) fracture_->change_viscosity(viscosities(water_->temperature()));
  }
  void begin_step(const StepTime&) override {}
  void assemble(Assembly&, const StepTime&) const override {}

 private:
  double viscosity(double temperature) const {
    if (options_.law == "exponential")
      return *options_.reference_viscosity *
             std::exp(-*options_.decay * (temperature - *options_.reference_temperature));
    constexpr double factor = 2.414e-5, rise = 247.8, pole = 140;  // Pa s, K, K
    return factor * std::pow(10, rise / (temperature - pole));
  }
  Vector viscosities(const Field& temperature) const {
    constexpr double coldest = 273, hottest = 640;  // K, of the law for water
    Vector values(temperature.size());
    for (int i = 0; i < values.size(); ++i) {
      const double t = temperature.accepted()[i];
      if (options_.law == "water" && !(t >= coldest && t <= hottest))
        throw DataError(InputError(origin_,
                                   fmt::format("{} is {:.6g} K, where water is no liquid", temperature.name(), t),
                                   fmt::format("the law holds from {} to {} K", coldest, hottest),
                                   "give temperatures in K from absolute zero, or another law")
                            .what());
      values[i] = viscosity(t);
    }
    return values;
  }

  ThermalViscosityOptions options_;
  Origin origin_;
  MatrixFluid* matrix_;
  MatrixTemperature* rock_;
  FractureFluid* fracture_;
  FractureTemperature* water_;
};

const RegisterCoupler<ThermalViscosity, ThermalViscosityOptions> registration("thermal_viscosity");

}  // namespace
}  // namespace sprekk::couplers
