// Fluxes between the cells of a junction, where fractures touch or cross.
#pragma once

#include <utility>
#include <vector>

#include "framework/mesh/mesh.hpp"

namespace sprekk::fracture_flow {

/// A factor of a flux (m^2/(Pa s), unless said otherwise) and its derivatives by the apertures of fracture cells.
struct Conductance {
  double value;
  std::vector<std::pair<int, double>> by_aperture;
};

/// With t_i the conductance from the centre of cell i to the junction, the fluxes t_i (p_i − p) into it add up to zero.
/// Without the pressure p of the junction that is a flux Q_ij = C_ij (p_i − p_j) between each two of its cells,
/// C_ij = t_i t_j / sum t (star to mesh; Karimi-Fard, Durlofsky and Aziz, SPE Journal 9, 2004).
///
/// Where fractures conduct well, differences of pressures have no correct digit, and a flux that goes around among
/// three cells would be left to rounding. So only the fluxes of the cell that conducts best, the hub h, are given by
/// pressures, and the others by these: Q_ij = (t_i / t_h) Q_hj − (t_j / t_h) Q_hi.
class JunctionFluxes {
 public:
  /// m^2/(Pa s), and its derivative by the aperture.
  struct Half {
    double value, by_aperture;
  };
  /// `halves`: one for each of the junction's cells.
  JunctionFluxes(const Junction& junction, std::vector<Half> halves);

  /// A flux between two cells is the conductance times the drop of pressure, or, where the hub has no part in it, the
  /// sum of shares of fluxes through other points.
  struct Flux {
    Conductance conductance;
    struct Part {
      int point;
      Conductance share;  ///< without unit; with the sign that the directions of both fluxes ask for
    };
    std::vector<Part> parts;
  };
  /// Through one of the junction's points, by its place among them.
  Flux flux(int place) const;

 private:
  Flux::Part part(int from, int to, double sign) const;
  int point_between(int one, int other) const;

  const Junction& junction_;
  std::vector<Half> halves_;
  std::vector<std::pair<int, int>> ends_;  ///< per point: the places of its cells among the junction's
  double sum_ = 0;
  int hub_ = 0;
};

}  // namespace sprekk::fracture_flow
