// buoyancy: the weight of the fluid follows its temperature and its pressure.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "components/capabilities/fluid_density.hpp"
#include "components/capabilities/fracture_fluid.hpp"
#include "components/capabilities/matrix_fluid.hpp"
#include "components/capabilities/temperature.hpp"
#include "components/capabilities/usual_ranges.hpp"
#include "couplers/fluid_formulas.hpp"
#include "framework/parallel/parallel.hpp"
#include "framework/scene/registry.hpp"

namespace sprekk::couplers {
namespace {

constexpr double room_temperature = 293.15;   // K: 20 °C, to which tables refer
constexpr double ice_point = 273.15;          // K, 0 degrees Celsius
constexpr double coldest = 0, hottest = 150;  // degrees Celsius, of the law for water: the range of Kell 1975
constexpr double most_that_varies = 0.05;     // of the density; beyond it a note says what is neglected

struct BuoyancyOptions {
  std::string law = "linear";
  double fluid_density = 1000;
  double fluid_expansion = 0;
  double reference_temperature = room_temperature;
  double compressibility = 0;
  double reference_pressure = 0;
  std::optional<Data> density;  ///< kg/m^3, of the law formula
  bool has_expansion = false, has_compressibility = false, has_temperature = false;
  Spec spec() {
    Spec spec("buoyancy",
              "The density of the fluid follows its temperature and its pressure in what gravity does to it "
              "(Boussinesq's approximation): warm fluid rises. Volumes of fluid are balanced as without it.");
    spec.ignore("type").ignore("between");
    spec.choice("law", law,
                {{"linear", "fluid_density (1 − fluid_expansion (T − T_0) + compressibility (p − p_0))"},
                 {"exponential", "fluid_density exp(−fluid_expansion (T − T_0) + compressibility (p − p_0))"},
                 {"water", "that of liquid water at 0.1 MPa from 0 to 150 °C, times exp(compressibility (p − p_0))"},
                 {"formula", "the formula given as density"}},
                {.doc = "How it follows temperature T and pressure p.",
                 .source = "Kell 1975, J. Chem. Eng. Data 20, 97, for water"});
    spec.quantity("fluid_density", fluid_density,
                  {.unit = "kg/m^3",
                   .range = positive(),
                   .doc = "Density at T_0 and p_0; not for the law of water.",
                   .material = true});
    usually(spec, "fluid_density", usual_fluid_density());
    spec.quantity("fluid_expansion", fluid_expansion,
                  {.unit = "1/K",
                   .range = non_negative(),
                   .doc = "Volumetric expansion coefficient (water: 2.1e-4 1/K at 20 °C, 7.5e-4 1/K at 100 °C).",
                   .material = true});
    usually(spec, "fluid_expansion", usual_fluid_expansion());
    spec.quantity("reference_temperature", reference_temperature,
                  {.unit = "K", .doc = "T_0, of the linear and the exponential law."});
    spec.quantity("compressibility", compressibility,
                  {.unit = "1/Pa",
                   .range = between(0, 100),
                   .doc = "How much denser the fluid is under pressure (water: 4.5e-10 1/Pa)."});
    usually(spec, "compressibility", usual_compressibility());
    spec.quantity("reference_pressure", reference_pressure,
                  {.unit = "Pa", .doc = "p_0; the pressure at which the law without compressibility holds."});
    spec.data("density", density, {.unit = "kg/m^3", .range = positive(), .doc = "A formula, of the law formula."});
    may_be_formula(spec.name(), "density", fluid_variables());
    spec.check([this](const Node& node) {
      if ((law == "formula") != density.has_value())
        throw InputError(node.origin, density ? "'density' has no effect" : "'density' is missing",
                         "the law is '" + law + "'",
                         density ? "write 'law: formula', or remove it" : "give its formula in kg/m^3");
      const auto names = [&](std::size_t variable) {
        return density && (variables_named(*density, {}, fluid_variables()) >> variable & 1U) != 0;
      };
      if (density) refuse_place(*density, node.find("density")->origin, "density");
      has_expansion = law == "water" || (law != "formula" && fluid_expansion > 0) || names(0);
      has_compressibility = compressibility > 0 || names(1);
      has_temperature = node.find("reference_temperature") != nullptr;
      if (law == "water" && (node.find("fluid_density") || node.find("fluid_expansion") || has_temperature))
        throw InputError(node.origin, "parameters of the linear law have no effect", "the law is that of water",
                         "write 'law: linear' or 'law: exponential', or remove them");
      if (density && (node.find("fluid_density") || node.find("fluid_expansion") || has_temperature ||
                      node.find("compressibility") || node.find("reference_pressure")))
        throw InputError(node.origin, "parameters of other laws have no effect", "the law is a formula",
                         "write their values in the formula");
      if (!has_expansion && !has_compressibility)
        throw InputError(node.origin, "the density does not vary",
                         "'fluid_expansion' and 'compressibility' are both zero",
                         "give one of them here, or 'fluid_expansion' in 'materials:', or remove the coupler");
    });
    return spec;
  }
};

/// A density, kg/m^3, and its derivatives by temperature and pressure.
struct Density {
  double value, by_temperature, by_pressure;
};

class DensityLaw {
 public:
  explicit DensityLaw(const BuoyancyOptions& options) : options_(options) {}
  Density at(double temperature, double pressure) const {
    if (options_.density) {
      const auto [value, by] = of_fluid(*options_.density, temperature, pressure);
      return {value, by[0], by[1]};
    }
    const double rise = options_.compressibility * (pressure - options_.reference_pressure);
    if (options_.law == "water") {
      const auto [value, slope] = water(temperature - ice_point);
      const double factor = std::exp(rise);
      return {value * factor, slope * factor, options_.compressibility * value * factor};
    }
    const double expansion = options_.fluid_expansion, density = options_.fluid_density;
    const double exponent = rise - expansion * (temperature - options_.reference_temperature);
    if (options_.law == "linear")
      return {density * (1 + exponent), -expansion * density, options_.compressibility * density};
    const double value = density * std::exp(exponent);
    return {value, -expansion * value, options_.compressibility * value};
  }

