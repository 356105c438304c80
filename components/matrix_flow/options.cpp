#include <algorithm>

#include "components/capabilities/fluid_options.hpp"
#include "components/capabilities/state_of_cells.hpp"
#include "components/matrix_flow/matrix_flow.hpp"
#include "framework/field/units_of_amounts.hpp"

namespace sprekk::matrix_flow {

namespace {

/// A leaky side has an outer pressure, and something that stands between.
void check_leak(const SideCondition& side, const Node& node) {
  for (const char* leaky : {"outer_pressure", "conductance"})
    for (const char* given : {"pressure", "flux"})
      if (node.find(leaky) && node.find(given))
        throw InputError(node.find(leaky)->origin,
                         "'" + std::string(leaky) + "' contradicts '" + given + "' at '" + node.path + "'",
                         std::string(given) == "pressure"
                             ? "the pressure of a leaky side follows from what passes it, and is not given"
                             : "what passes a leaky side follows from its pressure, and is not given",
                         "remove one of them");
  if (side.only_out && !side.outer_pressure)
    throw InputError(node.find("only_out")->origin, "'only_out' lacks the pressure above which fluid leaves",
                     "it is the pressure outside", "add 'outer_pressure', as '0 Pa' in air");
  if (side.conductance && !side.outer_pressure)
    throw InputError(node.find("conductance")->origin, "'conductance' lacks the pressure outside",
                     "fluid leaks by the difference of two pressures", "add 'outer_pressure'");
  if (side.outer_pressure && !side.conductance && !side.only_out)
    throw InputError(node.find("outer_pressure")->origin, "nothing stands between the rock and its 'outer_pressure'",
                     "the side would have this pressure", "add a 'conductance', or write 'pressure' instead");
}

Spec side_spec(SideCondition& side) {
  Spec inner("boundary condition of flow",
             "A pressure, a flux, or an outer pressure behind what resists; none lets no fluid through.");
  inner.data("pressure", side.pressure, {.unit = "Pa", .doc = "Pressure on this side.", .in_time = true});
  inner.data("flux", side.flux,
             {.unit = "m/s", .doc = "Flux out of the rock, per area of this side.", .in_time = true});
  inner.data("outer_pressure", side.outer_pressure,
             {.unit = "Pa",
              .doc = "Pressure behind a leaky side; with `conductance`, with `only_out`, or with both.",
              .in_time = true});
  inner.data("conductance", side.conductance,
             {.unit = "m/(Pa*s)",
              .range = non_negative(),
              .doc = "Flux out of the rock, per area of this side and per difference of the pressures of rock and "
                     "`outer_pressure`: permeability over viscosity and thickness of a layer in front of it.",
              .source = "Darcy's law across the layer",
              .in_time = true});
  inner.flag("only_out", side.only_out,
             {.doc = "Fluid leaves through this side where the pressure exceeds `outer_pressure`, and none enters: a "
                     "seepage face.",
              .source = "Signorini's condition; Bear (1972), sec. 7.1"});
  inner.check([&side](const Node& node) {
    if (node.find("pressure") && node.find("flux"))
      throw InputError(node.origin, "contradictory boundary condition at '" + node.path + "'",
                       "a side has either a pressure or a flux", "remove one of them");
    check_leak(side, node);
  });
  return inner;
}

Spec well_spec(Well& well) {
  Spec inner("well", "A point or a line that injects (or with a negative rate extracts) fluid.");
  inner.point("at", well.at, {.unit = "m", .doc = "Position."});
  inner.points("points", well.points,
               {.unit = "m", .doc = "Instead of `at`: corners of a line, along which the rate is spread evenly."});
  inner.data("rate", well.rate,
             {.unit = volume_rate_unit,
              .doc = "Volume of fluid per time and metre of depth.",
              .required = true,
              .in_time = true});
  inner.check([&well](const Node& node) {
    if (well.at ? !well.points.empty() : well.points.size() < 2)
      throw InputError(node.origin, "'" + node.path + "' does not say where the well is",
                       "it is at one place, 'at', or along a line of two 'points' or more", "give one of them");
    if (const auto same = std::ranges::adjacent_find(well.points); same != well.points.end())
      throw InputError(node.find("points")->origin,
                       "two 'points' of '" + node.path + "' that follow one another are the same",
                       "both are at " + to_text(*same), "remove one of them, or write 'at' for a well at one place");
    require_one_place(well.rate, "the rate of '" + node.path + "'", "it is that of the whole well",
                      node.find("rate")->origin);
  });
  return inner;
}

}  // namespace

void Options::declare_storage(Spec& spec) {
  spec.data("storage", storage,
            {.unit = "1/Pa",
             .range = non_negative(),
             .doc = "Specific storage as a whole; else it is porosity times fluid compressibility, completed by the "
                    "compressibility of the grains when the rock is poroelastic.",
             .source = "M below the paper's Eq. 7",
             .in_time = true});
  usually(spec, "storage", usual_storage());
  spec.data(
      "porosity", porosity,
      {.range = between(0, 1), .doc = "Porosity.", .source = "the paper's Table 1", .material = true, .in_time = true});
  usually(spec, "porosity", usual_porosity());
  declare_compressibility(spec, fluid_compressibility, "the paper's Table 1", false);
}

Spec Options::spec(const std::string& type, const std::string& doc, bool takes_formulas) {
  Spec spec(type, doc);
  spec.ignore("type");
  if (takes_formulas) {
    history.declare(spec, rock_variables());
    for (const char* parameter : {"permeability", "porosity", "storage"})
      may_be_formula(type, parameter, rock_variables());
  }
  spec.tensor("permeability", permeability,
              {.unit = "m^2",
               .range = non_negative(),
               .doc = "Permeability of the rock; positive definite, or zero everywhere: then no fluid flows in it.",
               .source = "the paper's Eq. 6",
               .required = true,
               .material = true,
               .in_time = true});
  usually(spec, "permeability", usual_permeability());
  declare_viscosity(spec, viscosity, "the paper's Eq. 6");
  declare_storage(spec);
  declare_gravity(spec, gravity);
  spec.quantity("fluid_density", fluid_density,
                {.unit = "kg/m^3",
                 .range = non_negative(),
                 .doc = "Density of the fluid; matters with gravity only.",
                 .material = true});
  usually(spec, "fluid_density", usual_fluid_density());
  spec.data("initial_pressure", initial_pressure,
            {.unit = "Pa", .doc = "Pressure at the start.", .fixed = "it is what the run starts from"});
  spec.data("source", source,
            {.unit = "1/s",
             .doc = "Volume of fluid added per volume of rock and time.",
             .source = "q of the paper's Eq. 6",
             .in_time = true});
  spec.texts(
      "regions", regions,
      {.doc = "Regions in which there is a flow; everywhere by default. Nothing passes to other rock, whose pores "
              "count as dry: neither is it loaded by a pressure, nor does it store fluid."});
  static SideCondition example_side;
  spec.named_sections(
      "boundary", side_spec(example_side),
      [this](const std::string& key, const Origin& origin) {
        boundary[key].origin = origin;
        return side_spec(boundary[key]);
      },
      {.doc = "Conditions by the name of the side (left, right, bottom, top, or of the imported mesh)."});
  static Well example_well;
  spec.named_sections("wells", well_spec(example_well),
                      [this](const std::string& key, const Origin& origin) {
                        wells[key].origin = origin;
                        return well_spec(wells[key]);
                      },
                      {.doc = "Point sources by name."});
  spec.check([this](const Node& node) {
    if (const Node* given = node.find("regions")) regions_origin = given->origin;
    check_gravity(gravity, node);
    for (const char* key : {"porosity", "fluid_compressibility"})
      if (storage && node.find(key)) without_effect[key] = "'storage' is given as a whole";
    if (!storage && (!porosity || !fluid_compressibility))
      throw InputError(node.origin, "the storage of '" + node.path + "' is not determined",
                       "it is 'storage', or 'porosity' times 'fluid_compressibility'",
                       "give these in the component or in 'materials:'");
  });
  return spec;
}

}  // namespace sprekk::matrix_flow
