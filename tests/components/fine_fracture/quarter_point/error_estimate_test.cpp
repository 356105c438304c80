#include "components/fine_fracture/quarter_point/elasticity/error_estimate.hpp"

#include "components/fine_fracture/fine_level/quadrature.hpp"
#include "components/fine_fracture/quarter_point/elasticity/adapt.hpp"
#include "components/fine_fracture/quarter_point/elasticity/shapes.hpp"
#include "framework/mesh/mesh.hpp"
#include "tests/components/fine_fracture/quarter_point/cases.hpp"

namespace sprekk::test {
namespace {

double true_error(const FineSolution& solution, const Griffith& exact) {
  double squared = 0;
  for (std::size_t e = 0; e < solution.mesh->elements.size(); ++e) {
    const FineMesh::Element& element = solution.mesh->elements[e];
    for (const TrianglePoint& place : element.tip == none ? triangle_rule(6) : polar_rule(6, 8)) {
      const ShapePoint p = shape_point(*solution.mesh, element, place.xi, place.eta);
      const Tensor difference =
          solution.elastic_stress_at({static_cast<int>(e), place.xi, place.eta}) - exact.stress(p.x);
      squared += place.weight * p.jacobian * difference.cwiseProduct(solution.rock.at(p.x).strain(difference)).sum();
    }
  }
  return std::sqrt(squared);
}

TEST(ErrorEstimate, IsNearTheTrueErrorOfACrackInAPlate) {
  for (const double scale : {1.0, 0.5, 0.25}) {
    const Griffith exact = paper_crack(1e6, 0.7e6, -3e6);
    const FineMeshOptions options{.tip_size = 0.02 * scale, .far_size = 0.05 * scale, .growth = 0.4};
    const FineModel model(paper_box(), options, table_1_rock);
    const FineSolution solution = model.solve(exact_outline(exact));
    const ErrorEstimate estimate = estimate_error(model, solution);
    const double effectivity = estimate.total / true_error(solution, exact);
    RecordProperty("effectivity at scale " + std::to_string(scale), std::to_string(effectivity));
    RecordProperty("relative at scale " + std::to_string(scale), std::to_string(estimate.relative));
    EXPECT_GT(effectivity, 0.7);
    EXPECT_LT(effectivity, 1.4);
  }
}

TEST(ErrorEstimate, VanishesForAUniformStress) {
  FineGeometry geometry = paper_box();
  geometry.cracks.clear();
  const FineModel model(geometry, paper_mesh(), table_1_rock);
  const FineSolution solution = model.solve(
      {.boundary_displacement = [](const Point& x, const Point&) { return Point(1e-4 * x.x(), -2e-4 * x.y()); }});
  EXPECT_LT(estimate_error(model, solution).relative, 1e-12);
}

TEST(ErrorEstimate, AdaptedMeshesKeepTheTolerance) {
  const Griffith exact = paper_crack(1e6, 0.7e6, -3e6);
  const FineMeshOptions coarse{.tip_size = 0.03, .far_size = 0.25, .growth = 1};
  const Adapted adapted =
      adapt(paper_box(), coarse, table_1_rock, exact_outline(exact), {.tolerance = 2e-3, .at_most = 6});
  RecordProperty("meshes", adapted.meshes);
  RecordProperty("elements", static_cast<int>(adapted.model.mesh().elements.size()));
  ASSERT_TRUE(adapted.is_converged);
  EXPECT_GT(adapted.meshes, 1);
  const double energy = adapted.model.strain_energy(adapted.solution);
  const double relative = true_error(adapted.solution, exact) / std::sqrt(2 * energy);
  EXPECT_LT(relative, 1.5 * 2e-3);
  EXPECT_LT(worst_error(adapted.solution, exact.K()), 3e-4);
}

}  // namespace
}  // namespace sprekk::test
