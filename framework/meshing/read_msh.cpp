#include "framework/meshing/read_msh.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include "framework/mesh/face_table.hpp"
#include "framework/mesh/medium.hpp"
#include "framework/mesh/mesh.hpp"
#include "framework/mesh/oriented_cells.hpp"
#include "framework/mesh/plane/cell_shape.hpp"
#include "framework/mesh/plane/planar.hpp"
#include "framework/meshing/conforming/curve_group.hpp"
#include "framework/meshing/conforming/glue_cuts.hpp"
#include "framework/meshing/conforming/require_conforming.hpp"
#include "framework/meshing/geometry.hpp"
#include "framework/meshing/msh_file.hpp"

namespace sprekk {
namespace {

/// m. Meshes that are farther from the origin, or smaller, are taken for an error of the user; squares of their lengths
/// might overflow or vanish.
constexpr double farthest = 1e12, smallest_extent = 1e-12;

/// Orders lines into one path.
class Path {
 public:
  explicit Path(const CurveGroup& group) : group_(group) {
    for (const auto& [a, b] : group.lines) {
      neighbours_[a].push_back(b);
      neighbours_[b].push_back(a);
    }
  }

  std::vector<int> nodes() const {
    int ends = 0;
    for (const auto& [node, joined] : neighbours_) {
      if (joined.size() > 2) throw InputError("fracture '" + group_.name + "' branches (a fracture is one line)");
      if (joined.size() == 1) ++ends;
    }
    if (ends == 0) throw InputError("fracture '" + group_.name + "' is a closed loop (a fracture has two ends)");
    const auto [first, second] = group_.lines.front();
    auto nodes = walk(second, first);
    std::reverse(nodes.begin(), nodes.end());
    const auto ahead = walk(first, second);
    nodes.insert(nodes.end(), ahead.begin(), ahead.end());
    if (nodes.size() != group_.lines.size() + 1) {
      throw InputError("fracture '" + group_.name +
                       "' is in several parts (a fracture is one line) give each its own group");
    }
    return nodes;
  }

 private:
  /// The nodes of the path from `node` to the end that is not on the side of `previous`.
  std::vector<int> walk(int previous, int node) const {
    std::vector<int> nodes{node};
    while (nodes.size() <= group_.lines.size()) {
      const auto& joined = neighbours_.at(node);
      if (joined.size() < 2) break;
      const int next = joined[0] == previous ? joined[1] : joined[0];
      previous = node;
      node = next;
      nodes.push_back(node);
    }
    return nodes;
  }

  const CurveGroup& group_;
  std::map<int, std::vector<int>> neighbours_;
};

class MshReader {
 public:
  explicit MshReader(std::string_view bytes) : file_(parse_msh(bytes)) {}

  RawMesh read() {
    read_nodes();
    read_cells();
    if (mesh_.cells.empty()) throw InputError("the file holds no triangles and no quadrilaterals");
    read_curves();
    return std::move(mesh_);
  }

  const std::vector<std::string>& notes() const { return notes_; }

 private:
  [[noreturn]] void fail(std::size_t place, const std::string& problem) const {
    throw InputError(file_.where(place) + ": " + problem);
  }

  std::string group_name(int dim, int tag) const {
    const auto found = file_.names.find({dim, tag});
    return found == file_.names.end() || found->second.empty() ? "group_" + std::to_string(tag) : found->second;
  }

  void read_nodes() {
    mesh_.nodes.reserve(file_.nodes.size());
    Point low = Point::Zero(), high = Point::Zero();
    double height = 0;
    for (const MshFile::Node& node : file_.nodes) {
      const auto& [x, y, z] = node.position;
      if (std::max({std::abs(x), std::abs(y), std::abs(z)}) > farthest) {
        fail(node.place, "node " + std::to_string(node.number) + " is farther than 1e12 m from the origin");
      }
      mesh_.nodes.emplace_back(x, y);
      if (mesh_.nodes.size() == 1) low = high = mesh_.nodes[0];
      low = low.cwiseMin(mesh_.nodes.back());
      high = high.cwiseMax(mesh_.nodes.back());
      height = std::max(height, std::abs(z));
    }
    const double extent = (high - low).norm();
    if (extent < smallest_extent) throw InputError("all nodes are at one place (their distance is below 1e-12 m)");
    constexpr double flat = 1e-9;  // of the extent: round-off of coordinates
    if (height > flat * extent) throw InputError("the mesh leaves the x-y plane");
  }

