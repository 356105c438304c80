// The value of a field at a point of a cell, for any place of the field on the mesh of the medium.
#pragma once

#include <utility>
#include <vector>

#include "framework/field/field.hpp"

namespace sprekk {

/// Whether fields at this location have a value in every cell: on cells, on nodes and on faces.
bool is_in_cells(Location location);

/// Entities and weights such that sum of weight · value is the value of a field at a point x of a cell. On cells it is
/// the value of the cell; on nodes and faces it is exact for linear fields: between the corners (corner_weights), and
/// by the linear function that fits the centres of the cell's faces best. Throws std::logic_error unless is_in_cells.
std::vector<std::pair<int, double>> weights_in_cell(const Mesh& mesh, Location location, int cell, const Point& x);

/// The mean over each cell of the linear field, of `components` values each; the values themselves on cells.
Vector means_of_cells(const Mesh& mesh, Location location, int components, const Vector& values);

}  // namespace sprekk
