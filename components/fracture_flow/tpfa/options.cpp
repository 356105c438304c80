#include "components/fracture_flow/tpfa/options.hpp"

#include <algorithm>
#include <cctype>

#include "components/capabilities/fluid_options.hpp"
#include "components/fracture_flow/laws/formula_law.hpp"
#include "framework/config/data_reader.hpp"
#include "framework/config/state.hpp"
#include "framework/config/unknown_key.hpp"
#include "framework/field/units_of_amounts.hpp"

namespace sprekk::fracture_flow {

namespace {

void add_where(Spec& spec, FracturePlace& where, const std::string& point) {
  spec.text("fracture", where.fracture, {.doc = "Name of the fracture; all fractures without it."});
  spec.point("at", where.at, {.unit = "m", .doc = point + "; without it the whole fracture, but for what grows."});
  if constexpr (dimension == 3) {
    spec.quantity("radius", where.radius,
                  {.unit = "m",
                   .range = positive(),
                   .doc = "With `at`: of the bore hole there. The pressure around a point of a surface has no bound; "
                          "that at this radius does not depend on the mesh.",
                   .source = "Peaceman (1978)"});
    spec.check([&where](const Node& node) {
      if (where.radius && !where.at)
        throw InputError(node.find("radius")->origin, "'radius' is that of a bore hole at a point",
                         "without 'at' it is the whole fracture", "give the point, or remove the radius");
    });
  }
}

Spec injection_spec(Injection& injection) {
  Spec spec("injection", "Fluid injected into a fracture; extracted with a negative rate.");
  add_where(spec, injection.where, "A point of a fracture; the cells whose centres are around it share the rate");
  spec.data("rate", injection.rate,
            {.unit = volume_rate_unit,
             .doc = "Volume of fluid per time and metre of depth, in all.",
             .source = "q_i of the paper's Eq. 8",
             .required = true,
             .in_time = true});
  return spec;
}

Spec prescribed_spec(PrescribedPressure& prescribed) {
  Spec spec("prescribed pressure", "A point or a whole fracture whose pressure is given.");
  add_where(spec, prescribed.where, "At the point of a fracture that is nearest to this one");
  spec.data("pressure", prescribed.pressure, {.unit = "Pa", .doc = "The pressure.", .required = true, .in_time = true});
  return spec;
}

/// Whether the transmissivity does not follow from the aperture, which may then be the width of a zone of fractures.
bool conducts_as_given(const Node& map) {
  const Node *given = map.find("transmissivity"), *law = map.find("law");
  const Node* type = law && law->is_map() ? law->find("type") : given;
  return type && type->scalar == "constant";
}

Spec side_spec(EndCondition& end) {
  Spec spec("boundary condition of flow in fractures",
            "For fractures that end on this side: one of pressure, outer_pressure, as_rock and closed.");
  spec.data("pressure", end.pressure,
            {.unit = "Pa", .doc = "Pressure where fractures meet this side.", .in_time = true});
  spec.data(
      "outer_pressure", end.outer_pressure,
      {.unit = "Pa",
       .doc = "Pressure behind an end that resists or lets out only; with `conductance`, with `only_out`, or with "
              "both.",
       .in_time = true});
  spec.data("conductance", end.conductance,
            {.unit = "m/(Pa*s)",
             .range = non_negative(),
             .doc = "Flux out of fractures, per area of their end (aperture times width) and per difference of the "
                    "pressures there and outside.",
             .source = "Darcy's law across a layer",
             .in_time = true});
  spec.flag("only_out", end.only_out,
            {.doc = "Fluid leaves where the pressure exceeds `outer_pressure`, and none enters."});
  spec.flag("as_rock", end.is_as_rock,
            {.doc = "What holds for the flow in the rock on this side holds at the end of fractures: its pressure, or "
                    "its outer pressure, conductance and only_out. Where the rock has neither, the end is closed."});
  spec.flag("closed", end.is_closed, {.doc = "Nothing flows out of fractures here, also where the rock is open."});
  spec.check([&end](const Node& node) {
    const int said = end.pressure.has_value() + end.outer_pressure.has_value() + end.is_as_rock + end.is_closed;
    if (said != 1)
      throw InputError(node.origin,
                       said == 0 ? "'" + node.path + "' does not say whether fractures are open there"
                                 : "'" + node.path + "' contradicts itself",
                       "it is one of 'pressure', 'outer_pressure', 'as_rock: true' and 'closed: true'",
                       "give one of them");
    const bool resists = end.conductance || end.only_out;
    if (resists && !end.outer_pressure)
      throw InputError(node.find(end.conductance ? "conductance" : "only_out")->origin,
                       "'" + node.path + "' lacks the pressure outside",
                       "fluid leaks by the difference of two pressures", "add 'outer_pressure'");
    if (end.outer_pressure && !resists)
      throw InputError(node.find("outer_pressure")->origin,
                       "nothing stands between fractures and their 'outer_pressure'",
                       "their ends would have this pressure",
                       "add a 'conductance' or 'only_out: true', or write 'pressure' instead");
  });
  return spec;
}

}  // namespace

void Options::declare_fluid(Spec& spec) {
  declare_viscosity(spec, viscosity, "the paper's Eq. 8");
  declare_compressibility(spec, fluid_compressibility, "c_p of the paper's Eq. 8", true);
}

void Options::declare_grown(Spec& spec) {
  Spec grown("grown", "What the cells of a fracture that grows start with.");
  grown.quantity("aperture", grown_aperture,
                 {.unit = "m",
                  .range = non_negative(),
                  .doc = "Initial aperture of cells that have grown; opening adds to it. It has a volume; see `law` "
                         "for one that conducts only.",
                  .source = "a0 of a_i = a0 + [u]_n, below the paper's Eq. 8"});
  grown.choice("fluid", grown_fluid,
               {{"drawn", "they are empty, and draw their fluid from what is around them"},
                {"filled", "they are full, at the pressure of the cell that they continue"}},
               {.doc = "The fluid in it at the moment of growth."});
  spec.section("grown", grown, {.doc = "What the cells of a fracture that grows start with."});
}

void Options::declare_conduction(Spec& spec) {
  spec.text("transmissivity", transmissivity,
            {.doc = "How the tangential transmissivity K_i follows from the aperture: cubic_law, a^3/12; constant, the "
                    "value given as transmissivity_value; or a formula in m^3.",
             .source = "below the paper's Eq. 8"});
  may_be_formula(spec.name(), "transmissivity", conduction_variables());
  spec.data(
      "transmissivity_value", transmissivity_value,
      {.unit = "m^3", .range = non_negative(), .doc = "The transmissivity, where it is constant.", .in_time = true});
  usually(spec, "transmissivity_value", usual_transmissivity());
  spec.section("law", law.spec(), {.doc = "How well the fracture conducts, instead of transmissivity."}, &has_law);
  spec.choice("normal_permeability", normal_permeability,
              {{"cubic_law", "2 K_i/(mu a^2), which with the cubic law is a/(6 mu)"},
               {"constant", "the value given as normal_permeability_value"}},
              {.doc = "How kappa follows from the aperture.", .source = "below the paper's Eq. 9"});
  spec.data("normal_permeability_value", normal_permeability_value,
            {.unit = "m/(Pa*s)",
             .range = non_negative(),
             .doc = "The normal permeability, where it is constant.",
             .in_time = true});
  Spec walls("wall_permeability",
             "Walls of different normal permeability, as by a filter cake or a skin on one of them.");
  const auto wall = [&](const char* key, std::optional<Data>& value, const std::string& which) {
    walls.data(key, value,
               {.unit = "m/(Pa*s)",
                .range = non_negative(),
                .doc = "Of the wall on the " + which + "; without it, it is that of normal_permeability.",
                .in_time = true});
  };
  if constexpr (dimension == 2) {
    const std::string seen = " as one looks from the first to the last point of the fracture";
    wall("left", wall_permeability[0], "left" + seen);
    wall("right", wall_permeability[1], "right" + seen);
  } else {
    wall("plus", wall_permeability[0], "side from which the points of the fracture turn clockwise");
    wall("minus", wall_permeability[1], "other side");
  }
  spec.section("wall_permeability", walls, {.doc = "The normal permeability kappa of single walls."});
}

void Options::declare_places(Spec& spec) {
  static Injection example_injection;
  spec.named_sections("injection", injection_spec(example_injection),
                      [this](const std::string& key, const Origin& origin) {
                        injections[key].where.origin = origin;
                        return injection_spec(injections[key]);
                      },
                      {.doc = "Injections by name."});
  static PrescribedPressure example_prescribed;
  spec.named_sections("prescribed", prescribed_spec(example_prescribed),
                      [this](const std::string& key, const Origin& origin) {
                        prescribed[key].where.origin = origin;
                        return prescribed_spec(prescribed[key]);
                      },
                      {.doc = "Prescribed pressures by name."});
  static EndCondition example_end;
  spec.named_sections("boundary", side_spec(example_end),
                      [this](const std::string& key, const Origin& origin) {
                        boundary_origins[key] = origin;
                        return side_spec(ends[key]);
                      },
                      {.doc = "Where fractures end on a side; else no fluid flows out there."});
}

/// Reads the transmissivity where it is none of the two words.
void Options::read_transmissivity(const Node& node) {
  if (transmissivity == "cubic_law" || transmissivity == "constant") return;
  const Node* given = node.find("transmissivity");
  const bool is_name =
      std::ranges::all_of(transmissivity, [](unsigned char c) { return std::isalpha(c) != 0 || c == '_'; });
  if (is_name && transmissivity != "a")
    throw unknown_name(given->origin, "value of 'transmissivity':", transmissivity, {"cubic_law", "constant"});
  const StateVariables& variables = *with_declared(&conduction_variables());
  const ReadsFormula formula(&variables);
  const About about{.unit = "m^3", .range = non_negative(), .in_time = true};
  const Data data = read_data(*given, {"transmissivity", about, {}});
  if (!data.is_constant() && variables_named(data, {}, variables) != 0) {
    transmissivity_formula = data;
  } else {
    transmissivity = "constant";
    transmissivity_value = data;
  }
}

void Options::check(const Node& node) {
  check_gravity(gravity, node);
  read_transmissivity(node);
  if (const Origin* through = crossings.find_through(); through && !is_constant() && !has_given_walls())
    throw InputError(*through, "nothing fills the crossing in which a fracture is to go through",
                     "the transmissivity follows from the aperture, so that all fractures are open",
                     "give the walls of the fracture a 'normal_permeability_value', or give the crossing a "
                     "'permeability'");
  if (const Node* given = node.find("fractures")) fractures_origin = given->origin;
  for (const char* key : {"transmissivity", "transmissivity_value"})
    if (has_law && node.find(key) && !node.find(key)->is_null())
      throw InputError(node.find(key)->origin, std::string("'") + key + "' contradicts 'law'",
                       "both say how the fracture conducts", "remove one of them");
  if (cavitation && !gravity.is_zero())
    throw InputError(node.find("cavitation")->origin, "'cavitation' does not go with gravity",
                     "fluid would run down in a fracture that is partly empty, which is not modelled",
                     "remove one of the two");
  if (!has_law && transmissivity == "constant" && !transmissivity_value)
    throw InputError(node.origin, "'transmissivity_value' is missing", "the transmissivity is constant",
                     "give it in m^3");
  if (normal_permeability == "constant" && !normal_permeability_value)
    throw InputError(node.origin, "'normal_permeability_value' is missing", "the normal permeability is constant",
                     "give it in m/(Pa*s)");
}

Spec Options::spec() {
  return spec("fracture_flow/tpfa", dimension == 2
                                        ? "Flow in fractures (the paper's Eq. 8): two-point flux approximation along "
                                          "piecewise linear fractures."
                                        : "Flow in fractures (the paper's Eq. 8): two-point flux approximation. It is "
                                          "exact for linear pressures in rectangles alone; see fracture_flow/mfd.");
}

Spec Options::spec(const std::string& type, const std::string& doc) {
  write_instead(type, "wells",
                "give an 'injection' here for a rate and 'prescribed' for a pressure, or add a component wells/limited "
                "for wells with limits");
  Spec spec(type, doc);
  spec.ignore("type");
  history.declare(spec, conduction_variables());
  declare_fluid(spec);
  spec.data("initial_aperture", initial_aperture,
            {.unit = "m",
             .range = positive(),
             .doc = "Aperture of the undeformed fracture.",
             .source = "a^0 below the paper's Eq. 8",
             .required = true,
             .fixed = "it is what the run starts from, and what opens adds to it"});
  usually(spec, "initial_aperture", usual_aperture());
  usually(spec, "initial_aperture", usual_zone_width(), conducts_as_given);
  spec.data("initial_pressure", initial_pressure,
            {.unit = "Pa", .doc = "Pressure at the start.", .fixed = "it is what the run starts from"});
  declare_grown(spec);
  spec.quantity("aperture_floor", aperture_floor,
                {.unit = "m", .range = positive(), .doc = "The hydraulic aperture does not fall below this."});
  declare_conduction(spec);
  spec.quantity(
      "cavitation", cavitation,
      {.unit = "Pa",
       .doc = "The pressure does not fall below this: where fluid cannot follow, a part of the fracture stays empty. "
              "Pressures count from the same zero as everywhere in the scene. Without it the pressure has no bound, "
              "and a note tells of suction.",
       .source = "Elrod and Adams (1974); Peirce and Detournay (2008) for the lag of a fracture"});
  declare_gravity(spec, gravity);
  spec.quantity("fluid_density", fluid_density,
                {.unit = "kg/m^3",
                 .range = non_negative(),
                 .doc = "Density of the fluid; matters with gravity, and with the inertia of `law`, only.",
                 .material = true});
  usually(spec, "fluid_density", usual_fluid_density());
  spec.texts("fractures", fractures,
             {.doc = "Fractures in which there is a flow, `joints_*` for all that begin so; all by default. The others "
                     "are dry: nothing flows in them or "
                     "passes through their walls, and no pressure pushes them open."});
  declare_places(spec);
  crossings.declare(spec, "permeability",
                    {.unit = "m^2",
                     .range = non_negative(),
                     .doc = "Permeability of what fills the crossing; 0 seals it. By default it is the harmonic mean "
                            "of K_i/a of the fractures that meet, where their transmissivities are given, and the "
                            "crossing is open where they follow from apertures.",
                     .source = "Flemisch and others (2018), sec. 4.3"});
  spec.check([this](const Node& node) { check(node); });
  return spec;
}

}  // namespace sprekk::fracture_flow
