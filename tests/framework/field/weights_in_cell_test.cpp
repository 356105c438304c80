// Values of fields on nodes and faces inside of cells, and the processes that own them.
#include "framework/field/weights_in_cell.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "framework/field/ownership.hpp"
#include "framework/mesh/corner_weights.hpp"
#include "framework/mesh/partition.hpp"
#include "tests/components/meshes.hpp"

namespace sprekk::test {
namespace {

double linear(const Point& x) { return 3 - 0.7 * x[0] + 2 * x[1]; }

std::vector<Mesh> meshes() { return {fractured_square(), fractured_rectangles(), fractured_square(mixed(0.1, 0.3))}; }

TEST(WeightsInCell, AreExactForLinearFields) {
  for (const Mesh& mesh : meshes())
    for (int c = 0; c < mesh.cell_count(); ++c)
      for (int k = 0; k < mesh.cell_nodes[c].size(); ++k) {
        // Inside, and at a corner itself.
        for (const double share : {0.3, 1.0}) {
          const Point x = (1 - share) * mesh.cell_center[c] + share * mesh.nodes[mesh.cell_nodes[c][k]];
          double at_nodes = 0, at_faces = 0;
          for (const auto& [node, weight] : weights_in_cell(mesh, Location::node, c, x)) {
            EXPECT_GT(weight, -1e-12);
            at_nodes += weight * linear(mesh.nodes[node]);
          }
          for (const auto& [face, weight] : weights_in_cell(mesh, Location::face, c, x))
            at_faces += weight * linear(mesh.face_center[face]);
          EXPECT_NEAR(at_nodes, linear(x), 1e-12);
          EXPECT_NEAR(at_faces, linear(x), 1e-11);
        }
        EXPECT_EQ(cell_holding(mesh, {c == 0 ? 1 : 0, c}, mesh.cell_center[c]), c);
      }
}

/// On a face only its own ends count, so that the cells on both sides agree.
TEST(WeightsInCell, AreContinuousAcrossFaces) {
  for (const Mesh& mesh : meshes())
    for (int f = 0; f < mesh.face_count(); ++f) {
      const auto& [a, b] = mesh.face_nodes[f];
      for (const int cell : mesh.face_cells[f]) {
        if (cell == none) continue;
        for (const auto& [node, weight] : corner_weights(mesh, cell, 0.3 * mesh.nodes[a] + 0.7 * mesh.nodes[b]))
          EXPECT_NEAR(weight, node == a ? 0.3 : node == b ? 0.7 : 0, 1e-11);
      }
    }
}

TEST(WeightsInCell, GiveMeansOfCells) {
  const Mesh mesh = fractured_square();
  Vector values(2 * mesh.face_count());
  for (int f = 0; f < mesh.face_count(); ++f)
    values.segment<2>(2 * f) = Point(linear(mesh.face_center[f]), -linear(mesh.face_center[f]));
  const Vector means = means_of_cells(mesh, Location::face, 2, values);
  for (int c = 0; c < mesh.cell_count(); ++c) {
    EXPECT_NEAR(means[2 * c], linear(mesh.cell_center[c]), 1e-13);
    EXPECT_NEAR(means[2 * c + 1], -linear(mesh.cell_center[c]), 1e-13);
  }
  EXPECT_THROW(weights_in_cell(mesh, Location::wall, 0, mesh.cell_center[0]), std::logic_error);
}

/// Each node and face belongs to one process, which also owns a cell there.
TEST(Ownership, OfNodesAndFacesIsThatOfACell) {
  Mesh mesh = fractured_square();
  partition(mesh, 3);
  std::vector<int> owned(3, 0);
  for (int node = 0; node < mesh.node_count(); ++node) {
    const int rank = entity_rank(mesh, Location::node, node);
    ++owned[rank];
    bool has_cell = false;
    for (const int cell : mesh.node_cells[node]) has_cell = has_cell || mesh.cell_rank[cell] == rank;
    EXPECT_TRUE(has_cell);
  }
  for (const int count : owned) EXPECT_GT(count, mesh.node_count() / 5);
  for (int face = 0; face < mesh.face_count(); ++face)
    EXPECT_EQ(entity_rank(mesh, Location::face, face), mesh.cell_rank[mesh.face_cells[face][0]]);
}

}  // namespace
}  // namespace sprekk::test
