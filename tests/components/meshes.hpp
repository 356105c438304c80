// Meshes that tests of the discretizations share.
#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "framework/mesh/build_mesh.hpp"
#include "framework/meshing/generate_mesh.hpp"

namespace sprekk::test {

inline Geometry box(double width, double height) {
  Geometry geometry;
  geometry.box.high = Point(width, height);
  return geometry;
}

inline MeshOptions unstructured(double size, double distortion = 0) {
  MeshOptions options;
  options.size = size;
  options.distortion = distortion;
  return options;
}

inline MeshOptions structured(int columns, int rows, double distortion = 0) {
  MeshOptions options;
  options.kind = MeshOptions::Kind::structured;
  options.cells = {columns, rows};
  options.distortion = distortion;
  return options;
}

inline MeshOptions rectangles(int columns, int rows, double distortion = 0) {
  MeshOptions options = structured(columns, rows, distortion);
  options.shape = MeshOptions::Shape::quadrilaterals;
  return options;
}

/// Mostly quadrilaterals, with triangles between them.
inline MeshOptions mixed(double size, double distortion = 0) {
  MeshOptions options = unstructured(size, distortion);
  options.shape = MeshOptions::Shape::quadrilaterals;
  return options;
}

/// A distorted unit square with two fractures, one of which ends on the boundary.
inline Mesh fractured_square(const MeshOptions& options = unstructured(0.1, 0.35)) {
  Geometry geometry = box(1, 1);
  FractureGeometry inside, through;
  inside.name = "inside";
  inside.points = {Point(0.2, 0.3), Point(0.5, 0.45), Point(0.75, 0.4)};
  through.name = "through";
  through.points = {Point(0, 0.7), Point(0.6, 0.8)};
  geometry.fractures = {inside, through};
  return generate_mesh(geometry, options);
}

/// A unit square in which a fracture leaves gaps of a fiftieth of the edge length to a side and to another one.
inline Mesh square_with_narrow_gaps() {
  Geometry geometry = box(1, 1);
  FractureGeometry main, beside;
  main.name = "main";
  main.points = {Point(0.4, 0.3), Point(0.998, 0.45)};
  beside.name = "beside";
  beside.points = {Point(0.4, 0.302), Point(0.3, 0.7)};
  geometry.fractures = {main, beside};
  return generate_mesh(geometry, unstructured(0.1));
}

/// A unit square of distorted quadrilaterals with fractures along what were grid lines, one of which bends around the
/// corner of a cell.
inline Mesh fractured_rectangles() {
  Geometry geometry = box(1, 1);
  FractureGeometry bent, through;
  bent.name = "bent";
  bent.points = {Point(0.2, 0.3), Point(0.6, 0.3), Point(0.6, 0.7)};
  through.name = "through";
  through.points = {Point(0, 0.9), Point(0.5, 0.9)};
  geometry.fractures = {bent, through};
  return generate_mesh(geometry, rectangles(10, 10, 0.4));
}

/// Rectangles between grid lines at the given coordinates (m, ascending).
inline Mesh grid_of(const std::vector<double>& x, const std::vector<double>& y) {
  RawMesh raw;
  raw.region_names = {"rock"};
  raw.side_names = {"left", "right", "bottom", "top"};
  const int columns = static_cast<int>(x.size()) - 1, rows = static_cast<int>(y.size()) - 1;
  const auto node = [&](int i, int j) { return i + (columns + 1) * j; };
  for (const double v : y)
    for (const double u : x) raw.nodes.emplace_back(u, v);
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i)
      raw.cells.push_back({node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)});
  raw.regions.assign(raw.cells.size(), 0);
  for (int j = 0; j < rows; ++j) {
    raw.boundary_faces.push_back({{node(0, j), node(0, j + 1)}, 0});
    raw.boundary_faces.push_back({{node(columns, j), node(columns, j + 1)}, 1});
  }
  for (int i = 0; i < columns; ++i) {
    raw.boundary_faces.push_back({{node(i, 0), node(i + 1, 0)}, 2});
    raw.boundary_faces.push_back({{node(i, rows), node(i + 1, rows)}, 3});
  }
  return build_mesh(raw);
}

/// Squares cut by parallel diagonals: a single triangle in two of the corners. Inner nodes are displaced.
inline Mesh square_with_single_corners(int n) {
  RawMesh raw;
  raw.region_names = {"rock"};
  raw.side_names = {"left", "right", "bottom", "top"};
  const auto node = [n](int i, int j) { return i + (n + 1) * j; };
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) {
      const bool is_inner = i > 0 && i < n && j > 0 && j < n;
      const Point shift(0.2 * ((7 * i + 3 * j) % 5 - 2) / 2, 0.2 * ((3 * i + 5 * j) % 7 - 3) / 3);
      raw.nodes.push_back((Point(i, j) + (is_inner ? shift : Point::Zero().eval())) / n);
    }
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      raw.cells.push_back({node(i, j), node(i + 1, j), node(i + 1, j + 1)});
      raw.cells.push_back({node(i, j), node(i + 1, j + 1), node(i, j + 1)});
    }
  raw.regions.assign(raw.cells.size(), 0);
  for (int i = 0; i < n; ++i) {
    raw.boundary_faces.push_back({{node(0, i), node(0, i + 1)}, 0});
    raw.boundary_faces.push_back({{node(n, i), node(n, i + 1)}, 1});
    raw.boundary_faces.push_back({{node(i, 0), node(i + 1, 0)}, 2});
    raw.boundary_faces.push_back({{node(i, n), node(i + 1, n)}, 3});
  }
  return build_mesh(raw);
}

inline bool is_outer(const Mesh& mesh, int face) { return mesh.face_cells[face][1] == none; }
inline bool is_wall(const Mesh& mesh, int face) { return is_outer(mesh, face) && mesh.face_side[face] == none; }
inline Point face_vector(const Mesh& mesh, int face) { return mesh.face_measure[face] * mesh.face_normal[face]; }

/// Sums over the faces of every cell, with the sign of the outward normal; `components` rows a face and a cell.
inline SparseMatrix divergence(const Mesh& mesh, int components) {
  std::vector<Triplet> entries;
  for (int face = 0; face < mesh.face_count(); ++face)
    for (int side = 0; side < 2; ++side)
      for (int c = 0; c < components; ++c)
        if (mesh.face_cells[face][side] != none)
          entries.emplace_back(components * mesh.face_cells[face][side] + c, components * face + c, side == 0 ? 1 : -1);
  SparseMatrix sums(components * mesh.cell_count(), components * mesh.face_count());
  sums.setFromTriplets(entries.begin(), entries.end());
  return sums;
}

/// The largest difference of two rows of an operator, over all rows.
inline double row_difference(const SparseMatrix& a, const SparseMatrix& b, int row) {
  return Vector(a.row(row) - b.row(row)).cwiseAbs().maxCoeff();
}

}  // namespace sprekk::test
