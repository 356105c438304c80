#include "components/fine_fracture/growth/growth_options.hpp"

#include <algorithm>

namespace sprekk::fine_fracture {

namespace {

constexpr double kink_tolerance = 1e-3;  ///< of K_eq: what factors differ by between two meshes

}  // namespace

void GrowthOptions::follow_kinks() { arrest_tolerance = std::min(arrest_tolerance, kink_tolerance); }

Spec GrowthOptions::spec() {
  Spec spec(
      "growth",
      "How far and where tips grow once the equivalent stress intensity factor exceeds the toughness. Columns of "
      "history.csv for each end END of a fracture (main_first, main_last), behind NAME.END.: K_I, K_II, K_eq and "
      "K_error_fine_mesh (Pa*m^0.5; empty where the tip was ruled out or has stopped), stopped (1: for good), "
      "length (m, of what has grown), x and y (m, where the end is, also on a path that the mesh has not taken "
      "over yet), speed (m/s, what has grown in the step over its duration), grows (1: in this step), and, with a "
      "toughness, apparent_toughness (Pa*m^0.5, K_eq of the tip while it grows within steps: the toughness, and "
      "more by the viscosity of the fluid).");
  spec.choice(
      "direction", direction,
      {{"implicit", "straight increments at whose end K_II vanishes: stable for any length of increment"},
       {"explicit",
        "maximum tangential stress at the old tip (the paper's Eq. 11): the path zigzags when the increment is "
        "longer than "
        "0.17 (K_I/T)^2"},
       {"largest_release",
        "the kink at the old tip that releases most energy: explicit, and within 5.1 degrees of the one above"}},
      {.doc = "How the direction of an increment is found.",
       .source = "the paper's Eq. 11; Goldstein and Salganik 1974; Cotterell and Rice 1980; Amestoy and Leblond "
                 "1992"});
  spec.choice("length", length,
              {{"arrest", "until K_eq falls to the toughness; the last increment is shortened to end there"},
               {"fixed", "whole increments until K_eq is below the toughness (the paper)"}},
              {.doc = "Where growth ends."});
  spec.quantity("increment", increment,
                {.unit = "m",
                 .range = positive(),
                 .doc = "Longest increment; a path is straight between its ends.",
                 .source = "l_max of the paper's Eq. 13",
                 .required = true});
  spec.quantity("energy_exponent", energy_exponent,
                {.range = non_negative(),
                 .doc = "Power of the energy release rate in the lengths of tips that grow together.",
                 .source = "the paper's Eq. 13"});
  spec.quantity("relaxation", relaxation,
                {.range = {.low = 0, .high = 1, .low_allowed = false},
                 .doc = "Part of an explicit angle that is taken; less than 1 delays the zigzag."});
  spec.quantity("direction_tolerance", direction_tolerance,
                {.range = strictly_between(0, 1), .doc = "Largest |K_II|/K_I at the end of an implicit increment."});
  spec.quantity(
      "arrest_tolerance", arrest_tolerance,
      {.range = strictly_between(0, 1),
       .doc = "Largest |K_eq/K_IC − 1| at the end of growth; 0.001 at most where growth is found within steps, for "
              "kinks that the mesh does not follow yet."});
  spec.quantity("front_tolerance", front_tolerance,
                {.range = {.low = 1e-10, .high = 1e-3},
                 .doc = "Growth within steps: largest |ln(K_eq/K_IC)| of a tip that grows alone (of several tips the "
                        "equations of the front hold to this), and a tenth of the largest |K_II|/K_I. A larger one "
                        "takes fewer trials; lengths are then known to it over the slope of ln K_eq by the length. Far "
                        "below 1e-7 the round-off of factors is larger."});
  spec.quantity("largest_turn", largest_turn,
                {.unit = "rad", .range = between(0.1, 1.55), .doc = "Largest angle between two increments."});
  spec.quantity("smallest", smallest,
                {.range = {.low = 0, .high = 1, .low_allowed = false, .high_allowed = false},
                 .doc = "Shortest increment over the longest; a tip that would grow less waits."});
  spec.quantity("longest", longest,
                {.unit = "m",
                 .range = positive(),
                 .doc = "Most that a tip adds at once, also in a jump within a step; without it there is no limit."});
  spec.integer("at_most", at_most, {.range = between(1, 10000), .doc = "Most increments that a tip adds at once."});
  spec.integer(
      "tries", tries,
      {.range = between(2, 100),
       .doc = "Evaluations of the fine level for one length of an increment. Then a shorter one is tried, four "
              "times as many in all, or, with whole increments, the best direction so far is taken, and where "
              "that is bad the explicit one."});
  spec.check([this](const Node& node) { has_front_tolerance = node.find("front_tolerance") != nullptr; });
  return spec;
}

}  // namespace sprekk::fine_fracture
