#include "components/poromechanics/pinned_points.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "framework/mesh/geometry.hpp"
#include "framework/mesh/search/point_location.hpp"
#include "framework/round_off.hpp"

namespace sprekk::poromechanics {

Spec PinnedPoint::spec() {
  Spec spec("pinned point", "A point of the rock whose displacement is given in some directions.");
  spec.point("at", at, {.unit = "m", .doc = "Position; the node of the mesh that is nearest is held."});
  for (int k = 0; k < dimension; ++k)
    spec.data(std::string("displacement_") + axis_names[k], displacement_along[k],
              {.unit = "m",
               .doc = std::string("Displacement in ") + axis_names[k] + "; without it, it is free.",
               .in_time = true});
  spec.check([this](const Node& node) {
    if (!at)
      throw InputError(node.origin, "'" + node.path + "' does not say which point is held", "'at' is missing",
                       "give its position");
    if (std::ranges::none_of(displacement_along, [](const auto& given) { return given.has_value(); }))
      throw InputError(node.origin, "'" + node.path + "' holds nothing", "no displacement is given",
                       "add for example 'displacement_x: 0 m'");
  });
  return spec;
}

void add_pinned_points(Spec& spec, PinnedPoints& points) {
  static PinnedPoint example;
  spec.named_sections(
      "pinned", example.spec(),
      [&points](const std::string& key, const Origin& origin) {
        points[key].origin = origin;
        return points[key].spec();
      },
      {.doc = "Points by name whose displacement is given. They keep from moving and turning as a whole "
              "a rock whose sides have loads only; where these are not in balance, a point bears the "
              "rest."});
}

int pinned_node(const PinnedPoint& point, const std::string& name, const Mesh& mesh) {
  int nearest = 0;
  const auto away = [&](int node) { return (mesh.nodes[node] - *point.at).norm(); };
  for (int node = 1; node < mesh.node_count(); ++node)
    if (away(node) < away(nearest)) nearest = node;
  double size = 0;  // of the cells there
  for (const int cell : mesh.node_cells[nearest])
    for (const int node : mesh.cell_nodes[cell]) size = std::max(size, (mesh.nodes[node] - mesh.nodes[nearest]).norm());
  if (away(nearest) > rounding::far_above * size && PointLocation(mesh).cell_at(*point.at) == none)
    throw InputError(point.origin, "the pinned point '" + name + "' lies outside of the rock",
                     fmt::format("the nearest node of the mesh is at {}", to_text(mesh.nodes[nearest])),
                     "move it into the rock");
  for (const int face : mesh.node_faces[nearest])
    if (mesh.face_fracture_cell[face] != none)
      throw InputError(point.origin, "the pinned point '" + name + "' lies on a fracture",
                       fmt::format("the nearest node of the mesh, at {}, is that of one wall, and the other would move",
                                   to_text(mesh.nodes[nearest])),
                       "move it into the rock beside");
  return nearest;
}

}  // namespace sprekk::poromechanics
