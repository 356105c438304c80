#include "framework/output/vtu_writer.hpp"

#include <fmt/format.h>

#include <bit>
#include <cstdint>
#include <stdexcept>

#include "framework/output/atomic_file.hpp"
#include "framework/output/xml_escape.hpp"

namespace sprekk {
namespace {

template <class T>
constexpr const char* type_name = nullptr;
template <>
constexpr const char* type_name<double> = "Float64";
template <>
constexpr const char* type_name<std::int32_t> = "Int32";
template <>
constexpr const char* type_name<std::int64_t> = "Int64";
template <>
constexpr const char* type_name<std::uint8_t> = "UInt8";

/// VTK's XML format of unstructured grids (the VTK user's guide, "VTK file formats"): arrays are described by section,
/// and their values follow raw, each with its number of bytes before it. Their library writes the same in hundreds of
/// small pieces, with threads that find the range of each array.
struct Grid {
  int point_count = 0, cell_count = 0;
  std::string point_data, cell_data, points, cells;
  std::string values;

  template <class T>
  void add(std::string& section, const std::string& name, int components, const std::vector<T>& array) {
    section += fmt::format(
        "        <DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"appended\" offset=\"{}\"/>\n",
        type_name<T>, xml_escaped(name), components, values.size());
    const std::uint64_t bytes = array.size() * sizeof(T);
    values.append(reinterpret_cast<const char*>(&bytes), sizeof bytes);
    values.append(reinterpret_cast<const char*>(array.data()), bytes);
  }

  void write(const std::filesystem::path& file) const {
    write_atomically(
        file,
        fmt::format("<?xml version=\"1.0\"?>\n"
                    "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"{}\" header_type=\"UInt64\">\n"
                    "  <UnstructuredGrid>\n"
                    "    <Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n"
                    "      <PointData>\n{}      </PointData>\n"
                    "      <CellData>\n{}      </CellData>\n"
                    "      <Points>\n{}      </Points>\n"
                    "      <Cells>\n{}      </Cells>\n"
                    "    </Piece>\n"
                    "  </UnstructuredGrid>\n"
                    "  <AppendedData encoding=\"raw\">\n   _{}\n"
                    "  </AppendedData>\n"
                    "</VTKFile>\n",
                    std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian", point_count, cell_count,
                    point_data, cell_data, points, cells, values));
  }
};

/// Every `stride`-th entity from `first` on; fields on walls interleave the two sides.
void add_field(Grid& grid, std::string& section, const OutputField& field, const std::string& name, int first = 0,
               int stride = 1) {
  const int components = field.components;
  const int written = components == dimension ? 3 : components;
  const int count = static_cast<int>(field.values.size()) / components / stride;
  std::vector<double> array;
  array.reserve(static_cast<std::size_t>(count) * written);
  for (int i = 0; i < count; ++i) {
    const double* in = field.values.data() + (i * stride + first) * components;
    for (int c = 0; c < written; ++c) array.push_back(c < components ? in[c] : 0.0);
  }
  grid.add(section, labelled(name, field.unit), written, array);
}

/// Two points make a line, three a triangle, four a quadrilateral.
template <class PointsOfCell>
void set_cells(Grid& grid, int count, const PointsOfCell& points_of_cell) {
  constexpr std::uint8_t line = 3, triangle = 5, quadrilateral = 9;
  std::vector<std::int64_t> connectivity, ends;
  std::vector<std::uint8_t> types;
  for (int i = 0; i < count; ++i) {
    const auto& points = points_of_cell(i);
    connectivity.insert(connectivity.end(), points.begin(), points.end());
    ends.push_back(static_cast<std::int64_t>(connectivity.size()));
    types.push_back(points.size() == 2 ? line : points.size() == 3 ? triangle : quadrilateral);
  }
  grid.cell_count = count;
  grid.add(grid.cells, "connectivity", 1, connectivity);
  grid.add(grid.cells, "offsets", 1, ends);
  grid.add(grid.cells, "types", 1, types);
}

template <class Position>
void set_points(Grid& grid, int count, const Position& position) {
  std::vector<double> coordinates;
  for (int i = 0; i < count; ++i) coordinates.insert(coordinates.end(), {position(i).x(), position(i).y(), 0});
  grid.point_count = count;
  grid.add(grid.points, "Points", 3, coordinates);
}

void add_on_fracture_cells(Grid& grid, const OutputField& field) {
  if (field.components != dimension) return add_field(grid, grid.cell_data, field, field.name);
  OutputField numbers = field;  // as two numbers a cell instead of a pair
  numbers.components = 1;
  add_field(grid, grid.cell_data, numbers, field.name + ".normal", 0, dimension);
  add_field(grid, grid.cell_data, numbers, field.name + ".tangential", 1, dimension);
}

void require_size(const OutputField& field, const Mesh& mesh) {
  if (field.values.size() != static_cast<Eigen::Index>(entity_count(mesh, field.location)) * field.components)
    throw std::logic_error("output of " + field.name + ": wrong number of values");
}

}  // namespace

OutputField output_field(const Field& field) {
  return {field.name(), field.spec().unit, field.spec().location, field.spec().components, field.now()};
}

std::string labelled(const std::string& quantity, const std::string& unit) {
  return quantity + "[" + (unit.empty() ? "1" : unit) + "]";
}

void write_matrix_vtu(const std::filesystem::path& file, const Mesh& mesh, const std::vector<OutputField>& fields) {
  Grid grid;
  set_points(grid, mesh.node_count(), [&](int i) { return mesh.nodes[i]; });
  set_cells(grid, mesh.cell_count(), [&](int i) -> const Ring& { return mesh.cell_nodes[i]; });
  grid.add(grid.cell_data, "region", 1, std::vector<std::int32_t>(mesh.cell_region.begin(), mesh.cell_region.end()));
  for (const OutputField& field : fields) {
    require_size(field, mesh);
    if (field.location == Location::cell) add_field(grid, grid.cell_data, field, field.name);
    if (field.location == Location::node) add_field(grid, grid.point_data, field, field.name);
  }
  grid.write(file);
}

void write_fracture_vtu(const std::filesystem::path& file, const Mesh& mesh, const std::vector<OutputField>& fields) {
  Grid grid;
  const int cell_count = mesh.fracture_cell_count();
  set_points(grid, static_cast<int>(mesh.fracture_points.size()),
             [&](int i) { return mesh.fracture_points[i].position; });
  set_cells(grid, cell_count, [&](int i) -> const std::array<int, 2>& { return mesh.fracture_cells[i].points; });
  std::vector<std::int32_t> fracture;
  for (const FractureCell& cell : mesh.fracture_cells) fracture.push_back(cell.fracture);
  grid.add(grid.cell_data, "fracture", 1, fracture);
  for (const OutputField& field : fields) {
    require_size(field, mesh);
    if (field.location == Location::fracture_cell) add_on_fracture_cells(grid, field);
    if (field.location == Location::wall) {
      add_field(grid, grid.cell_data, field, field.name + ".plus", static_cast<int>(Wall::plus), 2);
      add_field(grid, grid.cell_data, field, field.name + ".minus", static_cast<int>(Wall::minus), 2);
    }
  }
  grid.write(file);
}

}  // namespace sprekk
