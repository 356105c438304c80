#include "components/fine_fracture/quarter_point/mesh/fine_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "components/fine_fracture/quarter_point/mesh/outside_mesh.hpp"
#include "framework/mesh/build_mesh.hpp"
#include "framework/mesh/plane/planar.hpp"
#include "framework/triangulation/rounded_drawing.hpp"

namespace sprekk::fine_fracture {
namespace {

void validate(const FineMeshOptions& options) {
  if (!(options.tip_size > 0) || !(options.far_size > 0) || !(options.growth > 0) || !(options.kink_size >= 0)) {
    throw std::invalid_argument("fine level: mesh sizes and their growth must be positive");
  }
  if (options.sectors < 6 || options.sectors % 2 != 0) {
    throw std::invalid_argument("fine level: a rosette needs an even number of sectors, at least 6");
  }
}

/// The wanted edge length: grows with the distance from rosettes, kinks, junctions and from points where the kind of
/// walls changes.
class SizeField {
 public:
  /// `bends`: as bends_of.
  SizeField(const FineGeometry& geometry, const std::vector<TipRoom>& rooms, const FineMeshOptions& options,
            const std::vector<std::vector<double>>& bends)
      : options_(options) {
    for (const TipRoom& room : rooms) {
      const double edge = 2 * room.radius * std::sin(std::numbers::pi / options.sectors);
      sources_.push_back({room.position, edge - options.growth * room.radius});
    }
    const double kink_size = options.kink_size > 0 ? options.kink_size : options.tip_size / 4;
    for (std::size_t c = 0; c < geometry.cracks.size(); ++c) {
      const CrackPath& crack = geometry.cracks[c];
      for (std::size_t i = 1; i + 1 < crack.points.size(); ++i) {
        // Stresses are nearly regular at points where the walls hardly bend, but singular where prescribed jumps begin.
        const bool changes = crack.walls[i - 1] != crack.walls[i];
        constexpr double right_angle = std::numbers::pi / 2;
        sources_.push_back(
            {crack.points[i],
             changes ? kink_size : std::max(kink_size, options.far_size * (1 - 4 * bends[c][i] / right_angle))});
      }
    }
    for (const CrackJunction& junction : junctions(geometry)) sources_.push_back({junction.position, kink_size});
  }

  double at(const Point& x) const {
    double size = options_.far_size;
    for (const auto& [position, base] : sources_) {
      size = std::min(size, base + options_.growth * (x - position).norm());
    }
    if (options_.size_limit) size = std::min(size, options_.size_limit(x));
    return size;
  }

 private:
  struct Source {
    Point position;
    double base;  ///< the edge length there; it may be negative inside of a rosette
  };
  FineMeshOptions options_;
  std::vector<Source> sources_;
};

/// Adds the rosettes' triangles behind the others, tip by tip, and the tips to the chains.
void add_rosettes(const std::vector<TipRoom>& rooms, OutsideMesh& outside) {
  RawMesh& raw = outside.raw;
  for (std::size_t t = 0; t < rooms.size(); ++t) {
    const int tip = static_cast<int>(raw.nodes.size());
    raw.nodes.push_back(rooms[t].position);
    const auto& corners = outside.rosettes[t];
    for (std::size_t k = 0; k < corners.size(); ++k) {
      raw.cells.push_back({tip, corners[k], corners[(k + 1) % corners.size()]});
    }
    auto& chain = raw.fractures[rooms[t].crack].nodes;
    chain.insert(rooms[t].is_last ? chain.end() : chain.begin(), tip);
  }
  raw.regions.assign(raw.cells.size(), 0);
  raw.region_names = {"rock"};
}

/// From the split triangulation to quadratic elements: the nodes on the edges are numbered as the mesh's faces.
class Builder {
 public:
  Builder(const FineGeometry& geometry, const std::vector<TipRoom>& rooms, int sectors, const Mesh& mesh)
      : geometry_(geometry), mesh_(mesh), tip_of_node_(mesh.node_count(), none) {
    fine_.corner_count = mesh.node_count();
    fine_.nodes = mesh.nodes;
    fine_.nodes.insert(fine_.nodes.end(), mesh.face_center.begin(), mesh.face_center.end());
    const int first_of_rosettes = mesh.cell_count() - sectors * static_cast<int>(rooms.size());
    for (std::size_t t = 0; t < rooms.size(); ++t) {
      const int node = tip_node(rooms[t], mesh.cell_nodes[first_of_rosettes + sectors * t]);
      fine_.tips.push_back({rooms[t], node, {}});
      tip_of_node_[node] = static_cast<int>(t);
    }
    for (int c = 0; c < mesh.cell_count(); ++c) {
      add_element(c, c < first_of_rosettes ? none : (c - first_of_rosettes) / sectors);
    }
    for (int f = 0; f < mesh.face_count(); ++f) {
      if (mesh.face_side[f] == none) continue;
      const auto [a, b] = mesh.face_nodes[f];
      fine_.outline_edges.push_back({{a, b, node_on(f)}, mesh.face_cells[f][0], mesh.face_side[f]});
    }
    for (std::size_t c = 0; c < geometry.cracks.size(); ++c) add_walls(static_cast<int>(c));
  }
  FineMesh take() { return std::move(fine_); }

