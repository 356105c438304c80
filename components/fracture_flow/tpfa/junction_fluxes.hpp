// Fluxes between the cells of a junction, where fractures touch or cross.
#pragma once

#include <utility>
#include <vector>

#include "framework/mesh/mesh.hpp"

namespace sprekk::fracture_flow {

/// A factor of a flux (m^2/(Pa s), in space m^3/(Pa s), unless said otherwise), and its derivatives by the apertures of
/// fracture cells and, where inertia counts, by the fluxes through ridges.
struct Conductance {
  double value;
  std::vector<std::pair<int, double>> by_aperture;
  std::vector<std::pair<int, double>> by_flux = {};
};

/// The equations of the fluxes at a junction. With t_i the conductance from the centre of cell i to the junction, the
/// fluxes t_i (p_i − p) into the junction add up to zero. Elimination of the junction's pressure p gives a flux
/// Q_ij = C_ij (p_i − p_j) between each two of its cells, C_ij = t_i t_j / sum t (star to mesh; Karimi-Fard, Durlofsky
/// and Aziz, SPE Journal 9, 2004).
///
/// Where fractures conduct well, differences of pressures are round-off, which would determine the flux that circulates
/// among three cells. So only the fluxes of the cell with the largest conductance, the hub h, follow from pressures;
/// the others follow from these fluxes: Q_ij = (t_i / t_h) Q_hj − (t_j / t_h) Q_hi.
class JunctionFluxes {
 public:
  /// The conductance t_i, m^2/(Pa s) (in space m^3/(Pa s)), and its derivatives: by the apertures of the junction's
  /// cells, then by the further variables of these cells one after the other, and by the fluxes through ridges.
  struct Half {
    double value;
    Vector by_aperture;
    std::vector<std::pair<int, double>> by_flux = {};
  };
  /// `halves`: one for each of the junction's cells. `fracture_cells`: the number of all cells, and of the columns of
  /// each further variable.
  JunctionFluxes(const Junction& junction, int fracture_cells, std::vector<Half> halves);

  /// A flux between two cells: the conductance times the pressure drop for a flux of the hub, or else the sum of shares
  /// of the fluxes through other ridges.
  struct Flux {
    Conductance conductance;
    /// The share of the flux through another ridge.
    struct Part {
      int ridge;
      Conductance share;  ///< without unit; the sign accounts for the directions of both fluxes
    };
    std::vector<Part> parts;
  };
  /// The flux through one of the junction's ridges; `place`: of the ridge in Junction::ridges.
  Flux flux(int place) const;

 private:
  Flux::Part part(int from, int to, double sign) const;
  int ridge_between(int one, int other) const;
  /// Derivatives by the apertures of the junction's cells, with their numbers.
  std::vector<std::pair<int, double>> by_cell(const Vector& by_aperture) const;

  const Junction& junction_;
  int fracture_cells_;
  std::vector<Half> halves_;
  std::vector<std::pair<int, int>> ends_;  ///< per ridge: the places of its cells among the junction's
  double sum_ = 0;
  int hub_ = 0;
};

}  // namespace sprekk::fracture_flow
