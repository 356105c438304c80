#include "framework/mesh/corner_weights.hpp"

#include "framework/invariants.hpp"
#include "framework/mesh/plane/planar.hpp"

namespace sprekk {

std::vector<std::pair<int, double>> corner_weights(const Mesh& mesh, int cell, const Point& x) {
  SPREKK_EXPECT(is_index(cell, mesh.cell_count()), cell, mesh.cell_count());
  const Ring& corners = mesh.cell_nodes[cell];
  const int count = corners.size();
  std::vector<std::pair<int, double>> weights;
  double sum = 0;
  for (int k = 0; k < count; ++k) {
    // The area at the corner, times those that x spans with the faces that do not touch it.
    const Point& corner = mesh.nodes[corners[k]];
    double weight = signed_area(mesh.nodes[corners.before(k)], corner, mesh.nodes[corners.after(k)]);
    for (int face = 0; face < count; ++face)
      if (corners[face] != corners[k] && corners.after(face) != corners[k])
        weight *= signed_area(x, mesh.nodes[corners[face]], mesh.nodes[corners.after(face)]);
    weights.emplace_back(corners[k], weight);
    sum += weight;
  }
  SPREKK_ASSERT(sum != 0, cell, sum);
  for (auto& [node, weight] : weights) weight /= sum;
  return weights;
}

}  // namespace sprekk
