// The weight of the rock on a fine level of elements: a particular solution is added to the crack in a plate.
#include "components/fine_fracture/quarter_point/elasticity/model.hpp"
#include "tests/components/fine_fracture/body_forces.hpp"

namespace sprekk::test {
namespace {

struct Errors {
  double K, T;  ///< of |K|, and of the largest stress
};

Errors errors_with(const LayeredForce& force) {
  const Griffith exact = paper_crack(1e6, 0.7e6, -3e6);
  const FineGeometry geometry = paper_box();
  const FineSolution solution = FineModel(geometry, paper_mesh(), table_1_rock).solve(force.loads(exact, geometry));
  Errors errors{worst_error(solution, exact.K()), 0};
  for (const TipIntensities& tip : solution.tips)
    errors.T = std::max(errors.T, std::abs(tip.T - force.T(exact, tip.position)) / 3e6);
  return errors;
}

TEST(BodyForce, OneForceInAnyDirection) {
  // The errors are those of the mesh without the force.
  for (const LayeredForce& force : uniform_forces()) {
    const Errors errors = errors_with(force);
    EXPECT_LT(errors.K, 5e-4) << force.force.transpose();
    EXPECT_LT(errors.T, 1e-3) << force.force.transpose();
  }
}

TEST(BodyForce, LayersOfDifferentWeight) {
  for (const LayeredForce& force : layered_forces()) {
    const Errors errors = errors_with(force);
    EXPECT_LT(errors.K, 1.5e-3) << force.force.transpose() << ", border at " << force.border;
    EXPECT_LT(errors.T, 2e-3) << force.force.transpose() << ", border at " << force.border;
  }
}

TEST(BodyForce, IsTheSameAsAStressOffsetWithItsDivergence) {
  const Griffith exact = paper_crack(1e6, 0.7e6, -3e6);
  const FineGeometry geometry = paper_box();
  FineLoads loads = exact_outline(exact);
  loads.stress_offset = at_each_place(
      [](const Point& x) { return Eigen::Vector3d(3e6 * x.x(), -5e6 * x.y(), 2e6 * x.x() - 4e6 * x.y()); });
  loads.body_force = [](const std::vector<Point>& places) -> Eigen::Matrix2Xd {
    return Point(-(3e6 - 4e6), -(-5e6 + 2e6)).replicate(1, static_cast<Eigen::Index>(places.size()));
  };
  loads.wall_traction = [](int, int, double s) {
    const double x = -0.05 + 0.1 * s;
    return Point(-2e6 * x, 0);
  };
  EXPECT_LT(worst_error(FineModel(geometry, paper_mesh(), table_1_rock).solve(loads), exact.K()), 5e-4);
}

}  // namespace
}  // namespace sprekk::test