  int node(const MshFile::Element& element, int k) const {
    const std::uint64_t number = element.nodes[k];
    const auto found =
        std::lower_bound(file_.nodes.begin(), file_.nodes.end(), number,
                         [](const MshFile::Node& node, std::uint64_t wanted) { return node.number < wanted; });
    if (found == file_.nodes.end() || found->number != number) {
      fail(element.place, "an element names node " + std::to_string(number) +
                              ", which the file does not hold: save the mesh with all of its nodes");
    }
    return static_cast<int>(found - file_.nodes.begin());
  }

  /// The group of a cell, or none.
  int group_of(const MshFile::Element& cell) const {
    const std::vector<int>& groups = file_.group_lists[cell.group_list];
    if (groups.size() > 1) {
      fail(cell.place, "a surface belongs to two groups ('" + group_name(2, groups[0]) + "' and '" +
                           group_name(2, groups[1]) + "')");
    }
    return groups.empty() ? none : groups[0];
  }

  /// Throws InputError when a name is among `names` already.
  static void add_name(const std::string& name, const std::string& what, std::vector<std::string>& names) {
    if (std::find(names.begin(), names.end(), name) != names.end()) {
      throw InputError("two " + what + " are called '" + name + "' (what has no group is called 'boundary' or '" +
                       medium_name() + "'), rename one");
    }
    names.push_back(name);
  }

  /// Regions in the order of the numbers of their groups; cells without group come last.
  std::map<int, int> name_regions() {
    std::set<int> groups;
    bool has_rest = false;
    for (const MshFile::Element& cell : file_.cells) {
      const int group = group_of(cell);
      group == none ? void(has_rest = true) : void(groups.insert(group));
    }
    std::map<int, int> region_of_group;
    for (const int group : groups) {
      region_of_group[group] = static_cast<int>(mesh_.region_names.size());
      add_name(group_name(2, group), "regions", mesh_.region_names);
    }
    if (has_rest) {
      region_of_group[none] = static_cast<int>(mesh_.region_names.size());
      add_name(medium_name(), "regions", mesh_.region_names);
    }
    return region_of_group;
  }

  void read_cells() {
    const std::map<int, int> region_of_group = name_regions();
    mesh_.cells.reserve(file_.cells.size());
    for (const MshFile::Element& cell : file_.cells) {
      Ring ring(node(cell, 0), node(cell, 1), node(cell, 2));
      if (cell.node_count == 4) ring = Ring(ring[0], ring[1], ring[2], node(cell, 3));
      try {
        require_sound_cell(mesh_.nodes, ring);
      } catch (const InputError& error) {
        fail(cell.place, error.what());
      }
      if (signed_area(mesh_.nodes, ring) < 0) ring.turn();
      mesh_.cells.push_back(ring);
      mesh_.regions.push_back(region_of_group.at(group_of(cell)));
    }
  }

  /// The groups of curves in the order of their numbers.
  std::vector<CurveGroup> curve_groups() const {
    std::map<int, CurveGroup> curves;
    for (const MshFile::Element& line : file_.lines) {
      const std::array<int, 2> nodes{node(line, 0), node(line, 1)};
      for (const int group : file_.group_lists[line.group_list]) curves[group].lines.push_back(nodes);
    }
    std::vector<CurveGroup> list;
    for (auto& [group, curve] : curves) list.push_back({group_name(1, group), std::move(curve.lines)});
    return list;
  }

