// thermal_pressurization: fluid and grains expand with temperature, which presses fluid out of pores and fractures.
#include <algorithm>
#include <optional>

#include "components/capabilities/fracture_fluid.hpp"
#include "components/capabilities/matrix_fluid.hpp"
#include "components/capabilities/poroelastic_rock.hpp"
#include "components/capabilities/temperature.hpp"
#include "components/capabilities/usual_ranges.hpp"
#include "framework/assembly/balance_rows.hpp"
#include "framework/assembly/counts_from_here.hpp"
#include "framework/assembly/follows_mesh.hpp"
#include "framework/assembly/keeps_totals.hpp"
#include "framework/assembly/property.hpp"
#include "framework/field/counted_amounts.hpp"
#include "framework/field/ownership.hpp"
#include "framework/field/units_of_amounts.hpp"
#include "framework/mesh/mesh_change.hpp"
#include "framework/scene/registry.hpp"

namespace sprekk::couplers {
namespace {

struct ThermalPressurizationOptions {
  Data fluid_expansion;
  std::optional<Data> porosity, expansion, biot_coefficient;
  Spec spec() {
    Spec spec("thermal_pressurization",
              "Fluid that is warmed expands, and so do the grains of the rock: in pores and fractures that it cannot "
              "leave, its pressure rises. A volume of rock that is warmed by 1 K presses phi beta_f + (alpha - phi) 3 "
              "alpha_T of itself out of its pores, one of fluid in fractures beta_f.");
    spec.ignore("type").ignore("between");
    spec.data("fluid_expansion", fluid_expansion,
              {.unit = "1/K",
               .range = non_negative(),
               .doc = "Volumetric expansion coefficient beta_f of the fluid.",
               .source = "Coussy 2004, section 4.2",
               .required = true,
               .material = true});
    spec.data("porosity", porosity,
              {.range = between(0, 1), .doc = "Porosity phi of the rock, for the flow in it.", .material = true});
    spec.data("expansion", expansion,
              {.unit = "1/K",
               .range = non_negative(),
               .doc = "Linear expansion coefficient alpha_T of the rock, and of its grains; without it they keep their "
                      "volume.",
               .source = "Coussy 2004, section 4.2",
               .material = true});
    spec.data("biot_coefficient", biot_coefficient,
              {.range = between(0, 1), .doc = "Biot's coefficient alpha, with 'expansion'.", .material = true});
    usually(spec, "expansion", usual_expansion());
    return spec;
  }
};

/// Takes the volume by which fluid and grains have expanded from what a balance of fluid stores:
/// −V beta (T − T_old), with the volume V of each cell, and of the fluid in each fracture cell.
///
/// T_old is the temperature that the balance has counted last (`counted_temperature`). So a split scheme counts every
/// change of temperature once, if late.
class ThermalPressurization : public Coupler, public FollowsMesh, public KeepsTotals, public CountsAmounts {
 public:
  ThermalPressurization(const CouplerContext& context, const ThermalPressurizationOptions& options)
      : Coupler(context.name), mesh_(context.mesh), fracture_fluid_(context.find<FractureFluid>()) {
    auto* const fluid = context.find<MatrixFluid>();
    auto* const heat = context.find<MatrixTemperature>();
    auto* const fracture_heat = context.find<FractureTemperature>();
    if (!fluid != !heat || !fracture_fluid_ != !fracture_heat || (!fluid && !fracture_fluid_))
      throw InputError(context.origin, "coupler " + name() + " stands between a flow and no heat, or the other way",
                       "it needs flow and heat in the rock, or in the fractures, or both",
                       "name the flow and the heat of one place under 'between'");
    if (fluid) {
      if (!options.porosity)
        throw InputError(context.origin, "'porosity' is missing", "the fluid in the pores expands",
                         "give it here or under 'materials'");
      if (options.expansion && !options.biot_coefficient)
        throw InputError(context.origin, "'biot_coefficient' is missing",
                         "of the grains that expand, (alpha - phi) 3 alpha_T presses fluid out",
                         "give it here or under 'materials', or leave out 'expansion'");
      places_.push_back({fluid->pressure(), heat->temperature(), false, of_rock(context, options, *fluid)});
    }
    if (fracture_fluid_) {
      const Property beta(options.fluid_expansion, fracture_cell_places(mesh_), context.start_time);
      Vector volumes(mesh_.fracture_cell_count());
      for (int i = 0; i < volumes.size(); ++i) volumes[i] = mesh_.fracture_cells[i].measure * beta[i];
      places_.push_back({fracture_fluid_->pressure(), fracture_heat->temperature(), true, std::move(volumes)});
    }
    if (std::ranges::none_of(places_, [](const Place& place) { return place.pressure.spec().role.is_unknown(); }))
      throw InputError(context.origin, "coupler " + name() + " has no effect",
                       "the pressure is given, whatever the fluid does", "remove it");
    for (Place& place : places_) add_fields(context, place);
  }

