#include "framework/mesh/space/fronts.hpp"

#include <map>
#include <set>
#include <utility>

namespace sprekk {

namespace {

/// The edges of one fracture, by the node at which they begin.
class Edges {
 public:
  explicit Edges(const Mesh& mesh) : mesh_(mesh) {}

  void add(int ridge) {
    RimEdge edge = rim_edge(mesh_, ridge);
    const Point along = edge.axes.rightCols(1);
    if (along.dot(mesh_.nodes[edge.nodes[1]] - mesh_.nodes[edge.nodes[0]]) < 0) std::swap(edge.nodes[0], edge.nodes[1]);
    ends_.insert(edge.nodes[1]);
    from_.emplace(edge.nodes[0], std::pair(ridge, edge));
  }

  /// Joins the edges to lines, those with two ends first. Takes the edges away.
  std::vector<FrontLine> lines(int fracture) {
    std::vector<int> starts;
    for (const auto& [node, edge] : from_)
      if (!ends_.contains(node)) starts.push_back(node);
    std::vector<FrontLine> found;
    for (const int node : starts) found.push_back(line_from(fracture, node));
    while (!from_.empty()) found.push_back(line_from(fracture, from_.begin()->first));
    return found;
  }

 private:
  FrontLine line_from(int fracture, const int start) {
    FrontLine front{fracture, {}, {}, false};
    int node = start;
    for (auto next = from_.find(node); next != from_.end(); next = from_.find(node)) {
      front.ridges.push_back(next->second.first);
      front.edges.push_back(next->second.second);
      node = front.edges.back().nodes[1];
      from_.erase(next);
      if (node == start) break;
    }
    front.is_closed = node == start;
    return front;
  }

  const Mesh& mesh_;
  std::multimap<int, std::pair<int, RimEdge>> from_;
  std::set<int> ends_;
};

}  // namespace

std::vector<FrontLine> fronts(const Mesh& mesh) {
  std::vector<Edges> of_fracture(mesh.fractures.size(), Edges(mesh));
  for (int ridge = 0; ridge < static_cast<int>(mesh.ridges.size()); ++ridge)
    if (mesh.ridges[ridge].kind == Ridge::Kind::tip)
      of_fracture[mesh.fracture_cells[mesh.ridges[ridge].cells[0]].fracture].add(ridge);
  std::vector<FrontLine> all;
  for (int fracture = 0; fracture < static_cast<int>(of_fracture.size()); ++fracture)
    for (FrontLine& front : of_fracture[fracture].lines(fracture)) all.push_back(std::move(front));
  return all;
}

}  // namespace sprekk
