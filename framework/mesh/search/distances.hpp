// How far points are from faces and fracture cells.
#pragma once

#include "framework/mesh/mesh.hpp"

namespace sprekk {

/// How far a point is below face k of a cell, times the measure of the face; positive on the side of the cell. Of a
/// face that is not flat, below the plane of its centre and area vector, so that both cells at the face agree.
double depth_below_face(const Mesh& mesh, int cell, int k, const Point& x);

/// Whether a point lies in a cell whose faces are bent, or outside by at most `slack` (m): such cells, of the triangles
/// that their faces are taken for, leave no gaps. False in a plane, and for cells without quadrilaterals.
bool parts_hold(const Mesh& mesh, int cell, const Point& x, double slack);

/// m, from a point to the nearest one of a fracture cell.
double distance_to_fracture_cell(const Mesh& mesh, int cell, const Point& x);

}  // namespace sprekk
