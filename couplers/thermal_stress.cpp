// thermal_stress: temperature loads the rock, sigma = C : grad u − 3 K alpha_T (T − T_0) I (Biot 1956; Nowacki 1986).
#include <fmt/format.h>

#include <cmath>

#include "components/capabilities/poroelastic_rock.hpp"
#include "components/capabilities/temperature.hpp"
#include "components/capabilities/usual_ranges.hpp"
#include "framework/assembly/state_fields.hpp"
#include "framework/scene/registry.hpp"

namespace sprekk::couplers {
namespace {

struct ThermalStressOptions {
  Data expansion;
  Spec spec() {
    Spec spec("thermal_stress",
              "Thermal expansion of the rock, against its initial temperature; the heat that deformation makes is "
              "neglected.");
    spec.ignore("type").ignore("between");
    spec.data("expansion", expansion,
              {.unit = "1/K",
               .range = non_negative(),
               .doc = "Linear expansion coefficient alpha_T of the drained rock; it may change with time.",
               .required = true,
               .material = true,
               .in_time = true});
    usually(spec, "expansion", usual_expansion());
    return spec;
  }
};

/// Gives the rock the stress −3 K alpha_T (T − T_0) I as a pore pressure of the size T with the coefficient
/// 3 K alpha_T: the rock assembles the load, with its derivative.
class ThermalStress : public Coupler {
 public:
  ThermalStress(const CouplerContext& context, const ThermalStressOptions& options)
      : Coupler(context.name),
        heat_(context.the<MatrixTemperature>()),
        rock_(context.the<PoroelasticRock>()),
        expansion_(options.expansion, cell_places(context.mesh), context.start_time),
        switch_times_(options.expansion.switch_times()) {
    if (auto* formulas = dynamic_cast<TakesState*>(&rock_))
      formulas->offer_state("T", StateField{&heat_.temperature()});
    if (rock_.bulk_modulus().values().minCoeff() <= 0)
      throw InputError(context.origin, "coupler " + name() + " does not know the bulk modulus of the rock",
                       "its stiffness is anisotropic", "give 'bulk_modulus' to the component");
    rock_.accept_pore_pressure(heat_.temperature(), stress_by_temperature(), heat_.initial_temperature());
    rock_.let_alpha_follow_stiffness(heat_.temperature());  // it expands freely, whatever its stiffness
    remember();
  }

  void evaluate_data(const StepTime& step) override {
    expansion_.evaluate(step);
    if (used_ == std::pair(expansion_.version(), rock_.bulk_modulus().version())) return;
    rock_.change_alpha(heat_.temperature(), stress_by_temperature());
    remember();
  }
  void begin_step(const StepTime&) override {}
  void note_input(Notes& notes) const override {
    constexpr double noticeable = 1.01;  // measured stiffnesses are not known to 1 %
    const double ratio = rock_.unequal_expansion();
    if (ratio <= noticeable) return;
    notes.add(name() + " of anisotropic rock",
              fmt::format(
                  "free rock expands {} as much along one axis as along another under the stress of {} ('expansion' is "
                  "the coefficient of isotropic rock, and the stress -3 K expansion (T - T_0) is the same in all "
                  "directions) give the rock an isotropic stiffness, or take its strains with care",
                  std::isinf(ratio) ? "infinitely" : fmt::format("{:.3g} times", ratio), name()));
  }
  void assemble(Assembly&, const StepTime&) const override {}
  std::vector<double> switch_times() const override { return switch_times_; }

 private:
  Vector stress_by_temperature() const { return 3 * rock_.bulk_modulus().values().cwiseProduct(expansion_.values()); }
  void remember() { used_ = {expansion_.version(), rock_.bulk_modulus().version()}; }

  MatrixTemperature& heat_;
  PoroelasticRock& rock_;
  Property expansion_;
  std::pair<std::uint64_t, std::uint64_t> used_;
  std::vector<double> switch_times_;
};

const RegisterCoupler<ThermalStress, ThermalStressOptions> registration("thermal_stress");

}  // namespace
}  // namespace sprekk::couplers
