// What the tests of this folder share: a small mesh with two fractures, and a folder that vanishes after the test.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "framework/mesh/build_mesh.hpp"
#include "framework/meshing/structured_mesh.hpp"
#include "tests/framework/config/messages.hpp"

namespace sprekk {

/// The unit square in 4 by 4 squares; one fracture ends on the left side, the other one lies in the rock.
inline Mesh small_mesh() {
  Geometry geometry;
  geometry.box.high = Point(1, 1);
  geometry.fractures.resize(2);
  geometry.fractures[0].name = "long";
  geometry.fractures[0].points = {Point(0, 0.5), Point(0.75, 0.5)};
  geometry.fractures[1].name = "short";
  geometry.fractures[1].points = {Point(0.5, 0.75), Point(0.75, 0.75)};
  MeshOptions options;
  options.kind = MeshOptions::Kind::structured;
  options.cells = {4, 4};
  return build_mesh(structured_mesh(geometry, options));
}

class TemporaryFolder : public testing::Test {
 protected:
  TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "sprekk_output_XXXXXX").string();
    folder = ::mkdtemp(name.data());
  }
  ~TemporaryFolder() override { std::filesystem::remove_all(folder); }

  std::filesystem::path folder;
};

inline std::string read_text(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

inline void write_text(const std::filesystem::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
}

}  // namespace sprekk
