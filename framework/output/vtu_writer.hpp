// Fields on the mesh as files for ParaView.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "framework/field/output_field.hpp"

namespace sprekk {

OutputField output_field(const Field& field);  ///< its current values

/// "quantity[unit]", the name of every written column and array; a plain number is "quantity[1]".
std::string labelled(const std::string& quantity, const std::string& unit);

/// Whether fields on cells are written at points, too.
enum class PointData { only_fields_on_nodes, of_cells_too };

/// Writes the cells with the fields on cells and nodes, those on faces as means of cells, and the region of each cell;
/// other fields are left out. Vectors have three components, as ParaView expects: in a plane the third one is 0.
/// Tensors are written as they are. Both name their components (component_names). Throws std::logic_error for
/// a field of the wrong size, std::runtime_error when the file cannot be written. Points get the values of cells by
/// cells_to_nodes, under the same names.
void write_matrix_vtu(const std::filesystem::path& file, const Mesh& mesh, const std::vector<OutputField>& fields,
                      PointData points = PointData::only_fields_on_nodes);

/// Writes the fracture cells (lines; triangles and quadrilaterals in space) with the fields on them, and the number of
/// each cell's fracture. Pairs on fracture cells are components in the frame of the cell, so they become two arrays,
/// "name.normal[unit]" and "name.tangential[unit]"; a field on walls becomes "name.plus[unit]" and "name.minus[unit]".
/// Other fields are left out.
void write_fracture_vtu(const std::filesystem::path& file, const Mesh& mesh, const std::vector<OutputField>& fields);

/// In space: writes the lines along which fractures end in the rock, edge by edge in the order of fronts(), with the
/// fields on ridges and the number of each edge's fracture. Other fields are left out. In a plane it has no lines.
void write_front_vtu(const std::filesystem::path& file, const Mesh& mesh, const std::vector<OutputField>& fields);

/// A line that continues a fracture and is not in the mesh.
struct OutputLine {
  int fracture;
  std::vector<Point> points;  ///< m
};

/// Writes the segments of lines, and the number of each segment's fracture.
void write_line_vtu(const std::filesystem::path& file, const std::vector<OutputLine>& lines);

}  // namespace sprekk
