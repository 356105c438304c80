// Fields that the elements hold exactly.
#include "components/fine_fracture/quarter_point/elasticity/shapes.hpp"
#include "framework/mesh/mesh.hpp"
#include "tests/components/fine_fracture/quarter_point/cases.hpp"

namespace sprekk::test {
namespace {

Tensor strain_of_patch() {
  Tensor gradient;
  gradient << 1e-4, -3e-4, 2e-4, 5e-5;
  return gradient;
}

double largest_deviation(const FineSolution& solution, const std::function<Point(const Point&)>& exact) {
  double largest = 0, scale = 0;
  for (int n = 0; n < solution.mesh->node_count(); ++n) {
    const Point u = exact(solution.mesh->nodes[n]);
    largest = std::max(largest, (solution.displacement.segment<2>(2 * n) - u).norm());
    scale = std::max(scale, u.norm());
  }
  return largest / scale;
}

/// A straight and a kinked crack, one of which ends on the outline.
FineGeometry cracked_box() {
  FineGeometry geometry{rectangle(0, 0, 1, 1), {}};
  geometry.cracks.push_back({{{0.2, 0.3}, {0.4, 0.3}, {0.5, 0.45}}, true, true, {Walls::traction, Walls::traction}});
  geometry.cracks.push_back({{{1, 0.8}, {0.6, 0.7}}, false, true, {Walls::traction}});
  return geometry;
}

TEST(Patch, LinearDisplacementWithItsWallTractionsIsExact) {
  const Tensor gradient = strain_of_patch();
  const Elasticity rock = table_1_rock;
  const Tensor stress = rock.stress(gradient);
  const FineGeometry geometry = cracked_box();
  const FineModel model(geometry, {.tip_size = 0.05, .far_size = 0.2}, rock);
  FineLoads loads;
  loads.boundary_displacement = [&](const Point& x, const Point&) -> Point { return gradient * x; };
  loads.wall_traction = [&](int crack, int segment, double) -> Point {
    const auto& points = geometry.cracks[crack].points;
    const Point along = (points[segment + 1] - points[segment]).normalized();
    return stress * Point(along.y(), -along.x());
  };
  const FineSolution solution = model.solve(loads);
  EXPECT_LT(largest_deviation(solution, [&](const Point& x) -> Point { return gradient * x; }), 1e-12);
  const double energy = model.strain_energy(solution);
  EXPECT_NEAR(energy, 0.5 * stress.cwiseProduct(gradient).sum(), 1e-10 * energy);
  ASSERT_EQ(solution.tips.size(), 3u);
  for (const TipIntensities& tip : solution.tips) {
    const double scale = stress.norm() * std::sqrt(0.1);
    EXPECT_LT(tip.K.norm(), 1e-8 * scale);  // rounding
    EXPECT_LT(tip.K_correlation.norm(), 1e-9 * scale);
    const Point x1 = tip.direction, x2(-x1.y(), x1.x());
    EXPECT_NEAR(tip.T, x1.dot(stress * x1) - x2.dot(stress * x2), 1e-7 * stress.norm());
  }
}

TEST(Patch, LinearDisplacementIsExactAcrossTiedWallsAndWithTractionsOnTheOutline) {
  const Tensor gradient = strain_of_patch();
  const Tensor stress = table_1_rock.stress(gradient);
  FineGeometry geometry = cracked_box();
  for (CrackPath& crack : geometry.cracks) crack.walls.assign(crack.walls.size(), Walls::jump);
  geometry.sides = {Side::displacement, Side::traction, Side::traction, Side::traction};
  const FineModel model(geometry, {.tip_size = 0.05, .far_size = 0.2}, table_1_rock);
  FineLoads loads;
  loads.boundary_displacement = [&](const Point& x, const Point&) -> Point { return gradient * x; };
  loads.boundary_traction = [&](const Point&, const Point& normal) -> Point { return stress * normal; };
  const FineSolution solution = model.solve(loads);
  EXPECT_LT(largest_deviation(solution, [&](const Point& x) -> Point { return gradient * x; }), 1e-10);
  for (const TipIntensities& tip : solution.tips) EXPECT_LT(tip.K.norm(), 1e-8 * stress.norm());
}

TEST(Patch, TractionsAloneGiveTheStressAndNoRigidMotion) {
  const Tensor stress = table_1_rock.stress(strain_of_patch());
  FineGeometry geometry{rectangle(0, 0, 1, 1), {}};
  geometry.sides.assign(4, Side::traction);
  const FineModel model(geometry, {.tip_size = 0.1, .far_size = 0.2}, table_1_rock);
  const FineSolution solution =
      model.solve({.boundary_traction = [&](const Point&, const Point& normal) -> Point { return stress * normal; }});
  EXPECT_TRUE(solution.tips.empty());
  for (std::size_t e = 0; e < solution.mesh->elements.size(); ++e) {
    const Tensor here = solution.elastic_stress_at({static_cast<int>(e), 0.3, 0.3});
    EXPECT_LT((here - stress).norm(), 1e-9 * stress.norm());
  }
}

TEST(Patch, OpenThroughGoingCrackLetsTwoPiecesPart) {
  // Both pieces move as rigid bodies; the upper one takes all of the jump.
  FineGeometry geometry{rectangle(0, 0, 1, 1), {{{{0, 0.4}, {1, 0.6}}, false, false, {Walls::jump}}}};
  geometry.sides = {Side::displacement, Side::traction, Side::traction, Side::traction};
  const FineModel model(geometry, {.tip_size = 0.1, .far_size = 0.2}, table_1_rock);
  const Point jump(2e-4, -1e-4);
  const FineSolution solution = model.solve({.wall_jump = [&](int, int, double) { return jump; }});
  const ElementLocator locator(*solution.mesh);
  EXPECT_FALSE(locator.find({1.1, 0.5}).has_value());
  EXPECT_LT((solution.displacement_at(*locator.find({0.5, 0.9})) + jump).norm(), 1e-13);
  EXPECT_LT(solution.displacement_at(*locator.find({0.5, 0.1})).norm(), 1e-13);
}

TEST(Patch, QuarterPointElementsHoldRootsAlongRays) {
  const FineGeometry geometry = paper_box();
  const FineMesh mesh = make_fine_mesh(geometry, paper_mesh());
  int rosette_elements = 0;
  for (const FineMesh::Element& element : mesh.elements) {
    if (element.tip == none) continue;
    ++rosette_elements;
    const Point tip = mesh.tips[element.tip].room.position;
    const auto field = [&](const Point& x) { return 3 * std::sqrt((x - tip).norm()) + 7 * (x - tip).norm(); };
    for (const double eta : {0.0, 1.0}) {  // the rays that are edges
      for (const double along : {0.05, 0.3, 0.77}) {
        const ShapePoint p = shape_point(mesh, element, along * (1 - eta), along * eta);
        double value = 0;
        for (int k = 0; k < 6; ++k) value += p.value[k] * field(mesh.nodes[element.nodes[k]]);
        EXPECT_NEAR(value, field(p.x), 1e-14);
        EXPECT_NEAR((p.x - tip).norm(), along * along * 0.02, 1e-15);
      }
    }
  }
  EXPECT_EQ(rosette_elements, 32);
}

}  // namespace
}  // namespace sprekk::test
