// The streams of fluid into and out of cells, each with where it comes from.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "components/capabilities/carried.hpp"
#include "components/capabilities/fluid_fluxes.hpp"
#include "components/capabilities/matrix_fluid.hpp"
#include "couplers/advection/well_mixture.hpp"

namespace sprekk::couplers {

/// Fluid that enters a cell, or with a negative rate leaves it.
struct Stream {
  /// own: the cell itself, where no other value (temperature, concentration) is known.
  enum class From { own, rock_cell, fracture_cell, given, well };
  /// The unknown of which the rate is a multiple: the flux through a face, a wall or a ridge, the rate of a well at a
  /// place, or none.
  enum class Flux { face, wall, ridge, well, none };
  int cell;
  double rate;  ///< m^2/s (in space m^3/s)
  From from;
  int index = none;         ///< of the cell or well of its origin
  double value = 0;         ///< where it is given
  bool is_outside = false;  ///< whether it comes from or goes to outside of rock and fractures
  Flux flux = Flux::none;
  int flux_index = none;
  double by_flux = 0;  ///< d rate / d flux
  /// At a junction: d rate / d flux by each ridge there, in the place of the one flux.
  std::vector<std::pair<int, double>> by_ridges = {};
};

/// The rates of fluid that hold in a step, without those through faces. What is missing is empty.
struct FlowRates {
  Vector walls;   ///< from the fracture into the rock, m/s
  Vector points;  ///< through each ridge, from its first to its second cell, m^2/s (in space m^3/s)
  Vector wells;   ///< out of the well at each place, m^2/s (in space m^3/s)
  std::vector<FluidSource> sources_in_rock = {}, sources_in_fractures = {};
};

/// The input for finding streams. Everything but the mesh may be missing.
struct StreamSources {
  const Mesh& mesh;
  const FractureFluxes* fracture = nullptr;
  const MatrixCarried* in_rock = nullptr;
  const FractureCarried* in_fractures = nullptr;
  const WellPressures* wells = nullptr;
  const Field* rock_pressure = nullptr;      ///< of the flow in the matrix
  const Field* fracture_pressure = nullptr;  ///< of the flow in the fractures
  /// The value of entering fluid for which the scene gives no other; without this one it is the value of the cell that
  /// the fluid enters.
  std::optional<double> unknown = {};
  /// The values of fluid that enters at named places (of injection, wells), by name.
  std::vector<std::pair<std::string, double>> injected = {};

  std::optional<double> injected_value(const std::string& name) const {
    for (const auto& [known, value] : injected)
      if (known == name) return value;
    return unknown;
  }
};

/// The streams of cells of the rock that the process owns. `fluxes`: through each face, m^2/s (in space m^3/s), out of
/// face_cells[f][0].
std::vector<Stream> streams_of_rock(const StreamSources& sources, const FlowRates& rates, const Vector& fluxes);
/// The streams of all fracture cells. At a junction all that flows in mixes, and each cell into which fluid flows
/// receives the mixture. A reservoir supplies what its cells lose to others, and takes what they gain.
std::vector<Stream> streams_of_fractures(const StreamSources& sources, const FlowRates& rates);

}  // namespace sprekk::couplers
