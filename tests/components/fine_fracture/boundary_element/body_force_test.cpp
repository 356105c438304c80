// The weight of the rock on a fine level of boundary elements: a particular solution is added to the crack in a plate.
#include "components/fine_fracture/boundary_element/boundary_model.hpp"
#include "tests/components/fine_fracture/body_forces.hpp"
#include "tests/components/fine_fracture/boundary_element/cases.hpp"

namespace sprekk::test {
namespace {

struct Errors {
  double K, T;  ///< of |K|, and of the largest stress
};

Errors errors_with(const LayeredForce& force, double spacing) {
  const Griffith exact = paper_crack(1e6, 0.7e6, -3e6);
  const FineGeometry geometry = paper_box();
  Errors errors{0, 0};
  for (const bool is_last : {false, true}) {
    const TipFactors found =
        boundary_factors(geometry, table_1_rock, {0, is_last}, force.loads(exact, geometry), 0.02, spacing);
    const Point tip = is_last ? geometry.cracks[0].points.back() : geometry.cracks[0].points.front();
    errors.K = std::max(errors.K, relative_error(intensities_of(found), exact.K(), "K"));
    errors.T = std::max(errors.T, std::abs(found.sifs.t_stress - force.T(exact, tip)) / 3e6);
  }
  return errors;
}

TEST(BoundaryBodyForce, OneForceInAnyDirectionIsExact) {
  for (const LayeredForce& force : uniform_forces()) {
    const Errors errors = errors_with(force, 0.01);
    EXPECT_LT(errors.K, 1e-5) << force.force.transpose();
    EXPECT_LT(errors.T, 1e-5) << force.force.transpose();
  }
}

/// A border is as wide as the distance of the places where forces are taken, which is half of that from the crack, or
/// 30 mm: 1.2e-3 of K at most. Walls in the border itself carry up to the force of a quarter of the distance there.
TEST(BoundaryBodyForce, LayersOfDifferentWeight) {
  for (const LayeredForce& force : layered_forces()) {
    const bool is_on_crack = force.border == 0;
    const auto bound = [&](double spacing) {
      return is_on_crack ? 0.25 * spacing * force.force.norm() / std::hypot(1e6, 0.7e6) : 1.5e-3;
    };
    for (const double spacing : {0.01, 0.005}) {
      if (spacing < 0.01 && !is_on_crack) continue;
      EXPECT_LT(errors_with(force, spacing).K, bound(spacing))
          << force.force.transpose() << ", border at " << force.border;
    }
  }
}

}  // namespace
}  // namespace sprekk::test
