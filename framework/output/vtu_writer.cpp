#include "framework/output/vtu_writer.hpp"

#include <array>
#include <stdexcept>

#include "framework/field/cells_to_nodes.hpp"
#include "framework/field/component_names.hpp"
#include "framework/field/weights_in_cell.hpp"
#include "framework/mesh/space/fronts.hpp"
#include "framework/module/module.hpp"
#include "framework/output/atomic_file.hpp"
#include "framework/output/vtk_module/vtk_module.hpp"
#include "framework/output/xml_escape.hpp"

namespace sprekk {
namespace {

/// Every `stride`-th entity from `first` on; fields on walls interleave the two sides.
void add_field(std::vector<GridData::Array>& arrays, const OutputField& field, const std::string& name, int first = 0,
               int stride = 1) {
  const int components = field.components;
  const int written = components == dimension ? 3 : components;
  const int count = static_cast<int>(field.values.size()) / components / stride;
  // VTK 9.1 writes names as they are: quotes and brackets in them would break the file.
  GridData::Array array{xml_escaped(labelled(name, field.unit)), written, {}, false, component_names(components)};
  if (components == dimension) array.component_names.resize(written, "z");
  array.values.reserve(static_cast<std::size_t>(count) * written);
  for (int i = 0; i < count; ++i) {
    const double* in = field.values.data() + (i * stride + first) * components;
    for (int c = 0; c < written; ++c) array.values.push_back(c < components ? in[c] : 0.0);
  }
  arrays.push_back(std::move(array));
}

GridData::Array integers(const std::string& name) { return {name, 1, {}, true}; }

template <class Points>
void add_cell(GridData& grid, const Points& points) {
  grid.cell_points.insert(grid.cell_points.end(), points.begin(), points.end());
  grid.cell_ends.push_back(static_cast<std::int64_t>(grid.cell_points.size()));
}

void add_point(GridData& grid, const Point& position) {
  Eigen::Vector3d in_space = Eigen::Vector3d::Zero();
  in_space.head<dimension>() = position;
  grid.points.insert(grid.points.end(), in_space.begin(), in_space.end());
}

void write(const std::filesystem::path& file, const GridData& grid) {
  write_atomically(file, module<VtkModule>("vtk").text_of(grid));
}

void add_on_fracture_cells(GridData& grid, const OutputField& field) {
  if (field.components != dimension) return add_field(grid.on_cells, field, field.name);
  OutputField numbers = field;  // as `dimension` numbers a cell instead of a vector
  numbers.components = 1;
  add_field(grid.on_cells, numbers, field.name + ".normal", 0, dimension);
  for (int k = 1; k < dimension; ++k) {
    const std::string which = dimension == 2 ? "" : std::to_string(k);
    add_field(grid.on_cells, numbers, field.name + ".tangential" + which, k, dimension);
  }
}

/// In a plane the ridges are the points; in space the nodes of the plus sides.
void add_fracture_cells(GridData& grid, const Mesh& mesh) {
  grid.cell_dimension = dimension - 1;
  if (dimension == 2) {
    for (const Ridge& ridge : mesh.ridges) add_point(grid, ridge.center);
    for (const FractureCell& cell : mesh.fracture_cells) add_cell(grid, cell.ridges);
    return;
  }
  std::vector<int> number(mesh.node_count(), none);
  for (const FractureCell& cell : mesh.fracture_cells) {
    FaceNodes nodes = mesh.face_nodes[cell.faces[0]];
    for (int& node : nodes) {
      int& point = number[node];
      if (point == none) {
        point = grid.point_count();
        add_point(grid, mesh.nodes[node]);
      }
      node = point;
    }
    add_cell(grid, nodes);
  }
}

void require_size(const OutputField& field, const Mesh& mesh) {
  if (field.location == Location::listed) return;  // has no place in a picture
  if (field.values.size() != static_cast<Eigen::Index>(entity_count(mesh, field.location)) * field.components)
    throw std::logic_error("output of " + field.name + ": wrong number of values");
}

OutputField at_nodes(const SparseMatrix& to_nodes, OutputField field) {
  Vector values(to_nodes.rows() * field.components);
  for (int c = 0; c < field.components; ++c) {
    const auto of_component = Eigen::seqN(c, to_nodes.cols(), field.components);
    values(Eigen::seqN(c, to_nodes.rows(), field.components)) = to_nodes * Vector(field.values(of_component));
  }
  field.location = Location::node;
  field.values = std::move(values);
  return field;
}

}  // namespace

OutputField output_field(const Field& field) {
  return {field.name(), field.spec().unit, field.spec().location, field.spec().components, field.now()};
}

std::string labelled(const std::string& quantity, const std::string& unit) {
  return quantity + "[" + (unit.empty() ? "1" : unit) + "]";
}

void write_matrix_vtu(const std::filesystem::path& file, const Mesh& mesh, const std::vector<OutputField>& fields,
                      PointData points) {
  GridData grid;
  const SparseMatrix to_nodes = points == PointData::of_cells_too ? cells_to_nodes(mesh) : SparseMatrix();
  const auto add_on_cells = [&](const OutputField& field) {
    add_field(grid.on_cells, field, field.name);
    if (points == PointData::of_cells_too) add_field(grid.on_points, at_nodes(to_nodes, field), field.name);
  };
  for (const Point& node : mesh.nodes) add_point(grid, node);
  grid.cell_dimension = dimension;
  for (const CellNodes& nodes : mesh.cell_nodes) add_cell(grid, nodes);
  GridData::Array region = integers("region");
  region.values.assign(mesh.cell_region.begin(), mesh.cell_region.end());
  grid.on_cells.push_back(std::move(region));
  for (const OutputField& field : fields) {
    require_size(field, mesh);
    if (field.location == Location::cell) add_on_cells(field);
    if (field.location == Location::node) add_field(grid.on_points, field, field.name);
    if (field.location == Location::face) {
      OutputField means = field;
      means.location = Location::cell;
      means.values = means_of_cells(mesh, field.location, field.components, field.values);
      add_on_cells(means);
    }
  }
  write(file, grid);
}

void write_fracture_vtu(const std::filesystem::path& file, const Mesh& mesh, const std::vector<OutputField>& fields) {
  GridData grid;
  add_fracture_cells(grid, mesh);
  GridData::Array fracture = integers("fracture");
  for (const FractureCell& cell : mesh.fracture_cells) fracture.values.push_back(cell.fracture);
  grid.on_cells.push_back(std::move(fracture));
  for (const OutputField& field : fields) {
    require_size(field, mesh);
    if (field.location == Location::fracture_cell) add_on_fracture_cells(grid, field);
    if (field.location == Location::wall) {
      add_field(grid.on_cells, field, field.name + ".plus", static_cast<int>(Wall::plus), 2);
      add_field(grid.on_cells, field, field.name + ".minus", static_cast<int>(Wall::minus), 2);
    }
  }
  write(file, grid);
}

void write_front_vtu(const std::filesystem::path& file, const Mesh& mesh, const std::vector<OutputField>& fields) {
  GridData grid;
  grid.cell_dimension = 1;
  GridData::Array fracture = integers("fracture");
  std::vector<int> ridges;
  if constexpr (dimension == 3) {  // in a plane tips are points
    for (const FrontLine& front : fronts(mesh)) {
      const int first = grid.point_count(), count = static_cast<int>(front.edges.size());
      for (const RimEdge& edge : front.edges) add_point(grid, mesh.nodes[edge.nodes[0]]);
      if (!front.is_closed) add_point(grid, mesh.nodes[front.edges.back().nodes[1]]);
      for (int i = 0; i < count; ++i) {
        const bool closes = front.is_closed && i + 1 == count;
        add_cell(grid, std::array<int, 2>{first + i, closes ? first : first + i + 1});
        fracture.values.push_back(front.fracture);
      }
      ridges.insert(ridges.end(), front.ridges.begin(), front.ridges.end());
    }
  }
  grid.on_cells.push_back(std::move(fracture));
  for (OutputField field : fields) {
    require_size(field, mesh);
    if (field.location != Location::ridge) continue;
    Vector on_fronts(static_cast<Eigen::Index>(ridges.size()) * field.components);
    for (std::size_t i = 0; i < ridges.size(); ++i)
      for (int c = 0; c < field.components; ++c)
        on_fronts[i * field.components + c] = field.values[ridges[i] * field.components + c];
    field.values = std::move(on_fronts);
    add_field(grid.on_cells, field, field.name);
  }
  write(file, grid);
}

void write_line_vtu(const std::filesystem::path& file, const std::vector<OutputLine>& lines) {
  GridData grid;
  grid.cell_dimension = 1;
  GridData::Array fracture = integers("fracture");
  for (const OutputLine& line : lines) {
    for (std::size_t i = 0; i < line.points.size(); ++i) {
      const auto point = static_cast<int>(grid.points.size() / 3);
      add_point(grid, line.points[i]);
      if (i == 0) continue;
      add_cell(grid, std::array<int, 2>{point - 1, point});
      fracture.values.push_back(line.fracture);
    }
  }
  grid.on_cells.push_back(std::move(fracture));
  write(file, grid);
}

}  // namespace sprekk
