#include "components/poromechanics/principal_stress.hpp"

#include <cmath>
#include <utility>

#include "framework/discretization/principal_axes.hpp"
#include "framework/round_off.hpp"

namespace sprekk::poromechanics {
namespace {

/// With the sign of its largest component.
Point with_sign(const Point& direction) {
  int largest = 0;
  for (int k = 1; k < dimension; ++k)
    if (std::abs(direction[k]) * (1 - rounding::far_above) > std::abs(direction[largest])) largest = k;
  return direction[largest] < 0 ? Point(-direction) : direction;
}

PrincipalStress principal_in_plane(const SymmetricTensor& stress) {
  const double mean = 0.5 * (stress[0] + stress[1]), half = 0.5 * (stress[0] - stress[1]);
  const double radius = std::hypot(half, stress[2]);  // of Mohr's circle
  // The largest eigenvalue has the direction at half the angle; the smallest one is at a right angle to it.
  const double angle = 0.5 * std::atan2(stress[2], half);
  Point direction = Point::Zero();
  direction.head<2>() << -std::sin(angle), std::cos(angle);
  if (radius <= rounding::same * std::abs(mean)) direction.setZero();
  return {mean - radius, mean + radius, with_sign(direction)};
}

PrincipalStress principal_in_space(const SymmetricTensor& stress) {
  Tensor tensor;
  for (int k = 0; k < symmetric_components; ++k) {
    const auto [i, j] = symmetric_axes[k];
    tensor(i, j) = tensor(j, i) = stress[k];
  }
  const PrincipalAxes principal = principal_axes(tensor);
  const Point& values = principal.values;
  const bool has_direction = values[1] - values[0] > 2 * rounding::same * values.cwiseAbs().maxCoeff();
  return {values[0], values[dimension - 1], has_direction ? with_sign(principal.axes.col(0)) : Point(Point::Zero())};
}

}  // namespace

PrincipalStress principal_stress(const SymmetricTensor& stress) {
  return dimension == 2 ? principal_in_plane(stress) : principal_in_space(stress);
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