  bool allows_stages() const override { return true; }
  void begin_step(const StepTime&) override {}

  void assemble(Assembly& assembly, const StepTime&) const override {
    for (const Place& place : places_) {
      if (!assembly.has_row(place.pressure)) continue;
      const Vector expanding = place.expansion.cwiseProduct(widths(place));
      const Vector warmed = place.temperature.now() - place.counted->accepted();
      BalanceRows(assembly, place.pressure)
          .store(-expanding.cwiseProduct(warmed),
                 expanding.cwiseProduct(place.temperature.now()).lpNorm<Eigen::Infinity>() *
                     BalanceRows::round_off_of_change);
      assembly.diagonal(place.pressure, place.temperature, -expanding);
      if (place.is_in_fractures)
        assembly.diagonal(place.pressure, fracture_fluid_->aperture(),
                          -place.expansion.cwiseProduct(filled()).cwiseProduct(warmed));
    }
  }

  void after_solve(const std::vector<Field*>& solved, const StepTime&) override {
    for (Place& place : places_) {
      if (std::ranges::count(solved, &place.pressure) == 0) continue;
      place.stored->set(place.stored->accepted() - expanded(place));
      place.counted->set(place.temperature.now());
    }
  }

  void carry_over(const Part& part, const MeshChange& change) override {
    if (change.is_at_start) return;
    const auto& before = dynamic_cast<const ThermalPressurization&>(part);
    for (std::size_t k = 0; k < places_.size(); ++k) {
      const Vector expanded = before.expanded(before.places_[k]);
      places_[k].uncounted = places_[k].is_in_fractures ? shared_in_fracture_cells(change, expanded)
                                                        : shared_in_cells(change, before.mesh_, expanded);
    }
  }
  /// On another mesh the fluid has the temperature that has been found there, and what was not counted before is
  /// counted later.
  void settled(const MeshChange& change) override {
    if (change.is_at_start) return;
    for (Place& place : places_) {
      const Vector expanding = place.expansion.cwiseProduct(widths(place));
      Vector counted = place.temperature.now();
      for (int i = 0; i < counted.size(); ++i)
        if (expanding[i] > 0) counted[i] -= place.uncounted[i] / expanding[i];
      place.counted->set_both(std::move(counted));
    }
  }
  void count_amounts_from_here(const SettledFields&) override { count_from_now(); }
  void begin_totals() override {
    for (Place& place : places_) place.stored->set_both(Vector::Zero(place.stored->size()));
  }

  void balance(std::map<std::string, Balance>& balances) const override {
    for (const Place& place : places_)
      balances["fluid"].stored += sum_owned(mesh_, place.pressure.spec().location, place.stored->now());
  }

  static void note_absence(const std::vector<Component*>& components, Notes& notes) {
    const auto is_given = [](Component* component) {
      auto* fluid = dynamic_cast<MatrixFluid*>(component);
      return fluid && !fluid->pressure().spec().role.is_unknown();
    };
    const auto name_of = [&](auto* capability) -> std::string {
      using Capability = std::remove_pointer_t<decltype(capability)>;
      for (Component* component : components)
        if (dynamic_cast<const Capability*>(component) && !is_given(component)) return component->name();
      return "";
    };
    const std::string fluid = name_of(static_cast<MatrixFluid*>(nullptr)),
                      heat = name_of(static_cast<MatrixTemperature*>(nullptr)),
                      rock = name_of(static_cast<PoroelasticRock*>(nullptr));
    if (fluid.empty() || heat.empty() || rock.empty()) return;
    notes.add("fluid does not expand: " + fluid,
              "the fluid of '" + fluid +
                  "' keeps its volume when it is warmed (there is no coupler thermal_pressurization): pressures come "
                  "out too low where fluid that is warmed cannot leave, and too high where it is cooled. Add '- {type: "
                  "thermal_pressurization, between: [" +
                  fluid + ", " + heat + "], fluid_expansion: …}' to 'couplers:', unless that is meant");
  }