 private:
  /// Kell's law (t in degrees Celsius), kg/m^3, and its derivative. Beyond its range, which iterates may leave, its
  /// tangent is taken.
  static std::array<double, 2> water(double t) {
    const double within = std::clamp(t, coldest, hottest);
    const auto [value, slope] = kell(within);
    return {value + slope * (t - within), slope};
  }
  static std::array<double, 2> kell(double t) {
    // Kell 1975, kg/m^3 by degrees Celsius.
    constexpr std::array<double, 6> numerator = {999.83952,     16.945176,    -7.9870401e-3,
                                                 -46.170461e-6, 105.56302e-9, -280.54253e-12};
    constexpr double denominator = 16.879850e-3;  // the same
    double sum = 0, slope = 0;
    for (int k = 5; k >= 0; --k) {
      slope = slope * t + sum;
      sum = sum * t + numerator[k];
    }
    const double below = 1 + denominator * t;
    return {sum / below, (slope - sum * denominator / below) / below};
  }

  const BuoyancyOptions& options_;
};

/// The density in the cells of the rock, or of the fractures.
class DensityIn : public FluidDensity {
 public:
  /// `temperature`: nullptr where the density does not depend on it.
  DensityIn(const BuoyancyOptions& options, const Field* temperature, const Field& pressure,
            std::function<std::optional<double>(int)> boundary_temperature)
      : options_(options),
        law_(options),
        temperature_(temperature),
        pressure_(pressure),
        boundary_temperature_(std::move(boundary_temperature)) {}

  Vector values(State state) const override {
    Vector values(pressure_.size());
    for (int i = 0; i < values.size(); ++i) values[i] = at(state, i).value;
    return values;
  }
  Version version(State state) const override {
    const auto of = [&](const Field& field) {
      return state == State::now ? field.version() : field.accepted_version();
    };
    return {temperature_ ? of(*temperature_) : 0, follows_pressure() ? of(pressure_) : 0};
  }
  std::vector<Derivative> derivatives() const override {
    Vector by_temperature(pressure_.size()), by_pressure(pressure_.size());
    for (int i = 0; i < pressure_.size(); ++i) {
      const Density density = at(State::now, i);
      by_temperature[i] = density.by_temperature;
      by_pressure[i] = density.by_pressure;
    }
    std::vector<Derivative> derivatives;
    if (temperature_) derivatives.push_back({temperature_, std::move(by_temperature)});
    if (follows_pressure()) derivatives.push_back({&pressure_, std::move(by_pressure)});
    return derivatives;
  }
  std::optional<double> at_boundary(int place, double pressure) const override {
    if (!temperature_) return law_.at(options_.reference_temperature, pressure).value;
    const std::optional<double> temperature = boundary_temperature_(place);
    return temperature ? std::optional(law_.at(*temperature, pressure).value) : std::nullopt;
  }

