#include "components/fracture_flow/tpfa/outflows.hpp"

#include <algorithm>

namespace sprekk::fracture_flow {

Outflows::Outflows(const Mesh& mesh) : mesh_(&mesh), junction_of_ridge_(mesh.ridges.size(), none) {
  for (std::size_t j = 0; j < mesh.junctions.size(); ++j)
    for (const int ridge : mesh.junctions[j].ridges) junction_of_ridge_[ridge] = static_cast<int>(j);
}

std::vector<std::pair<int, double>> Outflows::at(int cell, int ridge) const {
  std::vector<std::pair<int, double>> outflows;
  const int junction = junction_of_ridge_[ridge];
  const std::vector<int> one = {ridge};
  for (const int r : junction == none ? one : mesh_->junctions[junction].ridges) {
    const std::vector<int>& cells = mesh_->ridges[r].cells;
    if (std::ranges::count(cells, cell) > 0) outflows.emplace_back(r, cells[0] == cell ? 1 : -1);
  }
  return outflows;
}

}  // namespace sprekk::fracture_flow
