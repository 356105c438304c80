// How far points are from faces and fracture cells.
#pragma once

#include "framework/mesh/mesh.hpp"

namespace sprekk {

/// The distance of a point from the plane of face k of a cell, times the measure of the face, m^2 (m^3 in space);
/// positive on the side of the cell. The plane of a face that is not flat goes through its centre, perpendicular to its
/// area vector, so that both cells at the face agree.
double depth_below_face(const Mesh& mesh, int cell, int k, const Point& x);

/// Whether a point lies in a cell whose faces are bent, or outside by at most `slack` (m): bent faces are replaced by
/// triangles, with which cells leave no gaps. False in a plane, and for cells without quadrilaterals.
bool parts_hold(const Mesh& mesh, int cell, const Point& x, double slack);

/// m, from a point to the nearest one of a fracture cell.
double distance_to_fracture_cell(const Mesh& mesh, int cell, const Point& x);

}  // namespace sprekk
