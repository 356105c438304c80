#include "components/fine_fracture/jump_fit/options.hpp"

#include <fmt/format.h>

#include "framework/types.hpp"

namespace sprekk::fine_fracture {

namespace {

constexpr const char* in_a_plane =
    "Tips of fractures without a fine level: stress-intensity factors from the displacement jumps of the coarse "
    "level behind them. Such tips do not grow, and need no `grow` step. Columns of history.csv for each end END "
    "of a fracture (main_first, main_last), behind NAME.END.: K_I, K_II, K_eq and K_error_fit (Pa*m^0.5; the "
    "last one is how much they change with one cell less, and empty where there is one cell).";

constexpr const char* in_space =
    "Fronts of fractures, the lines along which they end in the rock: stress-intensity factors from the displacement "
    "jumps behind them, with elements of second order. Fronts do not grow, and need no `grow` step. fronts.pvd has the "
    "edges of all fronts in their order, with NAME.arc (m, along the front, which goes clockwise as seen from the plus "
    "side), K_I, K_II, K_III, K_error_fit (Pa*m^0.5; how much they change with one cell less) and energy_release_rate "
    "(J/m^2). K_II > 0 where the plus wall moves ahead, K_III > 0 where it moves along the front. Columns of "
    "history.csv for each fracture with a front, behind NAME.FRACTURE.: the largest K_I, and K_II, K_III, K_error_fit "
    "and energy_release_rate of the largest size.";

}  // namespace

Spec JumpFitOptions::spec() {
  Spec spec("fine_fracture/jump_fit", dimension == 2 ? in_a_plane : in_space);
  spec.ignore("type");
  spec.integer("cells", cells,
               {.range = between(1, 20),
                .doc = dimension == 2
                           ? "Cells of the fracture whose jumps the factors are extrapolated from; with those left out "
                             "at most half of the cells to the next kink, junction or end."
                           : "How far behind those left out the jumps are taken, in sizes of the cells at the front; "
                             "at most 0.4 of the way to the next junction or end.",
                .source = "Chan, Tuba and Wilson 1970"});
  spec.integer("leave_out", leave_out,
               {.range = between(0, 5),
                .doc = dimension == 2
                           ? "Cells at the tip that are left out, unless fewer than two others are there: the error of "
                             "their jumps does not become smaller with the cells."
                           : "What is left out behind the front, in sizes of the cells there, unless too few cells are "
                             "left: the error of their jumps does not become smaller with the cells."});
  return spec;
}

void note_without_jumps(const std::string& name, Notes& notes) {
  notes.add(name + " without a coupler",
            fmt::format("{} has no factors (no coupler gives it the jumps of the rock) add a coupler two_level between "
                        "the rock and {}",
                        name, name));
}

}  // namespace sprekk::fine_fracture
