// Data that vary with depth by a law with a name: {hydrostatic: …}, {lithostatic: …}, {geothermal: …}.
#include <cmath>
#include <memory>
#include <string>

#include "framework/config/data_reader.hpp"
#include "framework/config/expression.hpp"
#include "framework/config/spec.hpp"
#include "framework/round_off.hpp"

namespace sprekk {
namespace {

constexpr double standard_gravity = 9.80665;  // m/s^2 (BIPM, The International System of Units, 2019)

/// The parameters of a profile, and its value at a depth below its datum, m.
struct Profile {
  double datum = 0;            ///< m, of the vertical axis
  bool ends_at_datum = false;  ///< whether it has no value above
  virtual ~Profile() = default;
  virtual Spec spec() = 0;
  virtual double at_depth(double depth) const = 0;
};

void declare_gravity_of_profile(Spec& spec, double& gravity) {
  spec.quantity("gravity", gravity, {.unit = "m/s^2", .range = positive(), .doc = "Acceleration, downwards."});
}

struct Hydrostatic : Profile {
  double density = 0, gravity = standard_gravity, at_table = 0;
  Spec spec() override {
    Spec spec("hydrostatic", "The pressure of water at rest: it grows with the depth below the water table.");
    spec.quantity("water_table", datum, {.unit = "m", .doc = "Its height.", .required = true});
    spec.quantity("fluid_density", density,
                  {.unit = "kg/m^3", .range = positive(), .doc = "Of the water.", .required = true, .material = true});
    spec.quantity("pressure", at_table, {.unit = "Pa", .doc = "At the water table."});
    declare_gravity_of_profile(spec, gravity);
    return spec;
  }
  double at_depth(double depth) const override { return at_table + density * gravity * depth; }
};

struct Lithostatic : Profile {
  double density = 0, gravity = standard_gravity, ratio = 1, at_surface = 0;
  Spec spec() override {
    Spec spec("lithostatic", "The stress by the weight of rock above, compression negative.");
    spec.quantity("surface", datum, {.unit = "m", .doc = "Height of the ground.", .required = true});
    spec.quantity("rock_density", density,
                  {.unit = "kg/m^3",
                   .range = positive(),
                   .doc = "Of the rock with its water.",
                   .required = true,
                   .material = true});
    spec.quantity("ratio", ratio,
                  {.range = non_negative(), .doc = "Of this stress to the vertical one: K_0 of a horizontal one."});
    spec.quantity("stress", at_surface, {.unit = "Pa", .doc = "Vertical stress at the surface, by what lies on it."});
    declare_gravity_of_profile(spec, gravity);
    return spec;
  }
  Lithostatic() { ends_at_datum = true; }
  double at_depth(double depth) const override { return ratio * (at_surface - density * gravity * depth); }
};

struct Geothermal : Profile {
  double at_surface = 0, gradient = 0;
  Spec spec() override {
    Spec spec("geothermal", "A temperature that rises evenly with depth.");
    spec.quantity("surface", datum, {.unit = "m", .doc = "Height of the ground.", .required = true});
    spec.quantity("temperature", at_surface,
                  {.unit = "K", .range = non_negative(), .doc = "At the surface.", .required = true});
    spec.quantity("gradient", gradient, {.unit = "K/m", .doc = "Its rise with depth, 30 K/km.", .required = true});
    return spec;
  }
  double at_depth(double depth) const override { return at_surface + gradient * depth; }
};

/// The profile whose sign a parameter of this name cannot mean.
std::string forbidden_beside(const std::string& name) {
  const auto holds = [&](const char* word) { return name.find(word) != std::string::npos; };
  return holds("stress") || holds("traction") ? "hydrostatic" : holds("pressure") ? "lithostatic" : "";
}

/// Makes {KEY: {…}} a form of data in this SI unit.
template <class Law>
struct RegisterProfile {
  RegisterProfile(const std::string& key, const std::string& unit) {
    data_forms()[key] = [key, unit](const Node& node, const DataRequest& request) {
      require_known_keys(node, {key}, request);
      if (request.about.unit != unit)
        throw InputError(node.origin, "'" + request.name + "' cannot be " + key,
                         "it is no quantity in " + unit + ", which this profile is", "give a number, or an expression");
      if (key == forbidden_beside(request.name))
        throw InputError(node.origin, "'" + request.name + "' cannot be " + key,
                         std::string("that is a ") + (key == "hydrostatic" ? "pressure" : "stress") +
                             "; a fluid presses with a positive pressure, rock with a negative stress",
                         "take " + std::string(key == "hydrostatic" ? "lithostatic" : "hydrostatic") +
                             ", or an expression with the sign that you mean");
      if (request.about.material)
        throw InputError(node.origin, "'" + request.name + "' cannot be " + key, "it is a property of a material",
                         "give a number, or an expression");
      const auto law = std::make_shared<Law>();
      law->spec().read(*node.find(key), request.context);
      const auto value = [law, key, where = node.origin, name = request.name](const Place& place) {
        const double depth = law->datum - place.x[dimension - 1];
        if (law->ends_at_datum && depth < -rounding::same * (1 + std::abs(law->datum)))
          throw DataError(InputError(where, "'" + name + "' has no value at " + place_text(place),
                                     "the place is above the 'surface' of '" + key + "'", "raise 'surface'")
                              .what());
        return law->at_depth(depth);
      };
      return Data(value, false, true);
    };
  }
};

const RegisterProfile<Hydrostatic> hydrostatic("hydrostatic", "Pa");
const RegisterProfile<Lithostatic> lithostatic("lithostatic", "Pa");
const RegisterProfile<Geothermal> geothermal("geothermal", "K");

}  // namespace
}  // namespace sprekk
