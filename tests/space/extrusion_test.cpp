// An extruded mesh has the answer of the plane.
#include <gtest/gtest.h>

#include "components/matrix_flow/mpfa/mpfa.hpp"
#include "tests/components/matrix_flow/bent_square.hpp"
#include "tests/space/flux_cases.hpp"

namespace sprekk {
namespace {

using test::BentSquare;

/// Three layers of different heights, in order upwards, each with the cells of the square.
Mesh extruded(const BentSquare& square) {
  const std::vector<double> heights{0, 0.3, 0.4, 1};
  const int layers = static_cast<int>(heights.size()) - 1, per_layer = static_cast<int>(square.nodes.size());
  RawMesh raw;
  for (const double z : heights)
    for (const auto& [x, y] : square.nodes) raw.nodes.push_back(Point(x, y, z));
  raw.region_names = {"rock"};
  raw.side_names = {"left", "right", "front", "back", "bottom", "top"};
  for (int layer = 0; layer < layers; ++layer)
    for (const std::vector<int>& cell : square.cells) {
      CellNodes nodes;
      FaceNodes bottom, top;
      for (const int node : cell) bottom.push_back(layer * per_layer + node);
      for (const int node : cell) top.push_back((layer + 1) * per_layer + node);
      for (const int node : bottom) nodes.push_back(node);
      for (const int node : top) nodes.push_back(node);
      raw.cells.push_back(nodes);
      raw.regions.push_back(0);
      if (layer == 0) raw.boundary_faces.push_back({bottom, 4});
      if (layer == layers - 1) raw.boundary_faces.push_back({top, 5});
      for (int k = 0; k < bottom.size(); ++k)
        if (const int side = square.side_of(cell[k], cell[(k + 1) % cell.size()]); side >= 0)
          raw.boundary_faces.push_back({{bottom[k], bottom.after(k), top.after(k), top[k]}, side});
    }
  return build_mesh(raw);
}

TEST(Extrusion, HasTheAnswerOfThePlane) {
  for (const bool has_triangles : {false, true}) {
    const Mesh mesh = extruded(BentSquare(has_triangles));
    Tensor mobility;
    mobility << BentSquare::xx, BentSquare::xy, 0, BentSquare::xy, BentSquare::yy, 0, 0, 0, 0.7;
    std::vector<FlowCondition> conditions(mesh.face_count(), FlowCondition::none);
    for (int f = 0; f < mesh.face_count(); ++f)
      if (mesh.face_side[f] != none)
        conditions[f] = mesh.face_side[f] < 2 ? FlowCondition::pressure : FlowCondition::flux;
    const test::ExactFlow given{.pressure = [](const Point& x) { return BentSquare::pressure(x[0], x[1]); },
                                .velocity =
                                    [](const Point& x) {
                                      return x[1] == 0   ? Point(0, -BentSquare::outflow(0), 0)
                                             : x[1] == 1 ? Point(0, BentSquare::outflow(1), 0)
                                                         : Point(0, 0, 0);
                                    },
                                .source = [](const Point& x) { return BentSquare::source(x[0], x[1]); }};
    const FluxOperators operators =
        matrix_flow::discretize_mpfa(mesh, std::vector<Tensor>(mesh.cell_count(), mobility), conditions);
    const Vector pressure = test::solve(mesh, operators, {mesh, conditions, given}, given.source).pressure;
    const std::vector<double>& answer = test::answer_in_plane(has_triangles);
    for (int c = 0; c < mesh.cell_count(); ++c) EXPECT_NEAR(pressure[c], answer[c % answer.size()], 1e-9) << c;
  }
}

}  // namespace
}  // namespace sprekk