  /// Throws InputError for two cells with the same corners: files of version 2.2 contain a surface of two groups in
  /// this way.
  void refuse_doubled_cells() const {
    std::map<std::vector<int>, std::size_t> first;
    for (std::size_t c = 0; c < mesh_.cells.size(); ++c) {
      std::vector<int> corners(mesh_.cells[c].begin(), mesh_.cells[c].end());
      std::sort(corners.begin(), corners.end());
      const auto [known, is_new] = first.try_emplace(corners, c);
      if (is_new) continue;
      const MshFile::Element &one = file_.cells[known->second], &other = file_.cells[c];
      fail(other.place,
           "a cell is there twice, before at " + file_.where(one.place) + " (a surface that belongs to two groups?)");
    }
  }

  void refuse_overlapping_cells() const {
    try {
      const FaceTable edges(mesh_.nodes, mesh_.cells);
    } catch (const InputError&) {
      refuse_doubled_cells();
      throw;
    }
  }

  void read_curves() {
    refuse_overlapping_cells();
    std::vector<CurveGroup> groups = curve_groups();
    glue_cuts(mesh_, groups);
    const FaceTable edges(mesh_.nodes, mesh_.cells);
    std::vector<bool> has_side(edges.size(), false);
    for (const CurveGroup& group : groups) {
      std::size_t outer = 0;
      for (const auto& [a, b] : group.lines) {
        const int edge = edges.find({a, b});
        if (edge == none) {
          throw InputError("curve '" + group.name + "' leaves the edges of the cells near " + to_text(mesh_.nodes[a]) +
                           " (the mesh does not conform to it)");
        }
        if (!edges.is_outer(edge)) continue;
        ++outer;
        has_side[edge] = true;
        mesh_.boundary_faces.push_back({{a, b}, static_cast<int>(mesh_.side_names.size())});
      }
      if (outer == group.lines.size()) {
        add_name(group.name, "sides", mesh_.side_names);
      } else if (outer == 0) {
        add_fracture(group);
      } else {
        throw InputError("curve '" + group.name +
                         "' lies partly inside and partly on the boundary (it is neither a side nor a fracture)");
      }
    }
    notes_ = require_conforming(mesh_, edges, has_side);
    add_unnamed_sides(edges, has_side);
  }

  void add_fracture(const CurveGroup& group) {
    for (const RawMesh::Chain& other : mesh_.fractures) {
      if (other.name == group.name) throw InputError("two fractures are called '" + group.name + "', rename one");
    }
    mesh_.fractures.push_back({group.name, Path(group).nodes()});
  }

  void add_unnamed_sides(const FaceTable& edges, const std::vector<bool>& has_side) {
    int side = none;
    for (int edge = 0; edge < edges.size(); ++edge) {
      if (!edges.is_outer(edge) || has_side[edge]) continue;
      if (side == none) {
        side = static_cast<int>(mesh_.side_names.size());
        add_name("boundary", "sides", mesh_.side_names);
      }
      mesh_.boundary_faces.push_back({edges.nodes(edge), side});
    }
  }

  const MshFile file_;
  RawMesh mesh_;
  std::vector<std::string> notes_;
};

/// Throws InputError if the file cannot be read.
std::string bytes_of(const std::string& file) {
  std::error_code error;
  if (!std::filesystem::exists(file, error)) throw InputError("it does not exist or may not be read");
  if (!std::filesystem::is_regular_file(file, error)) throw InputError("it is no file");
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream bytes;
  bytes << stream.rdbuf();
  if (!stream) throw InputError("it does not exist or may not be read");
  return bytes.str();
}

}  // namespace

RawMesh read_msh(const std::string& file, const Origin& origin, std::vector<std::string>* notes) {
  try {
    const std::string bytes = bytes_of(file);
    MshReader reader(bytes);
    RawMesh mesh = reader.read();
    if (notes) *notes = reader.notes();
    return mesh;
  } catch (const InputError& error) {
    throw InputError(origin, "cannot use the mesh file '" + file + "'", error.what());
  }
}

}  // namespace sprekk
