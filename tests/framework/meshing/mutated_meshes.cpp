#include "tests/framework/meshing/mutated_meshes.hpp"

#include <gmsh.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "framework/config/input_error.hpp"
#include "framework/mesh/quality/mesh_quality.hpp"
#include "framework/meshing/generate_mesh.hpp"
#include "framework/meshing/gmsh_module/gmsh_model.hpp"

namespace sprekk::test {
namespace {

struct Format {
  double version;
  int binary, parametric;
  bool has_quadrilaterals;
};

void name(int dim, const std::vector<int>& tags, const std::string& words) {
  gmsh::model::setPhysicalName(dim, gmsh::model::addPhysicalGroup(dim, tags), words);
}

namespace geo = gmsh::model::geo;

/// Two fractures that meet in a rectangle of 2 m by 1 m.
void draw_triangles() {
  for (const auto& [x, y] : {std::pair(0., 0.), {2., 0.}, {2., 1.}, {0., 1.}, {0.4, 0.3}, {1.6, 0.3}, {1., 0.8}}) {
    geo::addPoint(x, y, 0, 0.3);
  }
  for (int i = 0; i < 4; ++i) geo::addLine(1 + i, 1 + (i + 1) % 4);
  const int crack = geo::addLine(5, 6), vein = geo::addLine(6, 7);
  geo::addCurveLoop({1, 2, 3, 4}, 1);
  geo::addPlaneSurface({1}, 1);
  geo::synchronize();
  gmsh::model::mesh::embed(1, {crack, vein}, 2, 1);
  name(1, {1, 3}, "bottom and top");
  name(1, {crack}, "crack");
  name(1, {vein}, "vein");
  name(2, {1}, "granite");
  gmsh::option::setNumber("Mesh.MeshSizeMax", 0.3);
  gmsh::model::mesh::generate(2);
  gmsh::option::setNumber("Mesh.MeshSizeMax", 1e22);
}

/// The same rectangle as two squares of 4 by 4 cells; the fracture between them crosses it.
void draw_quadrilaterals() {
  for (const auto& [x, y] : {std::pair(0, 0), {1, 0}, {2, 0}, {0, 1}, {1, 1}, {2, 1}}) geo::addPoint(x, y, 0, 0.25);
  for (const auto& [a, b] : {std::pair(1, 2), {2, 3}, {4, 5}, {5, 6}, {1, 4}, {2, 5}, {3, 6}}) geo::addLine(a, b);
  geo::addCurveLoop({1, 6, -3, -5}, 1);
  geo::addCurveLoop({2, 7, -4, -6}, 2);
  for (const int surface : {1, 2}) {
    geo::addPlaneSurface({surface}, surface);
    geo::mesh::setTransfiniteSurface(surface);
    geo::mesh::setRecombine(2, surface);
  }
  for (int curve = 1; curve <= 7; ++curve) geo::mesh::setTransfiniteCurve(curve, 5);
  geo::synchronize();
  name(1, {1, 2, 3, 4}, "bottom and top");
  name(1, {6}, "crack");
  name(2, {1, 2}, "granite");
  gmsh::model::mesh::generate(2);
}

std::string content_of(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream content;
  content << stream.rdbuf();
  return content.str();
}

constexpr std::array words{"-1",    "0",        "1",   "2147483648", "4294967297", "18446744073709551615",
                           "1e308", "-1e308",   "nan", "inf",        "1e-9",       "$EndNodes",
                           "\"",    "99999999", "1.5", "x"};
constexpr std::array<std::uint64_t, 8> numbers{
    0, 1, 0x7fffffff, 0x80000000, 0xffffffffffffffff, 0x7ff0000000000000, 0x7ff8000000000000, 0x100000000};

}  // namespace

std::vector<std::string> meshes_of_gmsh() {
  const std::string file =
      (std::filesystem::temp_directory_path() / ("sprekk_mesh_" + std::to_string(getpid()) + ".msh")).string();
  std::vector<std::string> meshes;
  for (const auto& [version, binary, parametric, has_quadrilaterals] : {Format{2.2, 0, 0, false},
                                                                        {2.2, 1, 0, true},
                                                                        {4.1, 0, 0, true},
                                                                        {4.1, 1, 0, false},
                                                                        {4.1, 0, 1, false},
                                                                        {4.1, 1, 1, true}}) {
    const GmshModel model;
    model.run("write a file", [&] {
      has_quadrilaterals ? draw_quadrilaterals() : draw_triangles();
      gmsh::option::setNumber("Mesh.MshFileVersion", version);
      gmsh::option::setNumber("Mesh.Binary", binary);
      gmsh::option::setNumber("Mesh.SaveParametric", parametric);
      gmsh::write(file);
    });
    meshes.push_back(content_of(file));
  }
  std::filesystem::remove(file);
  return meshes;
}

std::string mutated(std::string bytes, std::mt19937& random) {
  // The library's distributions differ between implementations; remainders do not.
  const auto below = [&](std::size_t bound) { return bound == 0 ? 0 : random() % bound; };
  const std::size_t mistakes = 1 + below(4);
  for (std::size_t i = 0; i < mistakes && !bytes.empty(); ++i) {
    const std::size_t at = below(bytes.size()), length = std::min(bytes.size() - at, 1 + below(40));
    switch (below(9)) {
      case 0:
        bytes[at] = static_cast<char>(bytes[at] ^ (1 << below(8)));
        break;
      case 1:
        bytes[at] = static_cast<char>(below(256));
        break;
      case 2:
        bytes.erase(at, length);
        break;
      case 3:
        bytes.insert(below(bytes.size()), bytes.substr(at, length));
        break;
      case 4:
        for (std::size_t k = 0; k < length; ++k) bytes[at + k] = static_cast<char>(below(256));
        break;
      case 5:
        bytes.resize(at);
        break;
      case 6: {
        const std::uint64_t number = numbers[below(numbers.size())];
        std::memcpy(bytes.data() + at, &number, std::min<std::size_t>(below(2) ? 4 : 8, bytes.size() - at));
        break;
      }
      default: {  // a number of the text
        const std::size_t begin = std::min(bytes.find_first_of(" \n", at), bytes.size() - 1) + 1;
        const std::size_t end = std::min(bytes.find_first_of(" \n", begin), bytes.size());
        bytes.replace(begin, end - begin, words[below(words.size())]);
      }
    }
  }
  return bytes;
}

std::string failure_of_reading(const std::string& file) {
  try {
    Geometry geometry;
    geometry.file = file;
    mesh_names(geometry);
    mesh_quality(generate_mesh(geometry, {}));
  } catch (const InputError& error) {
    return std::string(error.what()).find(file) == std::string::npos ? "a message without the file" : "";
  } catch (const std::exception& error) {
    return error.what();
  }
  return "";
}

}  // namespace sprekk::test
