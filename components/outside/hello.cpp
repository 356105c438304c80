#include "components/outside/hello.hpp"

#include <utility>

namespace sprekk::outside {

namespace {

Vector numbers(const std::vector<double>& values) {
  return Eigen::Map<const Vector>(values.data(), static_cast<Eigen::Index>(values.size()));
}

template <class Items, class Get>
Vector points(const Items& items, const Get& get) {
  Vector values(dimension * static_cast<Eigen::Index>(items.size()));
  Eigen::Index next = 0;
  for (const auto& item : items) {
    values.segment<dimension>(next) = get(item);
    next += dimension;
  }
  return values;
}

/// Lists of different lengths: where each begins, and one behind the last; and all of them, one after the other.
template <class Lists>
void add_lists(OutsideMessage& hello, const std::string& name, const Lists& lists) {
  std::vector<int> begins = {0}, all;
  for (const auto& list : lists) {
    for (const int item : list) all.push_back(item);
    begins.push_back(static_cast<int>(all.size()));
  }
  hello.ints.emplace_back(name, std::move(all));
  hello.ints.emplace_back(name + "_begin", std::move(begins));
}

std::string lines(const std::vector<std::string>& texts) {
  std::string all;
  for (const std::string& text : texts) all += text + "\n";
  return all;
}

}  // namespace

void add_mesh(const Mesh& mesh, OutsideMessage& hello) {
  const auto same = [](const Point& point) { return point; };
  hello.reals.emplace_back("mesh.nodes", points(mesh.nodes, same));
  hello.reals.emplace_back("mesh.cell_center", points(mesh.cell_center, same));
  hello.reals.emplace_back("mesh.cell_measure", numbers(mesh.cell_measure));
  hello.reals.emplace_back("mesh.face_center", points(mesh.face_center, same));
  hello.reals.emplace_back("mesh.face_measure", numbers(mesh.face_measure));
  hello.reals.emplace_back("mesh.face_normal", points(mesh.face_normal, same));
  add_lists(hello, "mesh.cell_nodes", mesh.cell_nodes);
  add_lists(hello, "mesh.face_nodes", mesh.face_nodes);
  std::vector<int> cells_of_faces;
  for (const auto& cells : mesh.face_cells) cells_of_faces.insert(cells_of_faces.end(), cells.begin(), cells.end());
  hello.ints.emplace_back("mesh.face_cells", std::move(cells_of_faces));
  hello.ints.emplace_back("mesh.face_side", mesh.face_side);
  hello.ints.emplace_back("mesh.cell_region", mesh.cell_region);
  hello.ints.emplace_back("mesh.face_fracture_cell", mesh.face_fracture_cell);
  hello.texts.emplace_back("mesh.sides", lines(mesh.side_names));
  hello.texts.emplace_back("mesh.regions", lines(mesh.region_names));
  std::vector<std::string> fractures;
  for (const Fracture& fracture : mesh.fractures) fractures.push_back(fracture.name);
  hello.texts.emplace_back("mesh.fractures", lines(fractures));
  const auto& cells = mesh.fracture_cells;
  std::vector<int> fracture, walls;
  std::vector<double> measure;
  for (const FractureCell& cell : cells) {
    fracture.push_back(cell.fracture);
    walls.insert(walls.end(), cell.faces.begin(), cell.faces.end());
    measure.push_back(cell.measure);
  }
  hello.ints.emplace_back("mesh.fracture_cell_fracture", std::move(fracture));
  hello.ints.emplace_back("mesh.fracture_cell_faces", std::move(walls));
  hello.reals.emplace_back("mesh.fracture_cell_measure", numbers(measure));
  hello.reals.emplace_back("mesh.fracture_cell_center", points(cells, [](const auto& cell) { return cell.center; }));
  hello.reals.emplace_back("mesh.fracture_cell_normal", points(cells, [](const auto& cell) { return cell.normal; }));
}

}  // namespace sprekk::outside
