#include "framework/mesh/read_msh.hpp"

#include <gmsh.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>

#include "framework/mesh/cell_edges.hpp"
#include "framework/mesh/cell_shape.hpp"
#include "framework/mesh/geometry.hpp"
#include "framework/mesh/gmsh_model.hpp"
#include "framework/mesh/mesh.hpp"
#include "framework/mesh/planar.hpp"

namespace sprekk {
namespace {

constexpr int two_node_line = 1, three_node_triangle = 2, four_node_quadrilateral = 3;  // gmsh's element types

struct CurveGroup {
  std::string name;
  std::vector<std::array<int, 2>> lines;
};

std::string group_name(int dim, int tag) {
  std::string name;
  gmsh::model::getPhysicalName(dim, tag, name);
  return name.empty() ? "group_" + std::to_string(tag) : name;
}

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
  /// From `node` on, away from `previous`, to the end.
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

class Reader {
 public:
  RawMesh read(const std::string& file) {
    gmsh::merge(file);
    read_nodes();
    read_cells();
    if (mesh_.cells.empty()) throw InputError("the file holds no triangles and no quadrilaterals");
    read_curves();
    return std::move(mesh_);
  }

 private:
  void read_nodes() {
    std::vector<std::size_t> tags;
    std::vector<double> coordinates, parameters;
    gmsh::model::mesh::getNodes(tags, coordinates, parameters, -1, -1, false, false);
    number_.assign(tags.empty() ? 0 : *std::max_element(tags.begin(), tags.end()) + 1, none);
    double extent = 0, height = 0;
    for (std::size_t i = 0; i < tags.size(); ++i) {
      number_[tags[i]] = static_cast<int>(i);
      mesh_.nodes.emplace_back(coordinates[3 * i], coordinates[3 * i + 1]);
      extent = std::max(extent, (mesh_.nodes.back() - mesh_.nodes.front()).norm());
      height = std::max(height, std::abs(coordinates[3 * i + 2]));
    }
    if (height > 1e-9 * extent) throw InputError("the mesh leaves the x-y plane");
  }

  int node(std::size_t tag) const {
    if (tag >= number_.size() || number_[tag] == none) {
      throw InputError("an element names node " + std::to_string(tag) + ", which the file does not hold");
    }
    return number_[tag];
  }

  [[noreturn]] static void refuse(int type, const std::string& wanted) {
    throw InputError("the file holds elements that are no " + wanted + " (gmsh type " + std::to_string(type) + ")");
  }

  std::vector<std::array<int, 2>> lines_of(int curve) const {
    std::vector<int> types;
    std::vector<std::vector<std::size_t>> tags, nodes;
    gmsh::model::mesh::getElements(types, tags, nodes, 1, curve);
    std::vector<std::array<int, 2>> lines;
    for (std::size_t i = 0; i < types.size(); ++i) {
      if (types[i] != two_node_line) refuse(types[i], "two-node lines");
      for (std::size_t n = 0; n + 2 <= nodes[i].size(); n += 2) {
        lines.push_back({node(nodes[i][n]), node(nodes[i][n + 1])});
      }
    }
    return lines;
  }

  std::vector<Ring> cells_of(int surface) const {
    std::vector<int> types;
    std::vector<std::vector<std::size_t>> tags, nodes;
    gmsh::model::mesh::getElements(types, tags, nodes, 2, surface);
    std::vector<Ring> cells;
    for (std::size_t i = 0; i < types.size(); ++i) {
      const auto at = [&](std::size_t n) { return node(nodes[i][n]); };
      if (types[i] == three_node_triangle) {
        for (std::size_t n = 0; n + 3 <= nodes[i].size(); n += 3) cells.push_back({at(n), at(n + 1), at(n + 2)});
      } else if (types[i] == four_node_quadrilateral) {
        for (std::size_t n = 0; n + 4 <= nodes[i].size(); n += 4) {
          cells.push_back({at(n), at(n + 1), at(n + 2), at(n + 3)});
        }
      } else {
        refuse(types[i], "three-node triangles or four-node quadrilaterals");
      }
    }
    return cells;
  }

