#include "framework/meshing/conforming/plane/outer_boundary.hpp"

#include <algorithm>
#include <map>

#include "framework/mesh/mesh.hpp"
#include "framework/mesh/plane/cell_shape.hpp"
#include "framework/round_off.hpp"

namespace sprekk {
namespace {

/// A gap that is narrower is an error of coordinates and not a part of the domain, of the shorter edge at it: round-off
/// of coordinates in a file.
constexpr double least_gap = 1e-3;

std::vector<int> outer_edges(const FaceTable& edges) {
  std::vector<int> outer;
  for (int edge = 0; edge < edges.size(); ++edge)
    if (edges.is_outer(edge)) outer.push_back(edge);
  return outer;
}

std::vector<Segment> segments_of(const std::vector<int>& outer, const FaceTable& edges,
                                 const std::vector<Point>& nodes) {
  std::vector<Segment> segments;
  for (const int edge : outer) segments.push_back({nodes[edges.nodes(edge)[0]], nodes[edges.nodes(edge)[1]]});
  return segments;
}

}  // namespace

OuterBoundary::OuterBoundary(const std::vector<Point>& nodes, const std::vector<Ring>& cells, const FaceTable& edges)
    : nodes_(nodes),
      cells_(cells),
      edges_(edges),
      outer_(outer_edges(edges)),
      segments_(segments_of(outer_, edges, nodes)),
      tree_(segments_) {
  if (outer_.empty()) return;
  Point low = segments_[0].from, high = low;
  for (const Segment& edge : segments_) {
    low = low.cwiseMin(edge.from);
    high = high.cwiseMax(edge.from);
  }
  extent_ = (high - low).norm();
  round_off_ = rounding::same * extent_;
}

Point OuterBoundary::middle(int edge) const {
  return 0.5 * (nodes_[edges_.nodes(edge)[0]] + nodes_[edges_.nodes(edge)[1]]);
}

bool OuterBoundary::share_a_node(int edge, int other) const {
  const auto& [a, b] = edges_.nodes(edge);
  const auto& [c, d] = edges_.nodes(other);
  return a == c || a == d || b == c || b == d;
}

int OuterBoundary::twin(int edge) const {
  const auto& [from, to] = edges_.nodes(edge);
  for (const int i : tree_.near({nodes_[from], nodes_[to]}, round_off_)) {
    const int other = outer_[i];
    if (other == edge) continue;
    const auto& [first, last] = edges_.nodes(other);
    if (are_one_place(first, to) && are_one_place(last, from)) return other;
  }
  return none;
}

std::vector<OuterBoundary::Loop> OuterBoundary::loops() const {
  std::map<int, int> edge_from;  // by its first node
  for (const int edge : outer_)
    if (!edge_from.emplace(edges_.nodes(edge)[0], edge).second) return {};
  std::vector<Loop> loops;
  while (!edge_from.empty()) {
    Loop loop{{}, false};
    std::vector<Point> corners;
    for (auto next = edge_from.begin(); next != edge_from.end();) {
      const int edge = next->second;
      edge_from.erase(next);
      loop.edges.push_back(edge);
      corners.push_back(nodes_[edges_.nodes(edge)[0]]);
      next = edge_from.find(edges_.nodes(edge)[1]);
    }
    loop.is_hole = signed_area(corners) < 0;
    loops.push_back(std::move(loop));
  }
  return loops;
}

/// How many times cells cover a point that lies on no outer edge: the crossings of a ray to the right, each counted
/// with its sense.
int OuterBoundary::cover(const Point& x) const {
  int count = 0;
  for (const int i : tree_.near({x, x + Point(2 * extent_, 0)}, 0)) {
    const auto& [from, to] = segments_[i];
    const bool rises = from.y() <= x.y() && to.y() > x.y(), falls = from.y() > x.y() && to.y() <= x.y();
    if (!rises && !falls) continue;
    const double side = cross(to - from, x - from);
    if (rises && side > 0) ++count;
    if (falls && side < 0) --count;
  }
  return count;
}

/// The contact of a node with the inside of an outer edge. `shortest`: the length of the shortest outer edge at the
/// node, m.
std::optional<OuterBoundary::Contact> OuterBoundary::contact_of(int node, double shortest, int i) const {
  using Kind = Contact::Kind;
  const auto& [first, last] = edges_.nodes(outer_[i]);
  if (node == first || node == last) return std::nullopt;
  const Point& x = nodes_[node];
  const double gap = distance(x, segments_[i]);
  if (are_one_place(node, first) || are_one_place(node, last)) return std::nullopt;  // maybe of twins
  if (gap <= round_off_) return Contact{Kind::node_on_edge, x};
  if (gap > least_gap * std::min(shortest, segments_[i].length())) return std::nullopt;
  const Point along = segments_[i].to - segments_[i].from;
  const double t = std::clamp((x - segments_[i].from).dot(along) / along.squaredNorm(), 0.0, 1.0);
  const int between = cover(0.5 * (x + segments_[i].from + t * along));
  if (between == 1) return std::nullopt;
  return Contact{between == 0 ? Kind::gap : Kind::overlap, x, gap};
}

std::vector<OuterBoundary::Contact> OuterBoundary::contacts() const {
  std::vector<Contact> contacts;
  for (const int edge : outer_)
    if (twin(edge) > edge) contacts.push_back({Contact::Kind::side_on_side, middle(edge)});
  std::map<int, double> shortest;  // outer edge at a node
  for (std::size_t i = 0; i < outer_.size(); ++i)
    for (const int node : edges_.nodes(outer_[i])) {
      const auto [known, is_new] = shortest.emplace(node, segments_[i].length());
      if (!is_new) known->second = std::min(known->second, segments_[i].length());
    }
  for (const auto& [node, length] : shortest) {
    std::optional<Contact> worst;
    for (const int i : tree_.near({nodes_[node], nodes_[node]}, least_gap * length + round_off_)) {
      const std::optional<Contact> contact = contact_of(node, length, i);
      if (contact && (!worst || contact->kind < worst->kind)) worst = contact;
    }
    if (worst) contacts.push_back(*worst);
  }
  Point crossing;
  for (std::size_t i = 0; i < outer_.size(); ++i)
    for (const int j : tree_.near(segments_[i], 0))
      if (j < static_cast<int>(i) && !share_a_node(outer_[i], outer_[j]) &&
          cross_inside(segments_[i], segments_[j], crossing))
        contacts.push_back({Contact::Kind::overlap, crossing});
  if (!contacts.empty()) return contacts;
  // Without contacts, each loop lies as a whole in what others enclose or outside of it.
  for (const Loop& loop : loops()) {
    const Point inside = centroid(nodes_, cells_[edges_.cells(loop.edges.front())[0]]);
    if (cover(inside) > 1) contacts.push_back({Contact::Kind::overlap, inside});
  }
  return contacts;
}

}  // namespace sprekk
