// Rock with fractures, and what tests of paths and squares compare.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "components/fine_fracture/fine_level/fine_domain.hpp"
#include "tests/components/meshes.hpp"

namespace sprekk::test {

using namespace fine_fracture;
using Walls = CrackPath::Walls;
inline constexpr double rounding = 1e-12;
inline constexpr double gap = 0.01;

inline Mesh rock_with(const std::vector<std::vector<Point>>& fractures) {
  Geometry geometry = box(2, 1);
  for (const auto& points : fractures) {
    geometry.fractures.emplace_back();
    geometry.fractures.back().name = std::string(1, static_cast<char>('a' + geometry.fractures.size()));
    geometry.fractures.back().points = points;
  }
  return generate_mesh(geometry, unstructured(0.1));
}

inline std::vector<FracturePath> paths_of(const Mesh& mesh) {
  std::vector<FracturePath> paths;
  for (int i = 0; i < static_cast<int>(mesh.fractures.size()); ++i) paths.push_back(fracture_path(mesh, i, {}, {}));
  return paths;
}

inline void expect_points(const std::vector<Point>& found, const std::vector<Point>& expected) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) EXPECT_LT((found[i] - expected[i]).norm(), rounding) << i;
}

inline void expect_lengths(const std::vector<double>& found, const std::vector<double>& expected) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], expected[i], rounding) << i;
}

}  // namespace sprekk::test