 private:
  /// The corner of a rosette's triangle that is the tip.
  int tip_node(const TipRoom& room, const Ring& corners) const {
    const auto away = [&](int node) { return (mesh_.nodes[node] - room.position).norm(); };
    return *std::min_element(corners.begin(), corners.end(), [&](int a, int b) { return away(a) < away(b); });
  }

  int node_on(int face) const { return fine_.corner_count + face; }

  void add_element(int cell, int rosette) {
    int first = 0;
    if (rosette != none) {
      while (mesh_.cell_nodes[cell][first] != fine_.tips[rosette].node) ++first;
    }
    FineMesh::Element element{{}, rosette};
    for (int k = 0; k < 3; ++k) {
      element.nodes[k] = mesh_.cell_nodes[cell][(first + k) % 3];
      element.nodes[3 + k] = node_on(mesh_.cell_faces[cell][(first + k) % 3]);
    }
    if (rosette != none) {
      const Point& tip = fine_.nodes[element.nodes[0]];
      for (const auto& [corner, quarter] : {std::array{1, 3}, std::array{2, 5}}) {
        fine_.nodes[element.nodes[quarter]] = tip + (fine_.nodes[element.nodes[corner]] - tip) / 4;
      }
    }
    fine_.elements.push_back(element);
  }

  void add_walls(int c) {
    const CrackPath& crack = geometry_.cracks[c];
    std::vector<double> lengths{0};
    for (std::size_t i = 0; i + 1 < crack.points.size(); ++i) {
      lengths.push_back(lengths.back() + (crack.points[i + 1] - crack.points[i]).norm());
    }
    const Fracture& fracture = mesh_.fractures[c];
    double arc = 0;
    std::size_t segment = 0;
    for (int i = fracture.first_cell; i < fracture.first_cell + fracture.cell_count; ++i) {
      const FractureCell& cell = mesh_.fracture_cells[i];
      const double middle = arc + 0.5 * cell.measure;
      while (segment + 2 < lengths.size() && middle > lengths[segment + 1]) ++segment;
      FineMesh::WallEdge edge{c,   {}, {}, cell.tangents, cell.normal, arc, arc + cell.measure, crack.walls[segment],
                              none};
      for (int side = 0; side < 2; ++side) {
        auto [a, b] = mesh_.face_nodes[cell.faces[side]];
        if ((mesh_.nodes[b] - mesh_.nodes[a]).dot(cell.tangents) < 0) std::swap(a, b);
        edge.nodes[side] = {a, b, node_on(cell.faces[side])};
        edge.elements[side] = mesh_.face_cells[cell.faces[side]][0];
        for (const int node : {a, b}) {
          if (tip_of_node_[node] != none) edge.tip = tip_of_node_[node];
        }
      }
      if (edge.tip != none) note_wall_nodes(edge);
      arc = edge.to;
      fine_.wall_edges.push_back(edge);
    }
    fine_.arc_lengths.push_back(std::move(lengths));
  }

