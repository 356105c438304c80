#include "framework/output/mesh_record.hpp"

#include <algorithm>
#include <cstring>
#include <nlohmann/json.hpp>

#include "framework/mesh/build_mesh.hpp"

namespace sprekk {
namespace {

// Points and small arrays lie in memory as their values one after the other, which is how they are stored.
std::span<const double> values(const std::vector<Point>& points) {
  return {reinterpret_cast<const double*>(points.data()), points.size() * dimension};
}

template <std::size_t n>
std::span<const int> values(const std::vector<std::array<int, n>>& lists) {
  return {reinterpret_cast<const int*>(lists.data()), lists.size() * n};
}

template <class Item, class Value>
std::vector<Item> grouped(const std::vector<Value>& values, const std::string& path) {
  static_assert(sizeof(Item) % sizeof(Value) == 0);
  constexpr std::size_t n = sizeof(Item) / sizeof(Value);
  if (values.size() % n != 0) throw Hdf5Error("array " + path + " has a wrong length");
  std::vector<Item> items(values.size() / n);
  if (!items.empty()) std::memcpy(static_cast<void*>(items.data()), values.data(), values.size() * sizeof(Value));
  return items;
}

std::vector<Point> read_points(const Hdf5Reader& file, const std::string& path) {
  return grouped<Point>(file.doubles(path), path);
}

template <std::size_t n>
std::vector<std::array<int, n>> read_lists(const Hdf5Reader& file, const std::string& path) {
  return grouped<std::array<int, n>>(file.integers(path), path);
}

void write_names(Hdf5Writer& file, const std::string& path, const std::vector<std::string>& names) {
  file.text(path, nlohmann::json(names).dump());
}

void write_adjacency(Hdf5Writer& file, const std::string& path, const Adjacency& adjacency) {
  file.integers(path + "/offsets", adjacency.offsets);
  file.integers(path + "/items", adjacency.items);
}

template <class List>
void append(Adjacency& adjacency, const List& items) {
  adjacency.items.insert(adjacency.items.end(), items.begin(), items.end());
  adjacency.offsets.push_back(static_cast<int>(adjacency.items.size()));
}

template <class Columns>
void append(std::vector<double>& numbers, const Columns& columns) {
  numbers.insert(numbers.end(), columns.data(), columns.data() + columns.size());
}

Adjacency read_adjacency(const Hdf5Reader& file, const std::string& path) {
  Adjacency adjacency{file.integers(path + "/offsets"), file.integers(path + "/items")};
  if (adjacency.offsets.empty() || adjacency.offsets.front() != 0 ||
      adjacency.offsets.back() != static_cast<int>(adjacency.items.size()) ||
      !std::is_sorted(adjacency.offsets.begin(), adjacency.offsets.end()))
    throw Hdf5Error("array " + path + " contradicts itself");
  return adjacency;
}

template <class List>
void write_lists(Hdf5Writer& file, const std::string& path, const std::vector<List>& lists) {
  Adjacency flat;
  for (const List& list : lists) append(flat, list);
  write_adjacency(file, path, flat);
}

template <std::size_t n>
bool assign(std::array<int, n>& list, std::span<const int> items) {
  if (items.size() == n) std::ranges::copy(items, list.begin());
  return items.size() == n;
}

[[maybe_unused]] bool assign(Ring& ring, std::span<const int> items) {
  if (items.size() == 3) ring = Ring(items[0], items[1], items[2]);
  if (items.size() == 4) ring = Ring(items[0], items[1], items[2], items[3]);
  return items.size() == 3 || items.size() == 4;
}

template <int capacity>
bool assign(ShortList<capacity>& list, std::span<const int> items) {
  if (items.size() > capacity) return false;
  for (const int item : items) list.push_back(item);
  return true;
}

template <class List>
std::vector<List> read_lists_of(const Hdf5Reader& file, const std::string& path) {
  const Adjacency flat = read_adjacency(file, path);
  std::vector<List> lists(flat.size());
  for (int i = 0; i < flat.size(); ++i)
    if (!assign(lists[i], flat[i])) throw Hdf5Error("array " + path + " contradicts itself");
  return lists;
}

void write_fractures(Hdf5Writer& file, const Mesh& mesh) {
  std::vector<std::string> names;
  std::vector<int> ranges;
  for (const Fracture& fracture : mesh.fractures) {
    names.push_back(fracture.name);
    ranges.insert(ranges.end(), {fracture.first_cell, fracture.cell_count});
  }
  write_names(file, "mesh/fractures/names", names);
  file.integers("mesh/fractures/ranges", ranges);

  std::vector<int> topology;
  std::vector<double> geometry;
  std::vector<int> grown;
  Adjacency ridges;
  for (const FractureCell& cell : mesh.fracture_cells) {
    grown.push_back(cell.grown);
    topology.insert(topology.end(), {cell.fracture, cell.faces[0], cell.faces[1]});
    append(ridges, cell.ridges);
    append(geometry, cell.center);
    geometry.push_back(cell.measure);
    append(geometry, cell.normal);
    append(geometry, cell.tangents);
  }
  file.integers("mesh/fracture_cells/topology", topology);
  file.doubles("mesh/fracture_cells/geometry", geometry);
  file.integers("mesh/fracture_cells/grown", grown);
  write_adjacency(file, "mesh/fracture_cells/ridges", ridges);

  std::vector<double> centers, measures;
  std::vector<int> kinds;
  Adjacency cells;
  for (const Ridge& ridge : mesh.ridges) {
    append(centers, ridge.center);
    measures.push_back(ridge.measure);
    kinds.insert(kinds.end(), {static_cast<int>(ridge.kind), ridge.side});
    append(cells, ridge.cells);
  }
  file.doubles("mesh/ridges/centers", centers);
  file.doubles("mesh/ridges/measures", measures);
  file.integers("mesh/ridges/kinds", kinds);
  write_adjacency(file, "mesh/ridges/cells", cells);

  Adjacency junction_cells, junction_ridges;
  for (const Junction& junction : mesh.junctions) {
    append(junction_cells, junction.cells);
    append(junction_ridges, junction.ridges);
  }
  write_adjacency(file, "mesh/junctions/cells", junction_cells);
  write_adjacency(file, "mesh/junctions/ridges", junction_ridges);
}

void read_fractures(const Hdf5Reader& file, Mesh& mesh) {
  const auto names = file.texts("mesh/fractures/names");
  const auto ranges = read_lists<2>(file, "mesh/fractures/ranges");
  if (names.size() != ranges.size()) throw Hdf5Error("array mesh/fractures/ranges has a wrong length");
  for (std::size_t i = 0; i < names.size(); ++i) mesh.fractures.push_back({names[i], ranges[i][0], ranges[i][1]});

  const auto topology = read_lists<3>(file, "mesh/fracture_cells/topology");
  const std::string geometry_path = "mesh/fracture_cells/geometry";
  // Centre, length, normal and tangents, as they are written.
  constexpr int normal_at = dimension + 1, tangents_at = normal_at + dimension;
  constexpr int numbers = tangents_at + dimension * (dimension - 1);
  const auto geometry = grouped<std::array<double, numbers>>(file.doubles(geometry_path), geometry_path);
  const std::vector<int> grown = file.integers("mesh/fracture_cells/grown");
  const auto around = read_lists_of<FaceRidges>(file, "mesh/fracture_cells/ridges");
  if (topology.size() != geometry.size() || topology.size() != grown.size() || topology.size() != around.size())
    throw Hdf5Error("array " + geometry_path + " has a wrong length");
  for (std::size_t i = 0; i < topology.size(); ++i) {
    const auto& t = topology[i];
    const auto& g = geometry[i];
    mesh.fracture_cells.push_back({t[0],
                                   {t[1], t[2]},
                                   around[i],
                                   Point(g.data()),
                                   g[dimension],
                                   Point(g.data() + normal_at),
                                   Tangents(g.data() + tangents_at),
                                   grown[i] != 0});
  }

  const auto centers = read_points(file, "mesh/ridges/centers");
  const std::vector<double> measures = file.doubles("mesh/ridges/measures");
  const auto kinds = read_lists<2>(file, "mesh/ridges/kinds");
  const Adjacency cells = read_adjacency(file, "mesh/ridges/cells");
  if (kinds.size() != centers.size() || measures.size() != centers.size() ||
      cells.size() != static_cast<int>(centers.size()))
    throw Hdf5Error("array mesh/ridges/kinds has a wrong length");
  for (int i = 0; i < cells.size(); ++i)
    mesh.ridges.push_back({centers[i],
                           measures[i],
                           {cells[i].begin(), cells[i].end()},
                           static_cast<Ridge::Kind>(kinds[i][0]),
                           kinds[i][1]});

  const Adjacency junction_cells = read_adjacency(file, "mesh/junctions/cells");
  const Adjacency junction_ridges = read_adjacency(file, "mesh/junctions/ridges");
  if (junction_cells.size() != junction_ridges.size())
    throw Hdf5Error("array mesh/junctions/ridges has a wrong length");
  for (int i = 0; i < junction_cells.size(); ++i)
    mesh.junctions.push_back(
        {{junction_cells[i].begin(), junction_cells[i].end()}, {junction_ridges[i].begin(), junction_ridges[i].end()}});
}

void require_consistent(const Mesh& mesh) {
  const std::size_t cells = mesh.cell_nodes.size(), faces = mesh.face_nodes.size(), nodes = mesh.nodes.size();
  const bool is_consistent =
      mesh.cell_faces.size() == cells && mesh.cell_center.size() == cells && mesh.cell_measure.size() == cells &&
      mesh.cell_region.size() == cells && mesh.cell_rank.size() == cells && mesh.face_cells.size() == faces &&
      mesh.face_center.size() == faces && mesh.face_measure.size() == faces && mesh.face_normal.size() == faces &&
      mesh.face_side.size() == faces && mesh.face_fracture_cell.size() == faces &&
      mesh.node_cells.size() == static_cast<int>(nodes) && mesh.node_faces.size() == static_cast<int>(nodes);
  if (!is_consistent) throw Hdf5Error("the arrays of the mesh contradict one another");
}

}  // namespace

void write_mesh(Hdf5Writer& file, const Mesh& mesh) {
  file.doubles("mesh/nodes", values(mesh.nodes));
  write_lists(file, "mesh/cell_nodes", mesh.cell_nodes);
  write_lists(file, "mesh/cell_faces", mesh.cell_faces);
  write_lists(file, "mesh/face_nodes", mesh.face_nodes);
  file.integers("mesh/face_cells", values(mesh.face_cells));
  file.doubles("mesh/cell_center", values(mesh.cell_center));
  file.doubles("mesh/cell_area", mesh.cell_measure);
  file.doubles("mesh/face_center", values(mesh.face_center));
  file.doubles("mesh/face_length", mesh.face_measure);
  file.doubles("mesh/face_normal", values(mesh.face_normal));
  write_adjacency(file, "mesh/node_cells", mesh.node_cells);
  write_adjacency(file, "mesh/node_faces", mesh.node_faces);
  file.integers("mesh/face_side", mesh.face_side);
  write_names(file, "mesh/side_names", mesh.side_names);
  file.integers("mesh/cell_region", mesh.cell_region);
  write_names(file, "mesh/region_names", mesh.region_names);
  file.integers("mesh/face_fracture_cell", mesh.face_fracture_cell);
  file.integers("mesh/cell_rank", mesh.cell_rank);
  write_fractures(file, mesh);
}

Mesh read_mesh(const Hdf5Reader& file) {
  Mesh mesh;
  mesh.version = next_mesh_version();
  mesh.nodes = read_points(file, "mesh/nodes");
  mesh.cell_nodes = read_lists_of<CellNodes>(file, "mesh/cell_nodes");
  mesh.cell_faces = read_lists_of<CellFaces>(file, "mesh/cell_faces");
  mesh.face_nodes = read_lists_of<FaceNodes>(file, "mesh/face_nodes");
  mesh.face_cells = read_lists<2>(file, "mesh/face_cells");
  mesh.cell_center = read_points(file, "mesh/cell_center");
  mesh.cell_measure = file.doubles("mesh/cell_area");
  mesh.face_center = read_points(file, "mesh/face_center");
  mesh.face_measure = file.doubles("mesh/face_length");
  mesh.face_normal = read_points(file, "mesh/face_normal");
  mesh.node_cells = read_adjacency(file, "mesh/node_cells");
  mesh.node_faces = read_adjacency(file, "mesh/node_faces");
  mesh.face_side = file.integers("mesh/face_side");
  mesh.side_names = file.texts("mesh/side_names");
  mesh.cell_region = file.integers("mesh/cell_region");
  mesh.region_names = file.texts("mesh/region_names");
  mesh.face_fracture_cell = file.integers("mesh/face_fracture_cell");
  mesh.cell_rank = file.integers("mesh/cell_rank");
  read_fractures(file, mesh);
  require_consistent(mesh);
  return mesh;
}

bool is_same_mesh(const Mesh& a, const Mesh& b) {
  const auto is_same_cell = [](const FractureCell& x, const FractureCell& y) {
    return x.fracture == y.fracture && x.faces == y.faces && x.ridges == y.ridges;
  };
  return a.nodes == b.nodes && a.cell_nodes == b.cell_nodes && a.face_nodes == b.face_nodes &&
         std::equal(a.fracture_cells.begin(), a.fracture_cells.end(), b.fracture_cells.begin(), b.fracture_cells.end(),
                    is_same_cell);
}

}  // namespace sprekk
