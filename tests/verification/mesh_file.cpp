#include "tests/verification/mesh_file.hpp"

#include <unistd.h>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>

namespace sprekk::testing {

std::string write_msh(const RawMesh& mesh, const Tensor& map, const Point& shift, const std::string& name) {
  std::string groups, nodes, elements;
  int group = 0, element = 0;
  const auto add_group = [&](int dimension_of_group, const std::string& called) {
    groups += fmt::format("{} {} \"{}\"\n", dimension_of_group, ++group, called);
    return group;
  };
  const auto add = [&](int type, int of_group, const auto& corners) {
    elements += fmt::format("{} {} 2 {} {}", ++element, type, of_group, of_group);
    for (const int node : corners) elements += fmt::format(" {}", node + 1);
    elements += '\n';
  };
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i) {
    const Point x = map * mesh.nodes[i] + shift;
    nodes += fmt::format("{} {:.17g} {:.17g} 0\n", i + 1, x.x(), x.y());
  }
  const int first_side = group + 1;
  for (const std::string& side : mesh.side_names) add_group(1, side);
  for (const auto& edge : mesh.boundary_faces) add(1, first_side + edge.side, edge.nodes);
  for (const RawMesh::Chain& fracture : mesh.fractures) {
    const int number = add_group(1, fracture.name);
    for (std::size_t i = 1; i < fracture.nodes.size(); ++i)
      add(1, number, std::array{fracture.nodes[i - 1], fracture.nodes[i]});
  }
  const int first_region = group + 1;
  for (const std::string& region : mesh.region_names) add_group(2, region);
  for (std::size_t c = 0; c < mesh.cells.size(); ++c)
    add(mesh.cells[c].size() == 3 ? 2 : 3, first_region + mesh.regions[c], mesh.cells[c]);

  const std::string file = ::testing::TempDir() + name + "_" + std::to_string(getpid()) + ".msh";
  std::ofstream(file) << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n"
                      << group << '\n'
                      << groups << "$EndPhysicalNames\n$Nodes\n"
                      << mesh.nodes.size() << '\n'
                      << nodes << "$EndNodes\n$Elements\n"
                      << element << '\n'
                      << elements << "$EndElements\n";
  return file;
}

Tensor turned_by(double degrees) {
  const double angle = degrees * std::numbers::pi / 180;
  return (Tensor() << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle)).finished();
}

}  // namespace sprekk::testing