  const Field* temperature() const { return temperature_; }
  const Field& pressure() const { return pressure_; }

 private:
  bool follows_pressure() const { return options_.has_compressibility; }
  Density at(State state, int i) const {
    const auto of = [&](const Field& field) { return (state == State::now ? field.now() : field.accepted())[i]; };
    return law_.at(temperature_ ? of(*temperature_) : options_.reference_temperature, of(pressure_));
  }

  const BuoyancyOptions& options_;
  DensityLaw law_;
  const Field* temperature_;
  const Field& pressure_;
  std::function<std::optional<double>(int)> boundary_temperature_;
};

/// Gives the flows the density as a function of current temperatures and pressures. The flows assemble its terms with
/// all derivatives; the coupler itself keeps no state.
class Buoyancy : public Coupler {
 public:
  Buoyancy(const CouplerContext& context, const BuoyancyOptions& options)
      : Coupler(context.name), mesh_(context.mesh), options_(options), origin_(context.origin) {
    auto* matrix = context.find<BuoyantMatrix>();
    auto* matrix_fluid = context.find<MatrixFluid>();
    auto* fractures = context.find<BuoyantFractures>();
    auto* fracture_fluid = context.find<FractureFluid>();
    auto* rock = context.find<MatrixTemperature>();
    auto* water = context.find<FractureTemperature>();
    refuse(context, matrix, matrix_fluid, fractures, rock, water);
    if (fractures)
      in_fractures_ = std::make_unique<DensityIn>(options_, options_.has_expansion ? &water->temperature() : nullptr,
                                                  fracture_fluid->pressure(),
                                                  [water](int point) { return water->end_value(point); });
    if (matrix)
      in_rock_ =
          std::make_unique<DensityIn>(options_, options_.has_expansion ? &rock->temperature() : nullptr,
                                      matrix_fluid->pressure(), [rock](int face) { return rock->side_value(face); });
    if (fractures) fractures->accept_density(*in_fractures_);
    if (matrix) matrix->accept_density(*in_rock_, in_fractures_.get());
  }

  bool allows_stages() const override { return true; }
  void evaluate_data(const StepTime&) override {
    for (const DensityIn* place : {in_rock_.get(), in_fractures_.get()})
      if (place) check_range(*place);
  }
  void begin_step(const StepTime&) override {}
  void assemble(Assembly&, const StepTime&) const override {}  // the flows assemble the weight

  void output(std::vector<OutputField>& fields) const override {
    const auto add = [&](const DensityIn* place, const char* what, Location location) {
      if (place)
        fields.push_back({name() + "." + what, "kg/m^3", location, 1, place->values(FluidDensity::State::now)});
    };
    add(in_rock_.get(), "density", Location::cell);
    add(in_fractures_.get(), "density_in_fractures", Location::fracture_cell);
  }

  void note_step(Notes& notes, const StepTime&) const override {
    double lowest = std::numeric_limits<double>::infinity(), highest = 0;
    for (const DensityIn* place : {in_rock_.get(), in_fractures_.get()}) {
      if (!place) continue;
      const Vector density = place->values(FluidDensity::State::now);
      lowest = std::min(lowest, density.minCoeff());
      highest = std::max(highest, density.maxCoeff());
    }
    const double varies = 2 * (highest - lowest) / (highest + lowest);
    if (varies > most_that_varies)
      notes.add(
          name() + ": a density that varies by more than its approximation bears",
          fmt::format("the density of the fluid varies by {:.2g} %, from {:.5g} to {:.5g} kg/m^3 (only its weight is "
                      "computed with this density: volumes of fluid, and the heat that they carry, have errors of up "
                      "to this size) take differences of pressure and temperature that are smaller, or accept them",
                      100 * varies, lowest, highest),
          varies);
  }