  void note_wall_nodes(const FineMesh::WallEdge& edge) {
    FineMesh::Tip& tip = fine_.tips[edge.tip];
    for (int side = 0; side < 2; ++side) {
      const EdgeNodes& nodes = edge.nodes[side];
      // Plus is to the left of the path: above when the path leads to the tip, below when it comes from it.
      const int upper_or_lower = tip.room.is_last ? side : 1 - side;
      tip.wall_nodes[upper_or_lower] = {nodes[2], nodes[0] == tip.node ? nodes[1] : nodes[0]};
    }
  }

  const FineGeometry& geometry_;
  const Mesh& mesh_;
  std::vector<int> tip_of_node_;
  FineMesh fine_;
};

/// The options in a frame whose unit has the length `unit` (m), without their last digits.
FineMeshOptions rounded_options(FineMeshOptions options, double unit) {
  constexpr int sizes_in_octave = 64;  // rounded to 1 %
  for (double* size : {&options.tip_size, &options.far_size, &options.kink_size})
    if (*size > 0) *size = rounded_in_octave(*size / unit, sizes_in_octave);
  return options;
}

Triangulated triangulate(const DrawingFrame& frame, const FineGeometry& geometry, const std::vector<TipRoom>& rooms,
                         const std::vector<std::vector<double>>& bends, const FineMeshOptions& options) {
  const SizeField sizes(geometry, rooms, options, bends);
  Triangulated made{frame, geometry, rooms, {}, {}};
  made.mesh = mesh_outside(geometry, rooms, options.sectors, [&sizes](const Point& x) { return sizes.at(x); });
  add_rosettes(rooms, made.mesh);
  return made;
}

/// A triangulation for the rounded geometry, if it can be moved to the geometry itself; and this moved one.
std::optional<OutsideMesh> made_by_rounding(const FineGeometry& geometry, const std::vector<TipRoom>& rooms,
                                            const FineMeshOptions& options, const Point& anchor, Triangulated& made) {
  if (options.size_limit) return std::nullopt;
  const RoundedGeometry rounded = rounded_geometry(geometry, rooms, anchor);
  try {
    made = triangulate(rounded.frame, rounded.geometry, rounded.rooms, rounded.bends,
                       rounded_options(options, rounded.frame.unit()));
  } catch (const std::runtime_error&) {
    return std::nullopt;
  }
  return moved_mesh(made, geometry, rooms);
}

}  // namespace

FineMesh make_fine_mesh(const FineGeometry& geometry, const FineMeshOptions& options, TriangulationKeeper* keeper) {
  validate(geometry);
  validate(options);
  const std::vector<TipRoom> rooms =
      tip_rooms(geometry, options.tip_size, keeper ? StraightPoints::end_it : StraightPoints::are_passed);
  const auto built = [&](const OutsideMesh& mesh) {
    return Builder(geometry, rooms, options.sectors, build_mesh(mesh.raw)).take();
  };
  if (!keeper) return built(triangulate({}, geometry, rooms, bends_of(geometry), options).mesh);
  if (keeper->kept)
    if (const std::optional<OutsideMesh> moved = moved_mesh(*keeper->kept, geometry, rooms)) return built(*moved);
  Triangulated made;
  std::optional<OutsideMesh> mesh = made_by_rounding(geometry, rooms, options, keeper->anchor, made);
  if (!mesh) {
    made = triangulate({}, geometry, rooms, bends_of(geometry), options);
    mesh = made.mesh;
  }
  made.outline = geometry.outline;
  keeper->kept = std::make_shared<const Triangulated>(std::move(made));
  return built(*mesh);
}

}  // namespace sprekk::fine_fracture
