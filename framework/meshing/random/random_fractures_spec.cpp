#include "framework/meshing/random/random_fractures_spec.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>

#include "framework/meshing/random/random_laws.hpp"

namespace sprekk {
namespace {

/// Of the shortest length: gaps that a mesh of a few cells for each fracture resolves.
constexpr double default_gap = 0.05;
/// Degrees. Beside crossings below it a mesh has angles below the 20 degrees that it has elsewhere.
constexpr double default_angle = 20;
/// Above it, directions are equal to a 1000th of a radian, and the method of drawing loses digits.
constexpr double most_concentrated = 1e6;

struct LengthInput {
  std::string law = "constant";
  std::optional<double> value, exponent, median, deviation, from, to;
};

void require(const Node& whole, const LengthInput& input) {
  using Names = std::vector<std::string>;
  const Names needed = input.law == "constant" ? Names{"value"}
                       : input.law == "power"  ? Names{"exponent", "from", "to"}
                                               : Names{"median", "deviation", "from", "to"};
  for (const std::string& name : needed)
    if (!whole.find(name))
      throw InputError(whole.origin, "the law of the lengths has no '" + name + "'",
                       "the law " + input.law + " needs it", "add " + name + ": …");
  for (const std::string& key : whole.keys())
    if (key != "law" && std::find(needed.begin(), needed.end(), key) == needed.end())
      throw InputError(whole.find(key)->origin, "the law of the lengths has no use for '" + key + "'",
                       "it is the law " + input.law, "remove it, or choose another law");
}

Spec length_spec(const std::shared_ptr<LengthInput>& input, LengthLaw& law) {
  Spec spec("length", "The law of the lengths.");
  spec.choice("law", input->law,
              {{"constant", "all alike: value"},
               {"power", "a density ~ length^(-exponent) between from and to"},
               {"lognormal",
                "the logarithm is normal, with its median and deviation, cut to what lies between from "
                "and to"}},
              {.doc = "Which law."});
  const auto length = [&spec](const std::string& name, std::optional<double>& target, const std::string& doc) {
    spec.quantity(name, target, {.unit = "m", .range = positive(), .doc = doc});
  };
  length("value", input->value, "The length of all of them (constant).");
  spec.quantity("exponent", input->exponent,
                {.unit = "", .range = between(0, 10), .doc = "The exponent of the density (power)."});
  length("median", input->median, "Half of all are shorter before they are cut (lognormal).");
  spec.quantity("deviation", input->deviation,
                {.unit = "",
                 .range = Range{0, 5, false, true},
                 .doc = "The standard deviation of the natural logarithm before lengths are cut (lognormal)."});
  length("from", input->from, "The shortest (power, lognormal).");
  length("to", input->to, "The longest (power, lognormal).");
  spec.check([input, &law](const Node& whole) {
    require(whole, *input);
    if (input->law == "constant") {
      law = {.value = *input->value, .shortest = *input->value, .longest = *input->value};
      return;
    }
    if (*input->from >= *input->to)
      throw InputError(whole.find("to")->origin, "the longest fracture is not longer than the shortest",
                       fmt::format("they have {:.4g} and {:.4g} m", *input->to, *input->from), "raise 'to'");
    law.shortest = *input->from;
    law.longest = *input->to;
    if (input->law == "power") {
      law.kind = LengthLaw::Kind::power;
      law.exponent = *input->exponent;
      return;
    }
    law.kind = LengthLaw::Kind::lognormal;
    law.median = *input->median;
    law.deviation = *input->deviation;
    constexpr double hardly_any = 1e-3;  // of a law of lengths: bounds that keep less are a mistake
    const double share = lognormal_share(law.longest, law.median, law.deviation) -
                         lognormal_share(law.shortest, law.median, law.deviation);
    if (share < hardly_any)
      throw InputError(whole.origin, "the lengths that 'from' and 'to' keep are hardly any of the law",
                       fmt::format("they are a share of {:.1e}", share), "move them towards the median");
  });
  return spec;
}

Spec orientation_in_space(RandomFractures& set) {
  Spec spec("orientation", "Fisher's law of the normals; without it all directions are alike.");
  spec.quantity("strike", set.mean_strike,
                {.unit = "rad", .doc = "The strike of the mean plane, clockwise from north (y).", .required = true});
  spec.quantity("dip", set.mean_dip,
                {.unit = "rad",
                 .range = between(0, std::numbers::pi / 2),
                 .doc = "The dip of the mean plane, to the right of its strike.",
                 .required = true});
  spec.quantity("concentration", set.concentration,
                {.unit = "",
                 .range = between(0, most_concentrated),
                 .doc = "The parameter kappa: 0 is uniform, and large values scatter by sqrt(2/kappa) rad.",
                 .source = "Fisher (1953)",
                 .required = true});
  return spec;
}

Spec orientation_spec(RandomFractures& set) {
  if (dimension == 3) return orientation_in_space(set);
  Spec spec("orientation", "Von Mises' law of the directions; without it all directions are alike.");
  spec.quantity("mean", set.mean_angle,
                {.unit = "rad",
                 .doc = "The mean direction, counter-clockwise from the x axis; a fracture has no sense, so that 180 "
                        "degrees more is the same.",
                 .required = true});
  spec.quantity("concentration", set.concentration,
                {.unit = "",
                 .range = between(0, most_concentrated),
                 .doc = "The parameter kappa: 0 is uniform, and large values scatter by 1/sqrt(kappa) rad.",
                 .source = "Best and Fisher (1979)",
                 .required = true});
  return spec;
}

using RegionInput = std::array<std::vector<double>, dimension>;

Spec region_spec(const std::shared_ptr<RegionInput>& input, RandomFractures& set) {
  Spec spec("region", dimension == 2 ? "A rectangle for the middles of the fractures; by default the box."
                                     : "A box for the middles of the fractures; by default the whole box.");
  for (int axis = 0; axis < dimension; ++axis) {
    const std::string key(1, "xyz"[axis]);
    spec.quantities(key, (*input)[axis],
                    {.unit = "m", .doc = "Where it begins and ends along " + key + ".", .required = true});
  }
  spec.check([input, &set](const Node& whole) {
    Box region;
    region.origin = whole.origin;
    for (int axis = 0; axis < dimension; ++axis) {
      const std::string key(1, "xyz"[axis]);
      const std::vector<double>& ends = (*input)[axis];
      if (ends.size() != 2 || !(ends[0] < ends[1]))
        throw InputError(whole.find(key)->origin, "the region needs two growing values along " + key,
                         std::to_string(ends.size()) + " are given, or they do not grow",
                         "write " + key + ": [0 m, 1 m]");
      region.low[axis] = ends[0];
      region.high[axis] = ends[1];
    }
    set.region = region;
  });
  return spec;
}

}  // namespace

Spec random_fractures_spec(RandomFractures& set) {
  struct Input {
    std::optional<double> number, gap;
    bool has_orientation = false, has_region = false;
  };
  const auto input = std::make_shared<Input>();
  Spec spec("random", std::string(dimension == 2 ? "Straight fractures" : "Square fractures") +
                          " drawn at random, the same on every machine; 'sprekk fractures' prints them as a table.");
  spec.quantity("number", input->number, {.unit = "", .range = between(1, most_random_fractures), .doc = "How many."});
  spec.quantity(
      "density", set.density,
      {.unit = dimension == 2 ? "1/m^2" : "1/m^3",
       .range = positive(),
       .doc = std::string("How many for each ") +
              (dimension == 2 ? "area of the region (P20)" : "volume of the region (P30)") + ", instead of number."});
  spec.quantity("intensity", set.intensity,
                {.unit = "1/m",
                 .range = positive(),
                 .doc = std::string(dimension == 2 ? "Their length for each area of the region (P21)"
                                                   : "Their area for each volume of the region (P32)") +
                        ", to half of the last one, instead of number."});
  spec.section("length", length_spec(std::make_shared<LengthInput>(), set.length),
               {.doc = "How long.", .required = true});
  spec.section("orientation", orientation_spec(set), {.doc = "Which way."}, &input->has_orientation);
  spec.section("region", region_spec(std::make_shared<RegionInput>(), set),
               {.doc = "Where their middles lie; the fractures themselves lie in the box."}, &input->has_region);
  spec.integer("seed", set.seed, {.doc = "Which set. Sets of different names differ for one seed, too."});
  set.least_angle = default_angle * std::numbers::pi / 180;
  spec.quantity("angle", set.least_angle,
                {.unit = "rad",
                 .range = Range{0, std::numbers::pi / 2, true, false},
                 .doc = "Fractures cross others at this angle or more."});
  spec.quantity("gap", input->gap,
                {.unit = "m",
                 .range = non_negative(),
                 .doc = "The least distance between an end and another fracture, a side or an edge of a region, and "
                        "between two crossings; by default a 20th of the shortest length."});
  spec.check([input, &set](const Node& whole) {
    const int given = (input->number ? 1 : 0) + (set.density ? 1 : 0) + (set.intensity ? 1 : 0);
    if (given != 1)
      throw InputError(whole.origin, "the random set '" + set.name + "' needs one of number, density and intensity",
                       fmt::format("it has {} of them", given), "write number: 30");
    if (input->number) {
      if (*input->number != std::floor(*input->number))
        throw InputError(whole.find("number")->origin, "the number of fractures is not whole",
                         fmt::format("it is {:g}", *input->number), "write number: 30");
      set.number = static_cast<int>(*input->number);
    }
    set.least_gap = input->gap.value_or(default_gap * set.length.shortest);
  });
  return spec;
}

}  // namespace sprekk
