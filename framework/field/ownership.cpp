#include "framework/field/ownership.hpp"

#include <numeric>
#include <stdexcept>
#include <utility>

#include "framework/invariants.hpp"
#include "framework/parallel/gathered.hpp"
#include "framework/parallel/parallel.hpp"

namespace sprekk {

int entity_rank(const Mesh& mesh, Location location, int entity) {
  SPREKK_EXPECT(location == Location::listed || is_index(entity, entity_count(mesh, location)), entity);
  SPREKK_EXPECT(static_cast<int>(mesh.cell_rank.size()) == mesh.cell_count(), mesh.cell_rank.size());
  switch (location) {
    case Location::cell:
      return mesh.cell_rank[entity];
    case Location::fracture_cell:
      return mesh.fracture_cell_rank(entity);
    case Location::ridge:
      return mesh.fracture_cell_rank(mesh.ridges[entity].cells[0]);
    case Location::wall:
      return mesh.fracture_cell_rank(entity / 2);
    case Location::face:
      return mesh.cell_rank[mesh.face_cells[entity][0]];
    case Location::node:
      return mesh.cell_rank[mesh.node_cells[entity][0]];
    case Location::listed:
      return 0;
  }
  throw std::logic_error("unknown location");
}

bool is_owned(const Mesh& mesh, Location location, int entity) {
  return parallel::size() == 1 || entity_rank(mesh, location, entity) == parallel::rank();
}

void exchange(const Mesh& mesh, Location location, int components, Vector& values) {
  SPREKK_EXPECT(values.size() == static_cast<Eigen::Index>(entity_count(mesh, location)) * components, values.size(),
                components);
  if (parallel::size() == 1) return;
  const int entities = static_cast<int>(values.size()) / components;
  std::vector<int> counts(parallel::size(), 0);  // of the values of each process
  for (int i = 0; i < entities; ++i) counts[entity_rank(mesh, location, i)] += components;
  Vector mine(counts[parallel::rank()]);
  for (int i = 0, next = 0; i < entities; ++i)
    if (is_owned(mesh, location, i))
      mine.segment(std::exchange(next, next + components), components) = values.segment(i * components, components);
  const Vector all = parallel::gathered(mine, counts);
  std::vector<int> next(counts.size());
  std::exclusive_scan(counts.begin(), counts.end(), next.begin(), 0);
  for (int i = 0; i < entities; ++i) {
    int& of_owner = next[entity_rank(mesh, location, i)];
    values.segment(i * components, components) =
        all.segment(std::exchange(of_owner, of_owner + components), components);
  }
}

double sum_owned(const Mesh& mesh, Location location, const Vector& values) {
  if (parallel::size() == 1) return values.sum();
  Vector owned = values;
  for (int i = 0; i < owned.size(); ++i)
    if (!is_owned(mesh, location, i)) owned[i] = 0;
  return parallel::sum(owned.sum());
}

std::vector<char> nodes_to_discretize(const Mesh& mesh) {
  if (parallel::size() == 1) return {};
  SPREKK_EXPECT(are_indices(mesh.cell_rank, parallel::size()), parallel::size());
  std::vector<char> nodes(mesh.node_count(), 0);
  for (int c = 0; c < mesh.cell_count(); ++c)
    if (mesh.cell_rank[c] == parallel::rank())
      for (const int node : mesh.cell_nodes[c]) nodes[node] = 1;
  for (int i = 0; i < mesh.fracture_cell_count(); ++i)
    if (is_owned(mesh, Location::fracture_cell, i))
      for (const int face : mesh.fracture_cells[i].faces)
        for (const int node : mesh.face_nodes[face]) nodes[node] = 1;
  return nodes;
}

}  // namespace sprekk
