// Networks of fractures drawn at random, for tests of meshes that grow. A seed gives the same network on every machine.
#pragma once

#include <random>
#include <string>
#include <vector>

#include "framework/meshing/geometry.hpp"
#include "tests/framework/remeshing/growth_checks.hpp"

namespace sprekk::test {

/// Numbers drawn at random, and a network of short fractures that begins with them.
class RandomNetwork {
 public:
  static constexpr int fracture_count = 6;

  explicit RandomNetwork(unsigned seed) : random_(seed) {}

  double uniform(double low, double high) {
    return low + (high - low) * (static_cast<double>(random_()) / 4294967296.0);
  }

  /// Straight fractures in a square of 2 m, 0.08 to 0.2 m long, in two rows of three that do not meet.
  std::vector<FractureGeometry> fractures() {
    std::vector<FractureGeometry> fractures;
    for (int i = 0; i < fracture_count; ++i) {
      const Point middle(0.45 + 0.55 * (i % 3), 0.6 + 0.8 * (i / 3));
      const Point half = uniform(0.04, 0.1) * turned({1, 0}, uniform(0, 3.1));
      fractures.push_back(fracture("f" + std::to_string(i), {middle - half, middle + half}));
    }
    return fractures;
  }

 private:
  std::mt19937 random_;
};

/// The number of cells at this end of a fracture that have grown.
inline int grown_cells(const Mesh& mesh, int fracture, bool at_end) {
  const auto& [name, first, count] = mesh.fractures[fracture];
  int grown = 0;
  while (grown < count && mesh.fracture_cells[at_end ? first + count - 1 - grown : first + grown].grown) ++grown;
  return grown;
}

}  // namespace sprekk::test
