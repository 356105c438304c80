#include "framework/meshing/fracture_networks.hpp"

#include <algorithm>
#include <numeric>

namespace sprekk {

std::vector<int> fracture_networks(const Mesh& mesh, const std::vector<std::pair<int, int>>& more) {
  std::vector<int> network(mesh.fractures.size());
  std::iota(network.begin(), network.end(), 0);
  const auto connect = [&network](int a, int b) {
    const auto [low, high] = std::minmax(network[a], network[b]);
    std::replace(network.begin(), network.end(), int{high}, int{low});
  };
  for (const Junction& junction : mesh.junctions)
    for (const int cell : junction.cells)
      connect(mesh.fracture_cells[junction.cells[0]].fracture, mesh.fracture_cells[cell].fracture);
  for (const auto& [a, b] : more) connect(a, b);
  return network;
}

}  // namespace sprekk
