// How wells are open to the rock: the cells around, and the resistance of the rock between.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "components/capabilities/fluid_fluxes.hpp"
#include "components/capabilities/matrix_fluid.hpp"
#include "components/capabilities/wells.hpp"
#include "couplers/well_exchange/early_resistance.hpp"

namespace sprekk::couplers {

/// What surrounds a place of a well in the rock.
struct RockOpening {
  std::vector<std::pair<int, double>> shares;  ///< of cells in the rate, which add up to 1
  EarlyResistance early;                       ///< ln(r_e/r_w) + skin, and its terms; zero where the index is given
};

/// Of all places that are open to rock, whose cells are given (others have none, and get an empty opening). Throws
/// InputError where an index cannot be found.
std::vector<RockOpening> rock_openings(const Mesh& mesh, const MatrixFluid& rock, const MatrixFluxes& fluxes,
                                       const std::vector<WellPlace>& places, const std::vector<int>& cells);

/// sqrt(det M) of the mobility M across the well, m^2/(Pa s): a rate q for each metre raises the pressure around by
/// q/(2 pi sqrt(det M)) ln(r_e/r). In a plane the well is at right angles to it.
double mobility_across(const WellPlace& place, const Tensor& mobility);

/// m, along which a place is open to the rock; 1 in a plane.
double open_length(const WellPlace& place);

/// A negative skin, of rock or a fracture that conducts better around a well, counts as a wider bore hole, m; a
/// positive one is added to ln(r_e/r_w).
double widened_radius(const WellPlace& place);
double skin_beside_radius(const WellPlace& place);

/// Throws InputError for an index that is not positive: ln(r_e/r_w) + skin, `around`: r_e, m.
void require_positive_index(const WellPlace& place, double log_of_radii, double around);

/// Throws InputError for a flow whose discrete equations PatchOfCells does not take, for this reason.
[[noreturn]] void refuse_flow(const WellPlace& place, const std::string& why);

}  // namespace sprekk::couplers
