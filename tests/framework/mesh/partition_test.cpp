#include "framework/mesh/partition.hpp"

#include <algorithm>

#include "framework/meshing/generate_mesh.hpp"
#include "tests/framework/mesh/mesh_checks.hpp"

namespace sprekk::test {
namespace {

std::vector<int> counts(const Mesh& mesh, int ranks) {
  std::vector<int> count(ranks, 0);
  for (const int rank : mesh.cell_rank) ++count.at(rank);
  return count;
}

TEST(Partition, IsBalancedWithinOneCell) {
  Mesh mesh = generate_mesh(paper_geometry(), {.size = 0.1, .fracture_size = 0.02});
  for (const int ranks : {1, 2, 3, 5, 8, 13}) {
    partition(mesh, ranks);
    const auto count = counts(mesh, ranks);
    const auto [least, most] = std::minmax_element(count.begin(), count.end());
    EXPECT_LE(*most - *least, 1) << ranks << " ranks";
  }
}

TEST(Partition, IsDeterministicAndChangesTheVersion) {
  Mesh mesh = generate_mesh(box(0, 1, 0, 1), {.kind = MeshOptions::Kind::structured, .cells = {9, 9}});
  partition(mesh, 4);
  const auto ranks = mesh.cell_rank;
  const auto version = mesh.version;
  partition(mesh, 4);
  EXPECT_EQ(mesh.cell_rank, ranks);
  EXPECT_NE(mesh.version, version);
}

TEST(Partition, CutsTheLongerExtent) {
  Mesh mesh = generate_mesh(box(0, 8, 0, 1), {.kind = MeshOptions::Kind::structured, .cells = {16, 2}});
  partition(mesh, 4);
  for (int c = 0; c < mesh.cell_count(); ++c)
    EXPECT_EQ(mesh.cell_rank[c], static_cast<int>(mesh.cell_center[c].x() / 2));
}

TEST(Partition, CopesWithMoreRanksThanCells) {
  Mesh mesh = generate_mesh(box(0, 1, 0, 1), {.kind = MeshOptions::Kind::structured, .cells = {1, 1}});
  partition(mesh, 7);
  for (const int count : counts(mesh, 7)) EXPECT_LE(count, 1);
  EXPECT_THROW(partition(mesh, 0), std::logic_error);
}

}  // namespace
}  // namespace sprekk::test
