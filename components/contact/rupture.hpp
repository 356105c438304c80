// Moment, size, stress drop and place of a slip event.
#pragma once

#include <vector>

#include "framework/scene/component.hpp"

namespace sprekk::contact {

/// The slip of an event, summed over fracture cells.
struct Rupture {
  double moment = 0;            ///< sum of G |slip| |cell| over all cells, N m; in a plane per m of depth, N
  double size = 0;              ///< of the cells that take part, m², in a plane m
  double stress_drop = 0;       ///< mean loss of shear traction over these cells, Pa
  double largest_slip = 0;      ///< m
  Point place = Point::Zero();  ///< mean of the centres, by slip times size, m
};

/// `slip`: `dimension` − 1 of each cell, m. `stress_drop`: of each cell, Pa. `shear_modulus`: of each cell, Pa, or
/// empty where it is not known, and then neither is the moment (NaN). `takes_part`: one flag a cell.
Rupture rupture_of(const Mesh& mesh, const Vector& slip, const Vector& stress_drop, const Vector& shear_modulus,
                   const std::vector<char>& takes_part);

/// The names of moment and size differ between a plane and space. In space there is the magnitude, too,
/// 2/3 (log10(moment) − 9.1) (Hanks and Kanamori 1979).
std::vector<Quantity> figures_of(const Rupture& rupture);

}  // namespace sprekk::contact
