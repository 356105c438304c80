// Flux discretizations in space against flows that are known.
#include <gtest/gtest.h>

#include "components/matrix_flow/mpfa/mpfa.hpp"
#include "components/matrix_flow/tpfa/tpfa.hpp"
#include "tests/space/flux_cases.hpp"

namespace sprekk {
namespace {

using test::Bend;
using test::Bodies;
using test::ExactFlow;
using test::Given;

constexpr double rounding = 1e-10;

ExactFlow linear_flow(const Tensor& mobility) {
  const Point slope(1.3, -0.7, 2.1);
  return {.pressure = [=](const Point& x) { return 0.4 + slope.dot(x); },
          .velocity = [=](const Point&) { return Point(-(mobility * slope)); }};
}

void expect_exact(const Mesh& mesh, const FluxOperators& operators, const std::vector<FlowCondition>& conditions,
                  const ExactFlow& flow) {
  ASSERT_EQ(operators.blended_nodes.sum(), 0);
  const Given given(mesh, conditions, flow);
  Vector pressure(mesh.cell_count());
  for (int c = 0; c < mesh.cell_count(); ++c) pressure[c] = flow.pressure(mesh.cell_center[c]);
  const Vector fluxes =
      operators.flux_cell * pressure + operators.flux_boundary * given.values + operators.flux_change * given.changes;
  const Vector traces = operators.trace_cell * pressure + operators.trace_boundary * given.values +
                        operators.trace_change * given.changes;
  for (int f = 0; f < mesh.face_count(); ++f) {
    ASSERT_NEAR(fluxes[f], test::flux_through(mesh, f, flow), rounding) << f;
    if (mesh.face_cells[f][1] == none) {
      ASSERT_NEAR(traces[f], flow.pressure(mesh.face_center[f]), rounding) << f;
    }
  }
}

class Fluxes : public testing::TestWithParam<std::tuple<Bodies, Bend, bool>> {};
INSTANTIATE_TEST_SUITE_P(Boxes, Fluxes,
                         testing::Combine(testing::Values(Bodies::hexahedra, Bodies::wedges, Bodies::tetrahedra,
                                                          Bodies::hexahedra_and_wedges),
                                          testing::Values(Bend::none, Bend::free_nodes, Bend::all), testing::Bool()));

TEST_P(Fluxes, MpfaIsExactForLinearPressures) {
  const auto& [bodies, bend, has_fractures] = GetParam();
  const Mesh mesh = test::bent_box(5, bodies, bend, has_fractures);
  const auto conditions = test::mixed_conditions(mesh);
  const std::vector<Tensor> mobility(mesh.cell_count(), test::some_tensor());
  expect_exact(mesh, matrix_flow::discretize_mpfa(mesh, mobility, conditions), conditions,
               linear_flow(test::some_tensor()));
}

}  // namespace
}  // namespace sprekk
