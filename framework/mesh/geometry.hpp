// Measures, centres and normals of cells, faces and ridges.
#pragma once

#include <string>
#include <vector>

#include "framework/mesh/shapes.hpp"

namespace sprekk {

/// What a cell, or a ridge, measures.
struct Measured {
  Point center;    ///< of gravity, m
  double measure;  ///< volume, area or length, m^3, m^2, m; 1 for a point
};

/// A face with its area vector, measure · normal. The faces of a cell have area vectors that add up to zero, also where
/// they are not flat: then `measure` is less than the area.
struct FaceGeometry {
  Point center;    ///< of gravity, m
  double measure;  ///< length of the area vector, m^2 (m in a plane)
  Point normal;    ///< unit, out of the cell that has the face in this order
};

/// Of a cell whose nodes have the order of its shape. A face of four nodes is treated as the four triangles between its
/// edges and the mean of its nodes.
Measured cell_geometry(const std::vector<Point>& nodes, const CellNodes& cell);
FaceGeometry face_geometry(const std::vector<Point>& nodes, const FaceNodes& face);
Measured ridge_geometry(const std::vector<Point>& nodes, const RidgeNodes& ridge);

/// The tangents of a face with this normal, right-handed with it: (-n_y, n_x) in a plane. In space the first is
/// horizontal, along the strike, with the normal to its right as seen from above; for a horizontal face it is along x.
Tangents tangents_of(const Point& normal);

inline constexpr const char* face_name = dimension == 2 ? "edge" : "face";  ///< for messages

/// "(0.5, 1)" for messages, in m.
std::string to_text(const Point& point);

}  // namespace sprekk
