// Meshes whose coordinates differ by round-off stay the same in their topology when fractures grow.
#include "framework/remeshing/rounded_filling.hpp"

#include <cmath>
#include <functional>
#include <random>

#include "framework/mesh/build_mesh.hpp"
#include "framework/mesh/plane/planar.hpp"
#include "framework/mesh/topology_hash.hpp"
#include "framework/meshing/generate_mesh.hpp"
#include "tests/framework/remeshing/growth_checks.hpp"

namespace sprekk::test {
namespace {

constexpr double size = 0.02;
constexpr CavityOptions plain{.radius = 4 * size, .size = size, .growth = 0.3};
constexpr CavityOptions rounding{.radius = 4 * size, .size = size, .growth = 0.3, .rounds = true};

Mesh two_fractures() {
  Geometry geometry = box(0, 2, 0, 2);
  geometry.fractures = {fracture("main", {{0.965, 0.965}, {1.035, 1.035}}),
                        fracture("beside", {{1.2, 1.05}, {1.3, 1.1}})};
  geometry.regions = {region("hard", {{1.12, 0.5}, {1.6, 0.5}, {1.6, 1.5}, {1.12, 1.5}})};
  return generate_mesh(geometry, {.size = 0.1, .fracture_size = size});
}

/// The mesh with each node changed by a function.
Mesh changed(const Mesh& mesh, const std::function<Point(const Point&)>& change) {
  RawMesh raw = to_raw_mesh(mesh);
  for (Point& x : raw.nodes) x = change(x);
  Mesh result = build_mesh(raw);
  for (int i = 0; i < result.fracture_cell_count(); ++i) result.fracture_cells[i].grown = mesh.fracture_cells[i].grown;
  return result;
}

double node_difference(const Mesh& one, const Mesh& other) {
  double most = 0;
  for (int node = 0; node < one.node_count(); ++node)
    most = std::max(most, (one.nodes[node] - other.nodes[node]).norm());
  return most;
}

/// Steps in which both ends of a fracture grow: how many have left two meshes that differ by 1e-11 m with the same
/// topology. In each step nodes get that noise again.
int steps_together(const Mesh& start, const CavityOptions& options, int steps, unsigned seed) {
  constexpr double by = 1e-11;
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> noise(-by, by), bend(-0.3, 0.3), more(0.2, 0.9);
  const auto shaken = [&](const Point& x) -> Point { return x + Point(noise(random), noise(random)); };
  Mesh one = start, other = changed(start, shaken);
  for (int step = 0; step < steps; ++step) {
    std::vector<PathExtension> paths;
    for (const bool at_end : {true, false})
      paths.push_back(step % 3 == 0 ? replacing(one, 0, at_end, 0, 0.5 * size * more(random), bend(random))
                                    : replacing(one, 0, at_end, 1, 0.4 * size * more(random), bend(random)));
    std::vector<PathExtension> near = paths;
    for (PathExtension& path : near)
      for (Point& x : path.points) x = shaken(x);
    one = extended(one, paths, options).mesh;
    other = extended(other, near, options).mesh;
    if (topology_hash(one) != topology_hash(other)) return step;
    if (options.rounds) {
      EXPECT_LT(node_difference(one, other), 5 * by * (step + 1)) << seed << ' ' << step;
    }
  }
  return steps;
}

TEST(RoundedFilling, RoundOffChangesNoTopology) {
  const Mesh mesh = two_fractures();
  int together_without = 0;
  constexpr int steps = 5;
  for (unsigned seed = 0; seed < 20; ++seed) {
    const double turn = std::array{0.0, 30.0, 90.0, 217.0}[seed % 4] * 3.14159265358979 / 180;
    const bool is_mirrored = seed % 3 == 1;
    const Mesh image = changed(mesh, [&](const Point& x) {
      return turned({x.x(), is_mirrored ? -x.y() : x.y()}, turn);
    });
    EXPECT_EQ(steps_together(image, rounding, steps, seed), steps) << seed;
    if (seed < 4) together_without += steps_together(image, plain, steps, seed);
  }
  RecordProperty("steps together without rounding, of 20", together_without);
  EXPECT_LT(together_without, 4 * steps);
}

TEST(RoundedFilling, HasTheGivenOutline) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> noise(-0.1, 0.1);
  for (int i = 0; i < 20; ++i) {
    CavityOutline outline;
    constexpr int count = 12;
    for (int k = 0; k < count; ++k) {
      outline.points.push_back(Point(3, -2) + (1 + noise(random)) * turned({1, 0}, 2 * 3.14159265358979 * k / count));
      outline.edges.push_back({{k, (k + 1) % count}, CavityOutline::Edge::Place::rim, false});
    }
    outline.points.emplace_back(3 + noise(random), -2 + noise(random));
    outline.points.emplace_back(3.3, -1.7);
    outline.edges.push_back({{count, count + 1}, CavityOutline::Edge::Place::inside, true});
    const auto found = fill_rounded_cavity(outline, 1, 0.3, {3, -2});
    ASSERT_TRUE(found);
    const Triangulation usual = fill_cavity(outline, 1, 0.3);
    for (std::size_t k = 0; k < outline.points.size(); ++k) EXPECT_EQ(found->points[k], outline.points[k]);
    const auto area = [](const Triangulation& t) {
      double sum = 0;
      for (const auto& [a, b, c] : t.triangles) sum += signed_area(t.points[a], t.points[b], t.points[c]);
      return sum;
    };
    EXPECT_NEAR(area(*found), area(usual), 1e-13);
    EXPECT_GT(smallest_angle(*found), 0.6 * smallest_angle(usual));
  }
}

}  // namespace
}  // namespace sprekk::test