 private:
  /// Where fluid expands.
  struct Place {
    Field& pressure;
    const Field& temperature;
    bool is_in_fractures;
    Vector expansion;  ///< volume per kelvin of each cell; in fractures per aperture
    Field* counted = nullptr;
    Field* stored = nullptr;
    Vector uncounted = {};  ///< on a mesh that has changed: volume by which the fluid has expanded, for a later solve
  };

  Vector of_rock(const CouplerContext& context, const ThermalPressurizationOptions& options,
                 const MatrixFluid& fluid) const {
    const auto property = [&](const Data& data) { return Property(data, cell_places(mesh_), context.start_time); };
    const Property beta = property(options.fluid_expansion), phi = property(*options.porosity);
    const Property of_grains = property(options.expansion.value_or(Data(0))),
                   alpha = property(options.biot_coefficient.value_or(Data(1)));
    if (fluid.porosity_depends_on("T") && !of_grains.values().isZero(0))
      throw InputError(context.origin, "grains that expand fill pores twice",
                       "the porosity of the rock is a formula that names 'T'",
                       "write 'expansion: 0 1/K' here, and what grains fill in the formula: 3 (alpha - phi) alpha_T "
                       "(T - T_0) less");
    Vector volumes(mesh_.cell_count());
    for (int c = 0; c < volumes.size(); ++c) {
      if (of_grains[c] > 0 && alpha[c] < phi[c])
        throw InputError(context.origin, "'biot_coefficient' is below 'porosity'",
                         "alpha is at least phi: grains do not give way to the fluid more than the rock does",
                         "look at both");
      const double grains = of_grains[c] > 0 ? 3 * (alpha[c] - phi[c]) * of_grains[c] : 0;
      volumes[c] = fluid.is_in_cell(c) ? mesh_.cell_measure[c] * (phi[c] * beta[c] + grains) : 0;
    }
    return volumes;
  }

  void add_fields(const CouplerContext& context, Place& place) const {
    const std::string where = place.is_in_fractures ? "_in_fractures" : "_in_rock";
    place.stored = &context.fields.add(mesh_, amounts_with(place.pressure, context.name, "fluid_stored" + where,
                                                           volume_unit, "Fluid stored by thermal expansion"));
    place.counted = &context.fields.add(mesh_, {.owner = context.name,
                                                .name = "counted_temperature" + where,
                                                .location = place.pressure.spec().location,
                                                .role = Role::derived(),
                                                .unit = "K",
                                                .doc = "Temperature that the fluid balance has counted",
                                                .accepted_with = place.pressure.name()});
    place.counted->set_both(place.temperature.now());
  }

  void count_from_now() {
    for (Place& place : places_) place.counted->set_both(place.temperature.now());
  }

  /// The volume by which each cell has expanded since it was counted.
  Vector expanded(const Place& place) const {
    return place.expansion.cwiseProduct(widths(place))
        .cwiseProduct(place.temperature.now() - place.counted->accepted());
  }

  /// The part of each fracture cell that has fluid.
  Vector filled() const {
    Vector parts(mesh_.fracture_cell_count());
    for (int i = 0; i < parts.size(); ++i)
      parts[i] = fracture_fluid_->is_in_fracture_cell(i) ? fracture_fluid_->filled_part(i) : 0;
    return parts;
  }

  /// What the expansion is multiplied with: the width of the fluid, m, in fractures, else 1.
  Vector widths(const Place& place) const {
    if (!place.is_in_fractures) return Vector::Ones(place.expansion.size());
    return filled().cwiseProduct(fracture_fluid_->aperture().now());
  }

  const Mesh& mesh_;
  FractureFluid* fracture_fluid_;
  std::vector<Place> places_;
};

const RegisterCoupler<ThermalPressurization, ThermalPressurizationOptions> registration("thermal_pressurization");

}  // namespace
}  // namespace sprekk::couplers
