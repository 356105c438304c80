#include "framework/meshing/gmsh_module/gmsh_module.hpp"

#include <gmsh.h>

#include <algorithm>

#include "framework/meshing/gmsh_module/gmsh_model.hpp"
#include "framework/module/define_module.hpp"

namespace sprekk {
namespace {

/// gmsh numbers points, lines and nodes from 1.
int tag(int number) { return number + 1; }

std::vector<int> tags(const std::vector<int>& numbers) {
  std::vector<int> result;
  for (const int number : numbers) result.push_back(tag(number));
  return result;
}

void add_geometry(const PlanarLines& lines) {
  for (std::size_t i = 0; i < lines.points.size(); ++i)
    gmsh::model::geo::addPoint(lines.points[i][0], lines.points[i][1], 0, 0, tag(static_cast<int>(i)));
  for (std::size_t i = 0; i < lines.lines.size(); ++i)
    gmsh::model::geo::addLine(tag(lines.lines[i][0]), tag(lines.lines[i][1]), tag(static_cast<int>(i)));
  const int loop = gmsh::model::geo::addCurveLoop(tags(lines.outline));
  const int surface = gmsh::model::geo::addPlaneSurface({loop});
  gmsh::model::geo::synchronize();
  if (!lines.inner.empty()) gmsh::model::mesh::embed(1, tags(lines.inner), 2, surface);
}

PlanarTriangles fetch_mesh(const PlanarLines& lines) {
  PlanarTriangles mesh;
  std::vector<std::size_t> found, elements;
  std::vector<double> coordinates, parameters;
  gmsh::model::mesh::getNodes(found, coordinates, parameters, -1, -1, false, false);
  std::vector<int> number(found.empty() ? 0 : *std::max_element(found.begin(), found.end()) + 1);
  for (std::size_t i = 0; i < found.size(); ++i) {
    number[found[i]] = static_cast<int>(i);
    mesh.nodes.push_back({coordinates[3 * i], coordinates[3 * i + 1]});
  }
  found.clear();
  constexpr int three_node_triangle = 2;
  gmsh::model::mesh::getElementsByType(three_node_triangle, elements, found);
  for (std::size_t i = 0; i + 2 < found.size(); i += 3)
    mesh.triangles.push_back({number[found[i]], number[found[i + 1]], number[found[i + 2]]});

  const auto nodes_of = [&](int dim, std::size_t entity) {
    std::vector<std::size_t> nodes;
    coordinates.clear();
    parameters.clear();
    gmsh::model::mesh::getNodes(nodes, coordinates, parameters, dim, tag(static_cast<int>(entity)), dim == 1, false);
    std::vector<int> numbers;
    for (const std::size_t node : nodes) numbers.push_back(number[node]);
    return numbers;
  };
  for (std::size_t i = 0; i < lines.lines.size(); ++i) mesh.line_nodes.push_back(nodes_of(1, i));
  for (std::size_t i = 0; i < lines.points.size(); ++i) mesh.point_nodes.push_back(nodes_of(0, i).at(0));
  return mesh;
}

class Module final : public GmshModule {
 public:
  PlanarTriangles triangles(const PlanarLines& lines) const override {
    PlanarTriangles mesh;
    const GmshModel model;
    model.run("mesh the geometry", [&] {
      add_geometry(lines);
      gmsh::model::mesh::setSizeCallback([&](int, int, double x, double y, double) { return lines.size_at(x, y); });
      gmsh::option::setNumber("Mesh.RandomFactor", lines.random_factor);
      gmsh::model::mesh::generate(2);
      mesh = fetch_mesh(lines);
    });
    return mesh;
  }
};

}  // namespace
}  // namespace sprekk

SPREKK_DEFINE_MODULE(sprekk::GmshModule, sprekk::Module)
