#include "framework/meshing/number_in_space.hpp"

#include "framework/mesh/order_in_space.hpp"

namespace sprekk {

namespace {

template <class Use>
void for_each_node(RawMesh::Chain& chain, const Use& use) {
  for (int& node : chain.nodes) use(node);
}

template <class Use>
void for_each_node(RawMesh::Surface& surface, const Use& use) {
  for (FaceNodes& face : surface.faces)
    for (int& node : face) use(node);
}

template <class Item>
void arrange(std::vector<Item>& items, const std::vector<int>& order) {
  std::vector<Item> arranged;
  arranged.reserve(items.size());
  for (const int i : order) arranged.push_back(items[i]);
  items = std::move(arranged);
}

}  // namespace

void number_in_space(RawMesh& mesh, const std::vector<Point>& places) {
  std::vector<Point> centers;
  centers.reserve(mesh.cells.size());
  for (const CellNodes& cell : mesh.cells) {
    Point sum = Point::Zero();
    for (const int node : cell) sum += places[node];
    centers.push_back(sum / cell.size());
  }
  const std::vector<int> cells = order_in_space(centers), nodes = order_in_space(places);
  arrange(mesh.cells, cells);
  arrange(mesh.regions, cells);
  arrange(mesh.nodes, nodes);

  std::vector<int> number(nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) number[nodes[i]] = static_cast<int>(i);
  for (CellNodes& cell : mesh.cells)
    for (int& node : cell) node = number[node];
  for (auto& edge : mesh.boundary_faces)
    for (int& node : edge.nodes) node = number[node];
  for (RawMesh::Fracture& fracture : mesh.fractures) for_each_node(fracture, [&](int& node) { node = number[node]; });
}

}  // namespace sprekk
