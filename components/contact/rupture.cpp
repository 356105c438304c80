#include "components/contact/rupture.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "components/contact/tangents.hpp"
#include "framework/invariants.hpp"

namespace sprekk::contact {

namespace {

constexpr double log_at_zero = 9.1;  // log10 of the moment in N m at the magnitude 0

}  // namespace

Rupture rupture_of(const Mesh& mesh, const Vector& slip, const Vector& stress_drop, const Vector& shear_modulus,
                   const std::vector<char>& takes_part) {
  const int cells = mesh.fracture_cell_count();
  SPREKK_EXPECT(slip.size() == tangents * cells && stress_drop.size() == cells, slip.size(), stress_drop.size());
  Rupture rupture;
  if (shear_modulus.size() == 0) rupture.moment = std::numeric_limits<double>::quiet_NaN();
  double weight = 0;
  for (int i = 0; i < cells; ++i) {
    const double measure = mesh.fracture_cells[i].measure, slipped = slip.segment<tangents>(tangents * i).norm();
    if (shear_modulus.size() > 0) rupture.moment += shear_modulus[i] * slipped * measure;
    rupture.largest_slip = std::max(rupture.largest_slip, slipped);
    rupture.place += slipped * measure * mesh.fracture_cells[i].center;
    weight += slipped * measure;
    if (!takes_part[i]) continue;
    rupture.size += measure;
    rupture.stress_drop += measure * stress_drop[i];
  }
  if (rupture.size > 0) rupture.stress_drop /= rupture.size;
  if (weight > 0) rupture.place /= weight;
  return rupture;
}

std::vector<Quantity> figures_of(const Rupture& rupture) {
  const bool is_plane = dimension == 2;
  std::vector<Quantity> figures = {{is_plane ? "length" : "area", is_plane ? "m" : "m^2", rupture.size},
                                   {"slip", "m", rupture.largest_slip},
                                   {"stress_drop", "Pa", rupture.stress_drop},
                                   {"moment", is_plane ? "N" : "N*m", rupture.moment}};
  if (!is_plane) figures.push_back({"magnitude", "1", 2 * (std::log10(rupture.moment) - log_at_zero) / 3});
  return figures;
}

}  // namespace sprekk::contact
