#include "components/poromechanics/principal_stress.hpp"

#include <cmath>
#include <utility>

namespace sprekk::poromechanics {
namespace {

constexpr double alike = 1e-11;      // radius of Mohr's circle, of the mean stress: a direction would be round-off
constexpr double first_axis = 1e-6;  // two components that differ by less count as equal

}  // namespace

PrincipalStress principal_stress(const SymmetricTensor& stress) {
  static_assert(dimension == 2);
  const double mean = 0.5 * (stress[0] + stress[1]), half = 0.5 * (stress[0] - stress[1]);
  const double radius = std::hypot(half, stress[2]);  // of Mohr's circle
  // The largest eigenvalue has the direction at half the angle; the smallest one is at a right angle to it.
  const double angle = 0.5 * std::atan2(stress[2], half);
  Point direction(-std::sin(angle), std::cos(angle));
  if (radius <= alike * std::abs(mean)) direction.setZero();
  const int larger = std::abs(direction.y()) * (1 - first_axis) > std::abs(direction.x()) ? 1 : 0;
  if (direction[larger] < 0) direction = -direction;
  return {mean - radius, mean + radius, direction};
}

void output_stress(const std::string& owner, Vector stress, std::vector<OutputField>& fields) {
  const auto cells = stress.size() / symmetric_components;
  Vector most(cells), least(cells), direction(dimension * cells);
  for (Eigen::Index c = 0; c < cells; ++c) {
    const PrincipalStress principal = principal_stress(stress.segment<symmetric_components>(symmetric_components * c));
    most[c] = principal.most_compressive;
    least[c] = principal.least_compressive;
    direction.segment<dimension>(dimension * c) = principal.direction;
  }
  fields.push_back({owner + ".stress", "Pa", Location::cell, symmetric_components, std::move(stress)});
  fields.push_back({owner + ".principal_stress.most_compressive", "Pa", Location::cell, 1, std::move(most)});
  fields.push_back({owner + ".principal_stress.least_compressive", "Pa", Location::cell, 1, std::move(least)});
  fields.push_back({owner + ".most_compressive_direction", "1", Location::cell, dimension, std::move(direction)});
}

}  // namespace sprekk::poromechanics
