#include "components/outside/options.hpp"

#include <cstdlib>

#include "framework/config/unit.hpp"
#include "framework/config/units.hpp"

namespace sprekk::outside {

namespace {

/// A number with any unit, in SI units.
double in_si(const Node& node, const std::string& name) {
  const std::string& text = node.scalar;
  if (node.is_scalar()) {
    char* end = nullptr;
    const double number = std::strtod(text.c_str(), &end);
    const std::string unit = text.substr(text.find_first_not_of(' ', end - text.c_str()) == std::string::npos
                                             ? text.size()
                                             : text.find_first_not_of(' ', end - text.c_str()));
    if (end != text.c_str() && is_unit(unit)) return number * parse_unit(unit).scale;
  }
  throw InputError(node.origin, "the parameter " + quoted(name) + " is no number with a unit",
                   "the program is given its value in SI units", "write for example '1e-16 m^2', or a plain number");
}

}  // namespace

Location GivenOptions::location() const {
  if (on == "nodes") return Location::node;
  return on == "fracture_cells" ? Location::fracture_cell : Location::cell;
}

Spec GivenOptions::spec() {
  Spec spec("given", "A field that the program determines.");
  spec.choice("on", on,
              {{"cells", "a value for each cell of the rock"},
               {"nodes", "for each node of the rock"},
               {"fracture_cells", "for each cell of the fractures"}},
              {.doc = "Where it has values."});
  spec.integer("per_place", components,
               {.range = between(1, 9), .doc = "Numbers in each place: 2 for a vector in a plane."});
  spec.text("unit", unit, {.doc = "SI unit; empty for a plain number.", .required = true});
  spec.text("initial", initial,
            {.doc = "Value at the start: a number with its unit, or an expression of the place.", .required = true});
  spec.choice("as", as,
              {{"field", "a field that others know by its name only: probes, outputs and other programs"},
               {"rock_pressure",
                "the pressure of the fluid in the rock, for couplers: they give the program what "
                "they add to the balance of each cell"},
               {"rock_temperature", "the temperature of the rock, for couplers"},
               {"aperture", "the aperture of fractures, for the coupler given_aperture"},
               {"friction_factor", "a factor of friction on fractures, for the coupler given_friction"}},
              {.doc = "What it is for others."});
  spec.check([this](const Node& node) {
    initial_origin = node.find("initial")->origin;
    const Origin of_unit = node.find("unit")->origin;
    if (!is_unit(unit) || parse_unit(unit).scale != 1)
      throw InputError(of_unit, quoted(unit) + " is no SI unit", "the program gives its values in SI units",
                       "write for example 'Pa', 'm/s' or ''");
    const std::string needed = as == "rock_pressure"      ? "Pa"
                               : as == "rock_temperature" ? "K"
                               : as == "aperture"         ? "m"
                               : as == "friction_factor"  ? ""
                                                          : unit;
    const std::string home = as.starts_with("rock") ? "cells" : as == "field" ? on : "fracture_cells";
    if (unit != needed || on != home || (as != "field" && components != 1))
      throw InputError(node.origin, quoted(as) + " is one number a cell, in other units or elsewhere",
                       "it is what couplers ask for",
                       "write 'on: " + home + "' and 'unit: " + yaml_scalar(needed) + "'");
    start = parse_data(initial, unit, initial_origin, "initial");
  });
  return spec;
}

Spec Options::spec() {
  Spec spec("outside/program",
            "Another program, which the user starts by --program NAME=COMMAND, determines fields: it is told the "
            "mesh, and before each of its solves the fields of others. It is alone in its 'solve'.");
  spec.ignore("type");
  static GivenOptions example;
  spec.named_sections("gives", example.spec(),
                      [this](const std::string& key, const Origin& origin) {
                        gives[key].origin = origin;
                        return gives[key].spec();
                      },
                      {.doc = "The fields that the program determines, by name.", .required = true});
  spec.texts("takes", takes, {.doc = "Fields of the scene that the program is told, by their whole names."});
  spec.custom("parameters",
              [this](const Node& node) {
                if (!node.is_map())
                  throw InputError(node.origin, "'parameters' is no map", "it names numbers for the program",
                                   "write '{name: 1e-16 m^2}'");
                for (const Node::Entry& entry : node.entries)
                  parameters.emplace_back(entry.key, in_si(entry.value, entry.key));
              },
              {.doc = "Numbers that the program is told, in SI units, by names of your own."});
  spec.quantity("timeout", timeout,
                {.unit = "s", .range = positive(), .doc = "How long an answer of the program may take."});
  spec.check([this](const Node& node) {
    if (const Node* given = node.find("takes")) takes_origin = given->origin;
    for (const auto& [name, options] : gives)
      if (name.find_first_of(" .") != std::string::npos)
        throw InputError(options.origin, quoted(name) + " is no name of a field", "it has a space or a point",
                         "write letters, digits and '_'");
    for (const char* role : {"rock_pressure", "rock_temperature", "aperture", "friction_factor"}) {
      int count = 0;
      for (const auto& [name, options] : gives) count += options.as == role ? 1 : 0;
      if (count > 1)
        throw InputError(node.origin, "two fields are given as " + quoted(role),
                         "couplers would not know which to take", "leave one of them");
    }
    if (gives.empty())
      throw InputError(node.origin, "the program gives nothing", "it is there to determine fields",
                       "write 'gives: {name: {unit: …, initial: …}}'");
  });
  return spec;
}

}  // namespace sprekk::outside
