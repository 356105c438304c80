#include "framework/meshing/conforming/plane/glue_cuts.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

#include "framework/mesh/face_table.hpp"
#include "framework/mesh/mesh.hpp"
#include "framework/meshing/conforming/plane/outer_boundary.hpp"

namespace sprekk {
namespace {

/// Which nodes are one.
class OneNode {
 public:
  explicit OneNode(std::size_t count) : first_(count) { std::iota(first_.begin(), first_.end(), 0); }
  int of(int node) {
    while (first_[node] != node) node = first_[node] = first_[first_[node]];
    return node;
  }
  void join(int a, int b) {
    const int one = of(a), other = of(b);
    first_[std::max(one, other)] = std::min(one, other);
  }

 private:
  std::vector<int> first_;
};

/// Per line its edge and the other one at the same place, or nothing if the group is no cut.
std::vector<std::array<int, 2>> pairs_of(const FaceGroup& group, const FaceTable& edges, const OuterBoundary& boundary,
                                         const std::map<int, std::set<std::string>>& groups_of_edge) {
  std::vector<std::array<int, 2>> pairs;
  for (const auto& [a, b] : group.faces) {
    const int edge = edges.find({a, b});
    const int other = edge == none || !edges.is_outer(edge) ? none : boundary.twin(edge);
    if (other == none) return {};
    const auto groups = groups_of_edge.find(other);
    if (groups != groups_of_edge.end() && groups->second.count(group.name) == 0) return {};
    pairs.push_back({edge, other});
  }
  return pairs;
}

void remove_repeated(std::vector<std::array<int, 2>>& lines) {
  std::set<std::pair<int, int>> known;
  std::erase_if(lines, [&](const auto& line) { return !known.insert(std::minmax(line[0], line[1])).second; });
}

}  // namespace

bool glue_cuts(RawMesh& mesh, std::vector<FaceGroup>& groups) {
  const FaceTable edges(mesh.nodes, mesh.cells);
  const OuterBoundary boundary(mesh.nodes, mesh.cells, edges);
  std::map<int, std::set<std::string>> groups_of_edge;
  for (const FaceGroup& group : groups)
    for (const auto& [a, b] : group.faces)
      if (const int edge = edges.find({a, b}); edge != none) groups_of_edge[edge].insert(group.name);
  OneNode one(mesh.nodes.size());
  std::vector<FaceGroup*> cuts;
  for (FaceGroup& group : groups) {
    const auto pairs = pairs_of(group, edges, boundary, groups_of_edge);
    for (const auto& [edge, other] : pairs) {
      one.join(edges.nodes(edge)[0], edges.nodes(other)[1]);
      one.join(edges.nodes(edge)[1], edges.nodes(other)[0]);
    }
    if (!pairs.empty()) cuts.push_back(&group);
  }
  if (cuts.empty()) return false;
  for (Ring& cell : mesh.cells)
    for (int& node : cell) node = one.of(node);
  for (FaceGroup& group : groups)
    for (std::array<int, 2>& line : group.faces) line = {one.of(line[0]), one.of(line[1])};
  for (FaceGroup* cut : cuts) remove_repeated(cut->faces);
  return true;
}

}  // namespace sprekk
