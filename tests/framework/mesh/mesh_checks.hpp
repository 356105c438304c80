// Sample geometries, and checks that hold on every mesh.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include "framework/mesh/mesh.hpp"
#include "framework/meshing/geometry.hpp"

namespace sprekk::test {

inline constexpr double degree = std::numbers::pi / 180;

inline Geometry box(double x0, double x1, double y0, double y1) {
  Geometry geometry;
  geometry.box = {{x0, y0}, {x1, y1}, {"scene.yaml", 2, 3}};
  return geometry;
}

inline FractureGeometry fracture(const std::string& name, std::vector<Point> points, int line = 4) {
  return {name, std::move(points), std::nullopt, {"scene.yaml", line, 5}};
}

inline RegionGeometry region(const std::string& name, std::vector<Point> polygon) {
  return {name, std::move(polygon), {"scene.yaml", 9, 5}};
}

/// Sec. 5.1 of the paper: a box of 2 m with a fracture of 0.1 m at 45 degrees in its middle.
inline Geometry paper_geometry() {
  Geometry geometry = box(0, 2, 0, 2);
  const double half = 0.05 / std::sqrt(2.0);
  geometry.fractures = {fracture("main", {{1 - half, 1 - half}, {1 + half, 1 + half}})};
  return geometry;
}

/// Connected parts of the matrix, by faces between cells.
inline int component_count(const Mesh& mesh) {
  std::vector<int> root(mesh.cell_count());
  for (int i = 0; i < mesh.cell_count(); ++i) root[i] = i;
  const auto find = [&](int i) {
    while (root[i] != i) i = root[i] = root[root[i]];
    return i;
  };
  int components = mesh.cell_count();
  for (const auto& [a, b] : mesh.face_cells) {
    if (b == none || find(a) == find(b)) continue;
    root[find(a)] = find(b);
    --components;
  }
  return components;
}

inline int euler_characteristic(const Mesh& mesh) { return mesh.node_count() - mesh.face_count() + mesh.cell_count(); }

inline double total_area(const Mesh& mesh) {
  double area = 0;
  for (const double cell : mesh.cell_measure) area += cell;
  return area;
}

inline double fracture_length(const Mesh& mesh, int fracture) {
  const auto& [name, first, count] = mesh.fractures[fracture];
  double length = 0;
  for (int i = first; i < first + count; ++i) length += mesh.fracture_cells[i].measure;
  return length;
}

/// Everything that mesh.hpp promises, computed anew from node positions and cell_nodes.
inline void expect_consistent(const Mesh& mesh) {
  ASSERT_EQ(mesh.cell_region.size(), mesh.cell_nodes.size());
  ASSERT_EQ(mesh.cell_rank.size(), mesh.cell_nodes.size());
  ASSERT_EQ(mesh.face_side.size(), mesh.face_nodes.size());
  ASSERT_EQ(mesh.face_fracture_cell.size(), mesh.face_nodes.size());
  std::vector<std::vector<int>> cells_of_face(mesh.face_count());
  std::vector<std::set<int>> cells_of_node(mesh.node_count()), faces_of_node(mesh.node_count());
  for (int c = 0; c < mesh.cell_count(); ++c) {
    Point moment = Point::Zero(), normal_sum = Point::Zero();
    double perimeter = 0, twice_area = 0;
    const int corners = mesh.cell_nodes[c].size();
    ASSERT_EQ(mesh.cell_faces[c].size(), corners);
    const Point origin = mesh.nodes[mesh.cell_nodes[c][0]];
    for (int k = 0; k < corners; ++k) {
      const int a = mesh.cell_nodes[c][k], b = mesh.cell_nodes[c][(k + 1) % corners], f = mesh.cell_faces[c][k];
      const Point &p = mesh.nodes[a], &q = mesh.nodes[b];
      const bool is_first = mesh.face_cells[f][0] == c;
      ASSERT_EQ(mesh.face_nodes[f], (is_first ? std::array{a, b} : std::array{b, a}));
      ASSERT_EQ(mesh.face_cells[f][is_first ? 0 : 1], c);
      cells_of_face[f].push_back(c);
      cells_of_node[a].insert(c);
      faces_of_node[a].insert(f);
      faces_of_node[b].insert(f);
      const Point outward = (is_first ? 1 : -1) * mesh.face_normal[f];
      ASSERT_NEAR(outward.norm(), 1, 1e-14);
      ASSERT_NEAR(outward.dot(q - p), 0, 1e-14);
      ASSERT_GT(outward.dot(mesh.face_center[f] - mesh.cell_center[c]), 0);
      ASSERT_NEAR(mesh.face_measure[f], (q - p).norm(), 1e-15);
      ASSERT_NEAR((mesh.face_center[f] - (p + q) / 2).norm(), 0, 1e-15);
      normal_sum += mesh.face_measure[f] * outward;
      perimeter += mesh.face_measure[f];
      // Of the polygon, with the first corner as origin (Green's theorem).
      const Point u = p - origin, v = q - origin;
      const double twice_part = u.x() * v.y() - u.y() * v.x();
      moment += twice_part / 6 * (u + v);
      twice_area += twice_part;
    }
    ASSERT_GT(mesh.cell_measure[c], 0);
    ASSERT_NEAR(mesh.cell_measure[c], twice_area / 2, 1e-14);
    ASSERT_NEAR((mesh.cell_center[c] - origin - moment / mesh.cell_measure[c]).norm(), 0, 1e-14);
    ASSERT_LT(normal_sum.norm(), 1e-14 * perimeter);
    ASSERT_GE(mesh.cell_region[c], 0);
    ASSERT_LT(mesh.cell_region[c], static_cast<int>(mesh.region_names.size()));
  }
  int walls = 0;
  for (int f = 0; f < mesh.face_count(); ++f) {
    const bool is_wall = mesh.face_fracture_cell[f] != none, is_outer = mesh.face_side[f] != none;
    ASSERT_FALSE(is_wall && is_outer);
    ASSERT_EQ(cells_of_face[f].size(), is_wall || is_outer ? 1u : 2u);
    ASSERT_EQ(mesh.face_cells[f][1] == none, is_wall || is_outer);
    walls += is_wall ? 1 : 0;
  }
  ASSERT_EQ(walls, mesh.wall_count());
  for (int n = 0; n < mesh.node_count(); ++n) {
    ASSERT_EQ(std::vector<int>(mesh.node_cells[n].begin(), mesh.node_cells[n].end()),
              std::vector<int>(cells_of_node[n].begin(), cells_of_node[n].end()));
    ASSERT_EQ(std::vector<int>(mesh.node_faces[n].begin(), mesh.node_faces[n].end()),
              std::vector<int>(faces_of_node[n].begin(), faces_of_node[n].end()));
    ASSERT_FALSE(cells_of_node[n].empty());
  }
  for (int i = 0; i < mesh.fracture_cell_count(); ++i) {
    const FractureCell& cell = mesh.fracture_cells[i];
    const Point &from = mesh.ridges[cell.ridges[0]].center, &to = mesh.ridges[cell.ridges[1]].center;
    ASSERT_NEAR((to - from - cell.measure * cell.tangents).norm(), 0, 1e-15);
    ASSERT_NEAR((cell.tangents - Point(-cell.normal.y(), cell.normal.x())).norm(), 0, 1e-15);
    ASSERT_NEAR((cell.center - (from + to) / 2).norm(), 0, 1e-15);
    for (int wall = 0; wall < 2; ++wall) {
      const int face = cell.faces[wall];
      ASSERT_EQ(mesh.wall_face(2 * i + wall), face);
      ASSERT_EQ(mesh.face_fracture_cell[face], i);
      // The normal points out of the plus side and into the minus side.
      ASSERT_NEAR((mesh.face_normal[face] - (wall == 0 ? 1 : -1) * cell.normal).norm(), 0, 1e-13);
      const auto& [a, b] = mesh.face_nodes[face];
      ASSERT_EQ(mesh.nodes[a], wall == 0 ? from : to);
      ASSERT_EQ(mesh.nodes[b], wall == 0 ? to : from);
    }
  }
  for (const Ridge& point : mesh.ridges) {
    const bool is_between = point.kind == Ridge::Kind::inside || point.kind == Ridge::Kind::junction;
    ASSERT_EQ(point.cells.size(), is_between ? 2u : 1u);
    ASSERT_TRUE(std::is_sorted(point.cells.begin(), point.cells.end()));
    ASSERT_EQ(point.side != none, point.kind == Ridge::Kind::on_boundary);
  }
  for (const Junction& junction : mesh.junctions) {
    std::size_t next = 0;
    for (std::size_t i = 0; i < junction.cells.size(); ++i) {
      for (std::size_t j = i + 1; j < junction.cells.size(); ++j) {
        const Ridge& point = mesh.ridges.at(junction.ridges.at(next++));
        ASSERT_EQ(point.kind, Ridge::Kind::junction);
        ASSERT_EQ(point.cells, (std::vector{junction.cells[i], junction.cells[j]}));
        for (const int cell : point.cells) {
          const auto& [a, b] = mesh.fracture_cells[cell].ridges;
          ASSERT_TRUE(mesh.ridges[a].center == point.center || mesh.ridges[b].center == point.center);
        }
      }
    }
    ASSERT_EQ(next, junction.ridges.size());
  }
}

/// The message of the InputError that `work` throws, or "" with a failure.
template <class Work>
std::string input_error(const Work& work) {
  try {
    work();
  } catch (const InputError& error) {
    return error.what();
  }
  ADD_FAILURE() << "no InputError was thrown";
  return "";
}

}  // namespace sprekk::test
