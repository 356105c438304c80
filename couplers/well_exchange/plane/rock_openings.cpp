// In a plane a well is a point, whose rate is shared by the cells around.
#include "couplers/well_exchange/rock_openings.hpp"

#include <Eigen/LU>
#include <cmath>
#include <stdexcept>

#include "couplers/well_exchange/plane/early_resistance.hpp"
#include "couplers/well_exchange/plane/equivalent_radius.hpp"
#include "couplers/well_exchange/plane/well_patch.hpp"
#include "framework/mesh/geometry.hpp"

namespace sprekk::couplers {
namespace {

std::optional<EarlyResistance> resistance_of(const Mesh& mesh, const MatrixFluxes& fluxes, const WellPlace& place,
                                             const PointSource& source, const Tensor& mobility, double bore) {
  try {
    return early_resistance(mesh, fluxes, source, mobility, bore);
  } catch (const std::invalid_argument& error) {
    refuse_flow(place, error.what());
  }
}

RockOpening rock_opening(const Mesh& mesh, const MatrixFluid& rock, const MatrixFluxes& fluxes, const WellPlace& place,
                         int home) {
  const auto is_in_same_rock = [&](int cell) {
    return mesh.cell_region[cell] == mesh.cell_region[home] && rock.is_in_cell(cell);
  };
  if (fluxes.mobility_follows_state()) return {point_source(mesh, place.at, is_in_same_rock).shares, {}};
  const Tensor& mobility = fluxes.mobility()[home];
  const std::vector<char> is_inner = place.index ? std::vector<char>() : inner_cells(mesh);
  const PointSource source = point_source(mesh, place.at, [&](int cell) {
    return is_in_same_rock(cell) && conduct_alike(mobility, fluxes.mobility()[cell]) &&
           (is_inner.empty() || is_inner[cell]);
  });
  if (place.index) return {source.shares, {}};
  const double bore = radius_of_bore_hole(widened_radius(place), mobility);
  const std::optional<EarlyResistance> early = resistance_of(mesh, fluxes, place, source, mobility, bore);
  if (!early)
    throw InputError(place.origin, "the index of well '" + place.name + "' cannot be found",
                     "its cell at " + to_text(mesh.cell_center[home]) + " touches a side or a fracture",
                     "use smaller cells there, give its 'index', or name the 'fracture' in which it is open");
  RockOpening opening{source.shares, *early};
  opening.early.log_of_radii += skin_beside_radius(place);
  require_positive_index(place, opening.early.log_of_radii, bore * std::exp(early->log_of_radii));
  return opening;
}

}  // namespace

std::vector<RockOpening> rock_openings(const Mesh& mesh, const MatrixFluid& rock, const MatrixFluxes& fluxes,
                                       const std::vector<WellPlace>& places, const std::vector<int>& cells) {
  std::vector<RockOpening> openings(places.size());
  for (std::size_t k = 0; k < places.size(); ++k)
    if (cells[k] != none) openings[k] = rock_opening(mesh, rock, fluxes, places[k], cells[k]);
  return openings;
}

double mobility_across(const WellPlace&, const Tensor& mobility) { return std::sqrt(mobility.determinant()); }

double open_length(const WellPlace&) { return 1; }

}  // namespace sprekk::couplers
