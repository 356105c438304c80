// Extensions that begin before the old tip.
#include "framework/remeshing/replaced_parts.hpp"

#include "framework/mesh/build_mesh.hpp"
#include "framework/mesh/plane/planar.hpp"
#include "framework/meshing/generate_mesh.hpp"
#include "framework/remeshing/extend_fractures.hpp"
#include "framework/remeshing/move_tips.hpp"
#include "tests/framework/remeshing/random_network.hpp"

namespace sprekk::test {
namespace {

constexpr double size = 0.02;
constexpr CavityOptions usual{.radius = 5 * size, .size = size, .growth = 0.3};

Mesh with_fractures(std::vector<FractureGeometry> fractures, std::vector<RegionGeometry> regions = {}) {
  Geometry geometry = box(0, 2, 0, 2);
  geometry.fractures = std::move(fractures);
  geometry.regions = std::move(regions);
  return generate_mesh(geometry, {.size = 0.1, .fracture_size = size});
}

Mesh one_fracture() { return with_fractures({fracture("main", {{0.9, 0.9}, {1.1, 1.1}})}); }

/// The shares of replaced cells by their distance from the end, of the new cells by that along the extension.
std::map<std::pair<int, int>, double> parts(const GrownMesh& grown, const std::vector<int>& replaced) {
  std::map<std::pair<int, int>, double> parts;
  const auto& path = grown.extension_cells[0];
  for (const ReplacedPart& part : grown.change.replaced_parts)
    parts[{std::ranges::find(path, part.cell) - path.begin(),
           std::ranges::find(replaced, part.old_cell) - replaced.begin()}] = part.share;
  return parts;
}

TEST(ReplacedCells, BecomeALittleLongerEachTime) {
  // As in a run: the last cell grows, and a new one begins when it is long enough.
  Mesh mesh = one_fracture();
  const int before = mesh.fracture_cell_count();
  const double length = fracture_length(mesh, 0);
  mesh = extended(mesh, {replacing(mesh, 0, true, 0, 0.5 * size, 0.6), replacing(mesh, 0, false, 0, 0.5 * size, 0.6)},
                  usual)
             .mesh;
  double smallest = 10;
  for (int step = 1; step < 24; ++step) {
    const int replaced = step % 6 == 0 ? 0 : 1;
    const double more = (replaced == 0 ? 0.5 : 0.13) * size, turn = 0.02;
    const GrownMesh grown = extended(
        mesh, {replacing(mesh, 0, true, replaced, more, turn), replacing(mesh, 0, false, replaced, 0.8 * more, turn)},
        usual);
    ASSERT_EQ(grown.extension_cells[0].size(), 1u);
    ASSERT_EQ(grown.extension_cells[1].size(), 1u);
    smallest = std::min(smallest, grown.smallest_angle);
    mesh = grown.mesh;
  }
  EXPECT_EQ(mesh.fracture_cell_count(), before + 8);
  EXPECT_NEAR(fracture_length(mesh, 0), length + 2 * 0.5 * size + 1.8 * size * (3 * 0.5 + 20 * 0.13), 1e-12);
  EXPECT_GE(smallest, 20 * degree);
}

TEST(ReplacedCells, StayPointSymmetric) {
  // A fracture in the middle of a square, both ends alike: the mesh is its own image by half a turn after each change.
  // The cavities around the tips are apart, so that each is filled for itself.
  Geometry geometry = box(0, 2, 0, 2);
  geometry.fractures = {fracture("main", {{0.5, 0.5}, {1.5, 1.5}})};
  Mesh mesh = generate_mesh(geometry, {.kind = MeshOptions::Kind::structured, .cells = {20, 20}});
  const auto most_apart = [&] {
    double most = 0;
    for (const Point& x : mesh.nodes) {
      double least = 1;
      for (const Point& y : mesh.nodes) least = std::min(least, (x + y - Point(2, 2)).norm());
      most = std::max(most, least);
    }
    return most;
  };
  ASSERT_LT(most_apart(), 1e-9);
  for (int step = 0; step < 8; ++step) {
    const int replaced = step % 4 == 0 ? 0 : 1;
    const double more = (replaced == 0 ? 0.5 : 0.17) * size, turn = step == 0 ? 0.6 : 0.03;
    std::vector<PathExtension> paths{replacing(mesh, 0, true, replaced, more, turn),
                                     replacing(mesh, 0, false, replaced, more, turn)};
    const GrownMesh grown = extended(mesh, paths, usual);
    for (PathExtension& path : paths) path.points[0] += (path.at_end ? 1 : -1) * size * Point(0.06, 0.08);
    std::optional<GrownMesh> moved = move_tips(mesh, grown, paths, usual);
    ASSERT_TRUE(moved) << step;
    mesh = grown.mesh;
    ASSERT_LT(most_apart(), 1e-9) << step;
    mesh = std::move(moved->mesh);
    ASSERT_LT(most_apart(), 1e-9) << step;
  }
}

TEST(ReplacedCells, ShareOutTheOldLength) {
  for (const bool at_end : {true, false}) {
    Mesh mesh = one_fracture();
    for (const double length : {1.0, 0.5})
      mesh = extended(mesh, {replacing(mesh, 0, at_end, 0, length * size, 0.3)}, usual).mesh;
    const int last = at_end ? mesh.fracture_cell_count() - 1 : 0, second = at_end ? last - 1 : 1;

    // Two cells by one that is longer and turned.
    const GrownMesh by_one = extended(mesh, {replacing(mesh, 0, at_end, 2, 0.2 * size, -0.4)}, usual);
    EXPECT_EQ(by_one.change.fracture_cell[by_one.extension_cells[0][0]], none);
    const auto of_one = parts(by_one, {second, last});
    EXPECT_EQ(of_one.size(), 2u);
    EXPECT_EQ(of_one.at({0, 0}), 1);
    EXPECT_EQ(of_one.at({0, 1}), 1);

    // The same by three, of which the last goes on beyond both.
    PathExtension path = replacing(mesh, 0, at_end, 2, 0, 0.1);
    const Point from = anchor(mesh, 0, at_end, 2), along = (path.points[0] - from).normalized();
    path.points = {from + 0.25 * size * along, from + 1.25 * size * along, from + 2 * size * along};
    const GrownMesh by_three = extended(mesh, {path}, usual);
    ASSERT_EQ(by_three.extension_cells[0].size(), 3u);
    const auto of_three = parts(by_three, {second, last});
    EXPECT_EQ(of_three.size(), 4u);
    EXPECT_NEAR(of_three.at({0, 0}), 0.25, 1e-13);
    EXPECT_NEAR(of_three.at({1, 0}), 0.75, 1e-13);
    EXPECT_NEAR(of_three.at({1, 1}), 0.5, 1e-13);
    EXPECT_NEAR(of_three.at({2, 1}), 0.5, 1e-13);

    // By two of the same lengths: one to one, without slivers of round-off.
    path.points = {from + size * along, from + 1.5 * size * along};
    const auto of_two = parts(extended(mesh, {path}, usual), {second, last});
    EXPECT_EQ(of_two, (std::map<std::pair<int, int>, double>{{{0, 0}, 1}, {{1, 1}, 1}}));
  }
}

TEST(ReplacedCells, WholeSegmentsAreOneCellEach) {
  const Mesh mesh = one_fracture();
  for (const double length : {0.2, 0.7, 1.6, 3.0}) {
    PathExtension path = replacing(mesh, 0, true, 0, length * size, 0.5);
    path.points.push_back(path.points[0] + Point(0, 0.6 * size));
    const GrownMesh grown = extended(mesh, {path}, usual);
    ASSERT_EQ(grown.extension_cells[0].size(), 2u);
    EXPECT_NEAR(grown.mesh.fracture_cells[grown.extension_cells[0][0]].measure, length * size, 1e-14);
    EXPECT_GE(grown.smallest_angle, 20 * degree) << length;
  }
}

TEST(ReplacedCells, NothingOfTheOldPathIsLeft) {
  // Also where the new path turns away from it: every cell that touched the old cells is made anew.
  Mesh mesh = one_fracture();
  for (const double angle : {0.5, 0.0, 0.0, 0.0})
    mesh = extended(mesh, {replacing(mesh, 0, true, 0, size, angle)}, usual).mesh;
  const GrownMesh grown =
      extended(mesh, {replacing(mesh, 0, true, 4, 0, -1.2)}, {.radius = 0.5 * size, .size = size, .growth = 0.3});
  std::vector<bool> is_removed(mesh.cell_count());
  for (const int cell : grown.change.removed_cells) is_removed[cell] = true;
  const Segment old{anchor(mesh, 0, true, 4), tip(mesh, 0, true)};
  for (int cell = 0; cell < mesh.cell_count(); ++cell)
    for (const int node : mesh.cell_nodes[cell])
      EXPECT_TRUE(distance(mesh.nodes[node], old) > 1e-12 || is_removed[cell]);
}

/// A mesh turned by an angle, about the origin, and mirrored on the x axis before that if asked.
Mesh image(const Mesh& mesh, double angle, bool is_mirrored) {
  RawMesh raw = to_raw_mesh(mesh);
  for (Point& x : raw.nodes) x = turned({x.x(), is_mirrored ? -x.y() : x.y()}, angle);
  Mesh result = build_mesh(raw);
  for (int i = 0; i < result.fracture_cell_count(); ++i) result.fracture_cells[i].grown = mesh.fracture_cells[i].grown;
  return result;
}

TEST(ReplacedCells, TurnedAndMirrored) {
  const Mesh start = one_fracture();
  const auto grow = [](Mesh mesh, double sign) {
    for (const double length : {1.0, 0.5})
      mesh = extended(mesh, {replacing(mesh, 0, true, 0, length * size, sign * 0.3)}, usual).mesh;
    return extended(mesh, {replacing(mesh, 0, true, 2, 0.3 * size, -sign * 0.3)}, usual);
  };
  const GrownMesh upright = grow(start, 1);
  for (const bool is_mirrored : {false, true}) {
    for (const double angle : {0.0, 30 * degree, 90 * degree, 180 * degree}) {
      const GrownMesh grown = grow(image(start, angle, is_mirrored), is_mirrored ? -1 : 1);
      const Point end = tip(upright.mesh, 0, true);
      const Point expected = turned({end.x(), is_mirrored ? -end.y() : end.y()}, angle);
      EXPECT_NEAR((tip(grown.mesh, 0, true) - expected).norm(), 0, 1e-13);
      ASSERT_EQ(grown.change.replaced_parts.size(), upright.change.replaced_parts.size());
      for (std::size_t i = 0; i < upright.change.replaced_parts.size(); ++i)
        EXPECT_NEAR(grown.change.replaced_parts[i].share, upright.change.replaced_parts[i].share, 1e-13);
      EXPECT_GE(grown.smallest_angle, 25 * degree);
    }
  }
}

TEST(ReplacedCells, BesideAnInterfaceAndAFracture) {
  Mesh mesh = with_fractures({fracture("main", {{0.7, 1}, {1, 1}}), fracture("beside", {{0.9, 1.06}, {1.2, 1.05}})},
                             {region("hard", {{1.05, 0.5}, {1.6, 0.5}, {1.6, 1.02}, {1.05, 1.02}})});
  mesh = extended(mesh, {replacing(mesh, 0, true, 0, size, 0.1)}, usual).mesh;
  // Up to the interface and through it, beside the other fracture.
  double smallest = 10;
  for (int step = 0; step < 10; ++step) {
    const int replaced = step % 4 == 3 ? 0 : 1;
    const GrownMesh grown = extended(mesh, {replacing(mesh, 0, true, replaced, 0.4 * size, -0.05)}, usual);
    smallest = std::min(smallest, grown.smallest_angle);
    mesh = grown.mesh;
  }
  EXPECT_GT(tip(mesh, 0, true).x(), 1.06);
  EXPECT_GE(smallest, 10 * degree);
}

TEST(ReplacedCells, RandomNetworks) {
  int changes = 0, refused = 0;
  double smallest = 10;
  for (int network = 0; network < 4; ++network) {
    RandomNetwork random(network);
    const auto uniform = [&random](double low, double high) { return random.uniform(low, high); };
    const std::vector<FractureGeometry> fractures = random.fractures();
    std::vector<RegionGeometry> regions;
    if (network % 3 == 2) regions.push_back(region("hard", {{0.2, 0.95}, {1.8, 1.0}, {1.8, 1.1}, {0.2, 1.05}}));
    Mesh mesh = with_fractures(fractures, regions);
    for (int change = 0; change < 8; ++change) {
      std::vector<PathExtension> extensions;
      for (int f = 0; f < RandomNetwork::fracture_count; ++f) {
        for (const bool at_end : {true, false}) {
          if (uniform(0, 1) < 0.4) continue;
          const int replaced = std::min(grown_cells(mesh, f, at_end), static_cast<int>(uniform(0, 2.99)));
          extensions.push_back(replacing(mesh, f, at_end, replaced,
                                         uniform(0, 1.5) * size + (replaced == 0 ? 0.2 * size : 0),
                                         uniform(-0.6, 0.6)));
        }
      }
      while (!extensions.empty()) {
        try {
          const GrownMesh grown = extend_fractures(mesh, extensions, usual);
          expect_sound(mesh, grown);
          if (HasFatalFailure()) return;
          smallest = std::min(smallest, grown.smallest_angle);
          mesh = grown.mesh;
          ++changes;
          break;
        } catch (const ExtensionError& error) {
          ++refused;
          extensions.erase(extensions.begin() + error.extension());
        }
      }
    }
  }
  EXPECT_GE(changes, 28);
  EXPECT_LT(refused, 60);
  EXPECT_GE(smallest, 15 * degree);  // measured: 26.0
}

}  // namespace
}  // namespace sprekk::test
