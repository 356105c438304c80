#include "framework/meshing/conforming/require_conforming.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

#include "framework/config/input_error.hpp"
#include "framework/mesh/plane/planar.hpp"
#include "framework/meshing/conforming/plane/outer_boundary.hpp"

namespace sprekk {
namespace {

using Kind = OuterBoundary::Contact::Kind;

/// Edges of a hole from which some ten cells are missing. A hole that is meant is rounder, or has a group.
constexpr std::size_t few_edges = 12;
constexpr std::size_t most_places = 3;  // that a message names: more are not read

/// "2 nodes lie on the inside of an edge, at (1, 2) and (3, 4)".
std::string at_places(const std::string& what, const std::vector<Point>& places) {
  std::string text = fmt::format("{} {}, at ", places.size(), what);
  const std::size_t told = std::min(places.size(), most_places);
  for (std::size_t i = 0; i < told; ++i) text += (i == 0 ? "" : ", ") + to_text(places[i]);
  return text + (told < places.size() ? ", …" : "");
}

std::string text_of(const std::vector<OuterBoundary::Contact>& contacts) {
  std::string text;
  for (const auto& [kind, one, several] :
       {std::tuple(Kind::side_on_side, "pair of edges lies on one another and has two pairs of nodes",
                   "pairs of edges lie on one another and have nodes of their own"),
        {Kind::node_on_edge, "node lies on the inside of an edge", "nodes lie on the inside of an edge"},
        {Kind::gap, "node has a gap to the cells beside it", "nodes have a gap to the cells beside them"},
        {Kind::overlap, "place has cells that overlap", "places have cells that overlap"}}) {
    std::vector<Point> places;
    double widest = 0;
    for (const OuterBoundary::Contact& contact : contacts) {
      if (contact.kind != kind) continue;
      places.push_back(contact.at);
      widest = std::max(widest, contact.width);
    }
    if (places.empty()) continue;
    text += (text.empty() ? "" : "; ") + at_places(places.size() == 1 ? one : several, places);
    if (kind == Kind::gap) text += fmt::format(", of up to {:.2g} m", widest);
  }
  return text;
}

}  // namespace

std::vector<std::string> require_conforming(const RawMesh& mesh, const FaceTable& edges,
                                            const std::vector<bool>& has_group) {
  const OuterBoundary boundary(mesh.nodes, mesh.cells, edges);
  const std::vector<OuterBoundary::Contact> contacts = boundary.contacts();
  if (!contacts.empty())
    throw InputError("its cells do not fit together: " + text_of(contacts) +
                     "; nothing passes from one cell to the other there. Join nodes at one place (gmsh: Mesh > "
                     "Coherence), and make the parts together, so that they have common edges; where a fracture is "
                     "meant, give it one group of curves");
  std::vector<Point> small;
  std::vector<std::string> notes;
  for (const OuterBoundary::Loop& loop : boundary.loops()) {
    if (!loop.is_hole || std::ranges::any_of(loop.edges, [&](int edge) { return has_group[edge]; })) continue;
    Point center = Point::Zero();
    for (const int edge : loop.edges) center += boundary.middle(edge) / static_cast<double>(loop.edges.size());
    if (loop.edges.size() <= few_edges)
      small.push_back(center);
    else
      notes.push_back(
          fmt::format("the mesh has a hole of {} edges around {} that no group of curves names: it belongs "
                      "to the side 'boundary' (no cell covers it) give it a group, to set its conditions",
                      loop.edges.size(), to_text(center)));
  }
  if (!small.empty())
    throw InputError(
        "cells are missing: " +
        at_places(small.size() == 1 ? "hole of few edges is in no group" : "holes of few edges are in no group",
                  small) +
        ". Add the cells, or give the edges of a hole that is meant a group of curves");
  return notes;
}

}  // namespace sprekk