  void read_cells() {
    std::map<int, int> region_of_group;
    gmsh::vectorpair groups, surfaces;
    gmsh::model::getPhysicalGroups(groups, 2);
    for (const auto& [dim, tag] : groups) {
      region_of_group[tag] = static_cast<int>(mesh_.region_names.size());
      mesh_.region_names.push_back(group_name(dim, tag));
    }
    gmsh::model::getEntities(surfaces, 2);
    int rest = none;
    for (const auto& [dim, surface] : surfaces) {
      std::vector<int> tags;
      gmsh::model::getPhysicalGroupsForEntity(dim, surface, tags);
      if (tags.size() > 1) {
        throw InputError("a surface belongs to two groups ('" + group_name(2, tags[0]) + "' and '" +
                         group_name(2, tags[1]) + "')");
      }
      const auto cells = cells_of(surface);
      if (tags.empty() && !cells.empty() && rest == none) {
        rest = static_cast<int>(mesh_.region_names.size());
        mesh_.region_names.emplace_back(default_region);
      }
      for (const Ring& cell : cells) {
        mesh_.cells.push_back(cell);
        if (signed_area(mesh_.nodes, cell) < 0) mesh_.cells.back().turn();
        mesh_.regions.push_back(tags.empty() ? rest : region_of_group.at(tags[0]));
      }
    }
  }

  std::vector<CurveGroup> curve_groups() const {
    std::vector<CurveGroup> curves;
    gmsh::vectorpair groups;
    gmsh::model::getPhysicalGroups(groups, 1);
    for (const auto& [dim, tag] : groups) {
      CurveGroup& group = curves.emplace_back(CurveGroup{group_name(dim, tag), {}});
      std::vector<int> entities;
      gmsh::model::getEntitiesForPhysicalGroup(dim, tag, entities);
      for (const int entity : entities) {
        const auto lines = lines_of(entity);
        group.lines.insert(group.lines.end(), lines.begin(), lines.end());
      }
    }
    return curves;
  }

  void read_curves() {
    const CellEdges edges(mesh_.nodes, mesh_.cells);
    std::vector<bool> has_side(edges.size(), false);
    for (const CurveGroup& group : curve_groups()) {
      if (group.lines.empty()) continue;
      std::size_t outer = 0;
      for (const auto& [a, b] : group.lines) {
        const int edge = edges.find(a, b);
        if (edge == none) {
          throw InputError("curve '" + group.name + "' leaves the edges of the cells near " + to_text(mesh_.nodes[a]) +
                           " (the mesh does not conform to it)");
        }
        if (!edges.is_outer(edge)) continue;
        ++outer;
        has_side[edge] = true;
        mesh_.boundary_edges.push_back({{a, b}, static_cast<int>(mesh_.side_names.size())});
      }
      if (outer == group.lines.size()) {
        mesh_.side_names.push_back(group.name);
      } else if (outer == 0) {
        mesh_.fractures.push_back({group.name, Path(group).nodes()});
      } else {
        throw InputError("curve '" + group.name +
                         "' lies partly inside and partly on the boundary (it is neither a side nor a fracture)");
      }
    }
    add_unnamed_sides(edges, has_side);
  }

  void add_unnamed_sides(const CellEdges& edges, const std::vector<bool>& has_side) {
    int side = none;
    for (int edge = 0; edge < edges.size(); ++edge) {
      if (!edges.is_outer(edge) || has_side[edge]) continue;
      if (side == none) {
        side = static_cast<int>(mesh_.side_names.size());
        mesh_.side_names.emplace_back("boundary");
      }
      mesh_.boundary_edges.push_back({edges.nodes(edge), side});
    }
  }

  RawMesh mesh_;
  std::vector<int> number_;  ///< of the nodes, by gmsh's tags
};

}  // namespace

RawMesh read_msh(const std::string& file, const Origin& origin) {
  const std::string problem = "cannot use the mesh file '" + file + "'";
  if (!std::ifstream(file)) throw InputError(origin, problem, "it does not exist or may not be read");
  RawMesh mesh;
  const GmshModel model;
  try {
    model.run("read the file", [&] { mesh = Reader().read(file); });
  } catch (const std::exception& error) {
    throw InputError(origin, problem, error.what());
  }
  return mesh;
}

}  // namespace sprekk
