// The parameters of tips whose factors follow from jumps.
#include "components/fine_fracture/jump_fit/jump_fit.hpp"

namespace sprekk::fine_fracture {

Spec JumpFitOptions::spec() {
  Spec spec(
      "fine_fracture/jump_fit",
      "Tips of fractures without a fine level: stress-intensity factors from the displacement jumps of the coarse "
      "level behind them. Such tips do not grow, and need no `grow` step. Columns of history.csv for each end END "
      "of a fracture (main_first, main_last), behind NAME.END.: K_I, K_II, K_eq and K_error_fit (Pa*m^0.5; the "
      "last one is how much they change with one cell less, and empty where there is one cell).");
  spec.ignore("type");
  spec.integer(
      "cells", cells,
      {.range = between(1, 20),
       .doc = "Cells of the fracture whose jumps the factors are extrapolated from; with those left out at most "
              "half of the cells to the next kink, junction or end.",
       .source = "Chan, Tuba and Wilson 1970"});
  spec.integer("leave_out", leave_out,
               {.range = between(0, 5),
                .doc = "Cells at the tip that are left out, unless fewer than two others are there: the error of their "
                       "jumps does not become smaller with the cells."});
  return spec;
}

}  // namespace sprekk::fine_fracture
