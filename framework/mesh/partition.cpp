#include "framework/mesh/partition.hpp"

#include <algorithm>
#include <numeric>
#include <random>
#include <span>
#include <stdexcept>

#include "framework/invariants.hpp"
#include "framework/mesh/build_mesh.hpp"

namespace sprekk {
namespace {

/// Gives `cells` to the ranks first … last - 1; rank r of all ranks owns share(r) … share(r+1) of all cells.
template <class Share>
void bisect(Mesh& mesh, std::span<int> cells, int first, int last, const Share& share) {
  if (last - first == 1) {
    for (const int cell : cells) mesh.cell_rank[cell] = first;
    return;
  }
  if (cells.empty()) return;
  Point low = mesh.cell_center[cells[0]], high = low;
  for (const int cell : cells) {
    low = low.cwiseMin(mesh.cell_center[cell]);
    high = high.cwiseMax(mesh.cell_center[cell]);
  }
  int axis = 0;
  (high - low).maxCoeff(&axis);
  const int middle = (first + last) / 2;
  const auto cut = cells.begin() + (share(middle) - share(first));
  SPREKK_ASSERT(cut >= cells.begin() && cut <= cells.end(), first, middle, last);
  // Equal coordinates are ordered by index, so that the cut is always the same one.
  std::nth_element(cells.begin(), cut, cells.end(), [&](int a, int b) {
    const double x = mesh.cell_center[a][axis], y = mesh.cell_center[b][axis];
    return x != y ? x < y : a < b;
  });
  bisect(mesh, {cells.begin(), cut}, first, middle, share);
  bisect(mesh, {cut, cells.end()}, middle, last, share);
}

}  // namespace

void partition(Mesh& mesh, int ranks, Division division) {
  if (ranks < 1) throw std::logic_error("partition: there must be at least one rank");
  mesh.cell_rank.assign(mesh.cell_count(), 0);
  if (division == Division::compact) {
    std::vector<int> cells(mesh.cell_count());
    std::iota(cells.begin(), cells.end(), 0);
    const long long total = mesh.cell_count();
    bisect(mesh, cells, 0, ranks, [&](int rank) { return rank * total / ranks; });
  } else if (division == Division::scattered) {
    std::minstd_rand random(1);
    for (int& rank : mesh.cell_rank) rank = static_cast<int>(random() % static_cast<unsigned>(ranks));
  } else if (mesh.fracture_cell_count() > 0) {
    mesh.cell_rank[mesh.face_cells[mesh.fracture_cells[0].faces[1]][0]] = ranks - 1;
  }
  mesh.version = next_mesh_version();
}

}  // namespace sprekk
