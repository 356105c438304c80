#include "framework/meshing/read_msh.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include "framework/mesh/face_table.hpp"
#include "framework/mesh/geometry.hpp"
#include "framework/mesh/medium.hpp"
#include "framework/mesh/mesh.hpp"
#include "framework/mesh/oriented_cells.hpp"
#include "framework/meshing/conforming/face_group.hpp"
#include "framework/meshing/conforming/plane/glue_cuts.hpp"
#include "framework/meshing/conforming/require_conforming.hpp"
#include "framework/meshing/geometry.hpp"
#include "framework/meshing/msh_file.hpp"
#include "framework/round_off.hpp"

namespace sprekk {
namespace {

/// m. Meshes that are farther from the origin, or smaller, are treated as an error of the user; squares of their
/// lengths might overflow or vanish.
constexpr double farthest = 1e12, smallest_extent = 1e-12;

class MshReader {
 public:
  explicit MshReader(std::string_view bytes) : file_(parse_msh(bytes)) {}

  RawMesh read() {
    read_nodes();
    read_cells();
    if (mesh_.cells.empty())
      throw InputError(std::string("the file holds no ") +
                       (dimension == 2 ? "triangles and no quadrilaterals" : "tetrahedra, no wedges and no hexahedra"));
    read_faces();
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
      const Eigen::Vector3d x(node.position.data());
      if (x.cwiseAbs().maxCoeff() > farthest) {
        fail(node.place, "node " + std::to_string(node.number) + " is farther than 1e12 m from the origin");
      }
      mesh_.nodes.push_back(x.head<dimension>());
      if (mesh_.nodes.size() == 1) low = high = mesh_.nodes[0];
      low = low.cwiseMin(mesh_.nodes.back());
      high = high.cwiseMax(mesh_.nodes.back());
      if (dimension == 2) height = std::max(height, std::abs(x.z()));
    }
    const double extent = (high - low).norm();
    if (extent < smallest_extent) throw InputError("all nodes are at one place (their distance is below 1e-12 m)");
    if (height > rounding::same * extent) throw InputError("the mesh leaves the x-y plane");
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
      fail(cell.place, std::string(dimension == 2 ? "a surface" : "a volume") + " belongs to two groups ('" +
                           group_name(dimension, groups[0]) + "' and '" + group_name(dimension, groups[1]) + "')");
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
      add_name(group_name(dimension, group), "regions", mesh_.region_names);
    }
    if (has_rest) {
      region_of_group[none] = static_cast<int>(mesh_.region_names.size());
      add_name(medium_name(), "regions", mesh_.region_names);
    }
    return region_of_group;
  }

  /// The nodes of a cell, or of a face, in the order of gmsh, which is that of shapes.
  template <class Nodes>
  Nodes nodes_of(const MshFile::Element& element) const {
    if constexpr (std::is_same_v<Nodes, Ring>) {
      Ring ring(node(element, 0), node(element, 1), node(element, 2));
      if (element.node_count == 4) ring = Ring(ring[0], ring[1], ring[2], node(element, 3));
      return ring;
    } else if constexpr (std::is_same_v<Nodes, std::array<int, 2>>) {
      return {node(element, 0), node(element, 1)};
    } else {
      Nodes nodes;
      for (int k = 0; k < element.node_count; ++k) nodes.push_back(node(element, k));
      return nodes;
    }
  }

  void read_cells() {
    const std::map<int, int> region_of_group = name_regions();
    mesh_.cells.reserve(file_.cells.size());
    for (const MshFile::Element& cell : file_.cells) {
      mesh_.cells.push_back(nodes_of<CellNodes>(cell));
      try {
        require_sound_cell(mesh_.nodes, mesh_.cells.back());
      } catch (const InputError& error) {
        fail(cell.place, error.what());
      }
      mesh_.regions.push_back(region_of_group.at(group_of(cell)));
    }
    mesh_.cells = oriented_cells(mesh_);
  }

  /// The groups of curves, or of surfaces, in the order of their numbers.
  std::vector<FaceGroup> face_groups() const {
    std::map<int, FaceGroup> groups;
    for (const MshFile::Element& face : file_.faces) {
      const FaceNodes nodes = nodes_of<FaceNodes>(face);
      for (const int group : file_.group_lists[face.group_list]) groups[group].faces.push_back(nodes);
    }
    std::vector<FaceGroup> list;
    for (auto& [number, group] : groups) list.push_back({group_name(dimension - 1, number), std::move(group.faces)});
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
      fail(other.place, "a cell is there twice, before at " + file_.where(one.place) + " (a " +
                            (dimension == 2 ? "surface" : "volume") + " that belongs to two groups?)");
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

  void read_faces() {
    refuse_overlapping_cells();
    std::vector<FaceGroup> groups = face_groups();
    if constexpr (dimension == 2) glue_cuts(mesh_, groups);
    const FaceTable faces(mesh_.nodes, mesh_.cells);
    std::vector<bool> has_side(faces.size(), false);
    for (const FaceGroup& group : groups) {
      const std::string what = (dimension == 2 ? "curve '" : "surface '") + group.name + "'";
      std::size_t outer = 0;
      for (const FaceNodes& nodes : group.faces) {
        const int face = faces.find(nodes);
        if (face == none) {
          throw InputError(what + " leaves the " + face_name + "s of the cells near " + to_text(mesh_.nodes[nodes[0]]) +
                           " (the mesh does not conform to it)");
        }
        if (!faces.is_outer(face)) continue;
        ++outer;
        has_side[face] = true;
        mesh_.boundary_faces.push_back({nodes, static_cast<int>(mesh_.side_names.size())});
      }
      if (outer == group.faces.size()) {
        add_name(group.name, "sides", mesh_.side_names);
      } else if (outer == 0) {
        add_fracture(group);
      } else {
        throw InputError(what +
                         " lies partly inside and partly on the boundary (it is neither a side nor a fracture) make "
                         "two groups of it");
      }
    }
    notes_ = require_conforming(mesh_, faces, has_side);
    add_unnamed_sides(faces, has_side);
  }

  void add_fracture(const FaceGroup& group) {
    for (const RawMesh::Fracture& other : mesh_.fractures) {
      if (other.name == group.name) throw InputError("two fractures are called '" + group.name + "', rename one");
    }
    mesh_.fractures.push_back(fracture_of(group));
  }

  void add_unnamed_sides(const FaceTable& faces, const std::vector<bool>& has_side) {
    int side = none;
    for (int face = 0; face < faces.size(); ++face) {
      if (!faces.is_outer(face) || has_side[face]) continue;
      if (side == none) {
        side = static_cast<int>(mesh_.side_names.size());
        add_name("boundary", "sides", mesh_.side_names);
      }
      mesh_.boundary_faces.push_back({faces.nodes(face), side});
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

int dimension_of_mesh_file(const std::string& file) {
  try {
    return dimension_of_msh(bytes_of(file));
  } catch (const InputError&) {
    return 2;
  }
}

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
