#include "components/wells/options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "components/capabilities/one_place.hpp"
#include "framework/field/units_of_amounts.hpp"

namespace sprekk::wells {
namespace {

void add_place(Spec& spec, Perforation& place) {
  spec.point("at", place.at, {.unit = "m", .doc = "Where the well is open."});
  if constexpr (dimension == 3)
    spec.points("points", place.points,
                {.unit = "m", .doc = "Instead of `at`: corners of a line along which it is open to the rock."});
  spec.text("fracture", place.fracture, {.doc = "It is open to this fracture at `at`; without it, to the rock."});
  spec.quantity(
      "index", place.index,
      {.unit = dimension == 2 ? "m^2/(Pa*s)" : "m^3/(Pa*s)",
       .range = positive(),
       .doc =
           dimension == 2
               ? "Rate over difference of pressure to the cells around it. Without it, in rock it follows from the "
                 "mesh, the radius and the skin; in a fracture the well has the pressure at its point."
               : "Rate over difference of pressure to the cells around it, of the whole line. Without it, along lines "
                 "in rock and at points of fractures it follows from the mesh, the radius and the skin."});
}

Spec place_spec(Perforation& place) {
  Spec spec("place", "A place where the well is open.");
  add_place(spec, place);
  return spec;
}

void check_place_in_space(const Perforation& place, const Origin& origin) {
  const bool is_line = !place.points.empty();
  if (is_line == place.at.has_value())
    throw InputError(origin, is_line ? "the well has two places" : "the well has no place",
                     is_line ? "'at' and 'points' are both given" : "'at' and 'points' are missing",
                     is_line ? "write one of them" : "say where it is open, as in 'points: [[x, y, z], [x, y, z]]'");
  if (place.points.size() == 1 || std::ranges::adjacent_find(place.points) != place.points.end())
    throw InputError(origin, "the well is no line", "its 'points' are less than two that differ",
                     "give both ends of the part of the bore hole that is open");
  if (is_line && place.fracture)
    throw InputError(origin, "a line of a well is open to the rock", "'fracture' and 'points' are both given",
                     "give the point at which the well meets the fracture, 'at'");
  if (place.at && !place.fracture && !place.index)
    throw InputError(origin, "the index of a well at a point of the rock is not known",
                     "the pressure at a point has no bound in space", "write a line, 'points', or give its 'index'");
}

void check_place(const Perforation& place, const Origin& origin, bool has_radius) {
  if constexpr (dimension == 3) check_place_in_space(place, origin);
  if (dimension == 2 && !place.at)
    throw InputError(origin, "the well has no place", "'at' is missing", "say where it is open, as in 'at: [x, y]'");
  if (((dimension == 2 && place.fracture) || place.index) && has_radius)
    throw InputError(origin, "'radius' and 'skin' have no effect",
                     place.index ? "the index of the well is given" : "in a fracture they do not count",
                     "remove them, or what replaces them");
}

void check_well(const WellOptions& well, const Node& node) {
  const bool has_limits = well.lowest_pressure || well.highest_pressure;
  if (!well.rate && !well.pressure)
    throw InputError(node.origin, "the well does nothing", "neither 'rate' nor 'pressure' is given",
                     "give its rate, with limits of its pressure, or its pressure");
  if (well.pressure && (well.rate || has_limits))
    throw InputError(node.origin, "'pressure' contradicts the rate and the limits of the well",
                     "the pressure is given, whatever the rate",
                     "write 'rate' with 'highest_pressure' or 'lowest_pressure' for a well that does what binds first");
  for (const auto& [name, data] :
       {std::pair("rate", &well.rate), std::pair("pressure", &well.pressure),
        std::pair("highest_pressure", &well.highest_pressure), std::pair("lowest_pressure", &well.lowest_pressure)})
    if (*data)
      require_one_place(**data, fmt::format("'{}'", name), "it is that of the whole well", node.find(name)->origin);
  if (well.rate && well.rate->is_constant()) {
    const double rate = well.rate->at({});
    if (rate > 0 && well.lowest_pressure && !well.highest_pressure)
      throw InputError(node.origin, "the limit of the well is on the wrong side",
                       "a well that injects raises its pressure, so that 'lowest_pressure' never binds",
                       "write 'highest_pressure', or a negative rate");
    if (rate < 0 && well.highest_pressure && !well.lowest_pressure)
      throw InputError(node.origin, "the limit of the well is on the wrong side",
                       "a well that extracts lowers its pressure, so that 'highest_pressure' never binds",
                       "write 'lowest_pressure', or a positive rate");
  }
  const bool has_radius = node.find("radius") || node.find("skin");
  if (well.places.empty()) return check_place(well.only, node.origin, has_radius);
  if (well.only.at || !well.only.points.empty() || well.only.fracture || well.only.index)
    throw InputError(node.origin, "'places' contradicts 'at', 'fracture' and 'index' of the well",
                     "both say where the well is open", "write them under 'places' alone");
  for (const auto& [name, place] : well.places) check_place(place, place.origin, has_radius && well.places.size() == 1);
}

Spec well_spec(WellOptions& well) {
  Spec spec(
      "well",
      "A well with a rate and limits of its pressure, of which what binds first holds, or with a given pressure.");
  spec.data(
      "rate", well.rate,
      {.unit = volume_rate_unit,
       .doc = dimension == 2
                  ? "Volume of fluid per time and metre of depth that it is to inject, or with a negative rate extract."
                  : "Volume of fluid per time that it is to inject, or with a negative rate extract.",
       .in_time = true});
  spec.data("pressure", well.pressure,
            {.unit = "Pa", .doc = "Its pressure, whatever the rate, in both directions.", .in_time = true});
  spec.data("highest_pressure", well.highest_pressure,
            {.unit = "Pa",
             .doc = "A well that injects keeps to this pressure with a smaller rate, and shuts where the pressure "
                    "around it is higher.",
             .in_time = true});
  spec.data("lowest_pressure", well.lowest_pressure,
            {.unit = "Pa", .doc = "The same for a well that extracts, below.", .in_time = true});
  spec.quantity(
      "radius", well.radius,
      {.unit = "m", .range = positive(), .doc = dimension == 2 ? "Of the bore hole, in rock." : "Of the bore hole."});
  spec.quantity("skin", well.skin,
                {.doc = "Additional resistance of rock at the bore hole: the drop of pressure is (ln(r_e/r_w) + skin) "
                        "rate/(2 pi mobility).",
                 .source = "van Everdingen 1953"});
  add_place(spec, well.only);
  static Perforation example;
  spec.named_sections("places", place_spec(example),
                      [&well](const std::string& key, const Origin& origin) {
                        well.places[key].origin = origin;
                        return place_spec(well.places[key]);
                      },
                      {.doc = "The places by name, of a well with several; they have one pressure."});
  spec.check([&well](const Node& node) { check_well(well, node); });
  return spec;
}

}  // namespace

Spec Options::spec() {
  Spec spec("wells/limited", "Wells with a rate and limits of their pressure, of which what binds first holds.");
  spec.ignore("type");
  static WellOptions example;
  spec.named_sections("wells", well_spec(example),
                      [this](const std::string& key, const Origin& origin) {
                        wells[key].origin = origin;
                        return well_spec(wells[key]);
                      },
                      {.doc = "The wells by name.", .required = true});
  return spec;
}

}  // namespace sprekk::wells