  static void note_absence(const std::vector<Component*>& components, Notes& notes) {
    for (const Component* flow : components) {
      const auto* buoyant = dynamic_cast<const BuoyantMatrix*>(flow);
      if (!buoyant || !buoyant->has_gravity()) continue;
      for (const Component* heat : components)
        if (dynamic_cast<const MatrixTemperature*>(heat))
          notes.add("no buoyancy between " + flow->name() + " and " + heat->name(),
                    "the fluid of " + flow->name() + " has one density at all temperatures of " + heat->name() +
                        " (no coupler buoyancy stands between them, although there is gravity) add one, with both in "
                        "`between`, unless that is meant");
    }
  }

 private:
  void refuse(const CouplerContext& context, const BuoyantMatrix* matrix, const MatrixFluid* matrix_fluid,
              const BuoyantFractures* fractures, const MatrixTemperature* rock,
              const FractureTemperature* water) const {
    const auto refused = [&](const std::string& problem, const std::string& why, const std::string& remedy) {
      return InputError(context.origin, "coupler " + name() + ": " + problem, why, remedy);
    };
    if (matrix_fluid && !matrix)
      throw refused("the fluid of the matrix has no weight", "its pressure is prescribed, and nothing flows",
                    "take it out of 'between'");
    if (!matrix && !fractures)
      throw refused("there is no flow", "it needs the flow of the matrix, of the fractures, or of both",
                    "name them in 'between'");
    if ((matrix && !matrix->has_gravity()) || (fractures && !fractures->has_gravity()))
      throw refused(std::string("the flow in the ") + (matrix && !matrix->has_gravity() ? "rock" : "fractures") +
                        " has no gravity",
                    "a density matters by its weight alone", "give 'gravity' in 'materials:', or remove the coupler");
    if (options_.has_expansion && ((matrix && !rock) || (fractures && !water)))
      throw refused(std::string("there is no temperature in the ") + (matrix && !rock ? "rock" : "fractures"),
                    "the density is to follow it",
                    std::string("name a component of the kind ") + (matrix && !rock ? "matrix_heat" : "fracture_heat") +
                        " in 'between'");
    const std::string left_out = matrix ? context.left_out<FractureFluid>() : context.left_out<BuoyantMatrix>();
    if (!(matrix && fractures) && !left_out.empty())
      throw refused("the density of '" + left_out + "' would stay constant",
                    "fluid at rest would have different pressures in rock and fractures",
                    "name '" + left_out + "', and the temperature there, in 'between'");
  }

  void check_range(const DensityIn& place) const {
    const Field* temperature = place.temperature();
    const Vector density = place.values(FluidDensity::State::accepted);
    for (int i = 0; i < density.size(); ++i) {
      if (options_.law == "water") {
        const double t = temperature->accepted()[i] - ice_point;
        if (!(t >= coldest && t <= hottest))
          throw DataError(InputError(origin_,
                                     fmt::format("{} is {:.6g} K, beyond the law for the density of water",
                                                 temperature->name(), temperature->accepted()[i]),
                                     fmt::format("it holds from {} to {} K", coldest + ice_point, hottest + ice_point),
                                     "give temperatures in K from absolute zero, or another law")
                              .what());
      }
      if (!(density[i] > 0))
        throw DataError(InputError(origin_, fmt::format("the density of the fluid is {:.4g} kg/m^3", density[i]),
                                   temperature ? fmt::format("{} is {:.6g} K and {} {:.6g} Pa", temperature->name(),
                                                             temperature->accepted()[i], place.pressure().name(),
                                                             place.pressure().accepted()[i])
                                               : fmt::format("{} is {:.6g} Pa", place.pressure().name(),
                                                             place.pressure().accepted()[i]),
                                   "give the temperature and the pressure to which 'fluid_density' belongs, or 'law: "
                                   "exponential'")
                            .what());
    }
  }

  const Mesh& mesh_;
  const BuoyancyOptions options_;
  Origin origin_;
  std::unique_ptr<DensityIn> in_rock_, in_fractures_;
};

const RegisterCoupler<Buoyancy, BuoyancyOptions> registration("buoyancy");

}  // namespace
}  // namespace sprekk::couplers
