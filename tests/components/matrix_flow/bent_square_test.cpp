// The answer in a plane with which its extrusion in space is compared (tests/space/extrusion_test.cpp).
#include <gtest/gtest.h>

#include <Eigen/SparseLU>

#include "components/matrix_flow/mpfa/mpfa.hpp"
#include "framework/discretization/changes_along_face.hpp"
#include "framework/mesh/build_mesh.hpp"
#include "tests/components/matrix_flow/bent_square.hpp"

namespace sprekk {
namespace {

using matrix_flow::FlowCondition;
using test::BentSquare;

TEST(BentSquare, HasTheAnswerOfItsExtrusion) {
  for (const bool has_triangles : {false, true}) {
    const BentSquare square(has_triangles);
    RawMesh raw;
    for (const auto& [x, y] : square.nodes) raw.nodes.push_back(Point(x, y));
    raw.region_names = {"rock"};
    raw.side_names = {"left", "right", "bottom", "top"};
    for (const std::vector<int>& cell : square.cells) {
      raw.cells.push_back(cell.size() == 3 ? Ring(cell[0], cell[1], cell[2])
                                           : Ring(cell[0], cell[1], cell[2], cell[3]));
      raw.regions.push_back(0);
      for (std::size_t k = 0; k < cell.size(); ++k) {
        const int from = cell[k], to = cell[(k + 1) % cell.size()], side = square.side_of(from, to);
        if (side >= 0) raw.boundary_faces.push_back({{from, to}, side});
      }
    }
    const Mesh mesh = build_mesh(raw);
    Tensor mobility;
    mobility << BentSquare::xx, BentSquare::xy, BentSquare::xy, BentSquare::yy;
    std::vector<FlowCondition> conditions(mesh.face_count(), FlowCondition::none);
    Vector values = Vector::Zero(mesh.face_count()), changes = values, right(mesh.cell_count());
    for (int f = 0; f < mesh.face_count(); ++f) {
      if (mesh.face_side[f] == none) continue;
      conditions[f] = mesh.face_side[f] < 2 ? FlowCondition::pressure : FlowCondition::flux;
      const Point& at = mesh.face_center[f];
      const LinearOnFace linear =
          linear_on_face(mesh, f, [](const Point& x) { return BentSquare::pressure(x[0], x[1]); });
      values[f] = mesh.face_side[f] < 2 ? linear.at_center : BentSquare::outflow(at[1]) * mesh.face_measure[f];
      if (mesh.face_side[f] < 2) changes[f] = linear.changes[0];
    }
    const auto operators =
        matrix_flow::discretize_mpfa(mesh, std::vector<Tensor>(mesh.cell_count(), mobility), conditions);
    std::vector<Triplet> entries;
    for (int f = 0; f < mesh.face_count(); ++f) {
      entries.emplace_back(mesh.face_cells[f][0], f, 1.0);
      if (mesh.face_cells[f][1] != none) entries.emplace_back(mesh.face_cells[f][1], f, -1.0);
    }
    SparseMatrix divergence(mesh.cell_count(), mesh.face_count());
    divergence.setFromTriplets(entries.begin(), entries.end());
    for (int c = 0; c < mesh.cell_count(); ++c)
      right[c] = mesh.cell_measure[c] * BentSquare::source(mesh.cell_center[c][0], mesh.cell_center[c][1]);
    right -= divergence * Vector(operators.flux_boundary * values + operators.flux_change * changes);
    const Eigen::SparseMatrix<double> matrix = divergence * operators.flux_cell;
    const Vector pressure = Eigen::SparseLU<Eigen::SparseMatrix<double>>(matrix).solve(right);
    const std::vector<double>& answer = test::answer_in_plane(has_triangles);
    for (int c = 0; c < mesh.cell_count(); ++c) EXPECT_NEAR(pressure[c], answer[c], 1e-12) << c;
  }
}

}  // namespace
}  // namespace sprekk
