#include "framework/remeshing/move_tips.hpp"

#include "framework/mesh/build_mesh.hpp"
#include "framework/meshing/generate_mesh.hpp"
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

/// A fracture with another one and an interface beside its tip, which has grown by one cell.
Mesh sample() {
  const Mesh mesh =
      with_fractures({fracture("main", {{0.7, 1}, {1, 1}}), fracture("beside", {{0.95, 1.07}, {1.2, 1.06}})},
                     {region("hard", {{1.075, 0.5}, {1.6, 0.5}, {1.6, 1.5}, {1.075, 1.5}})});
  return extended(mesh, {replacing(mesh, 0, true, 0, size, -0.1)}, usual).mesh;
}

GrownMesh lengthened(const Mesh& mesh) { return extended(mesh, {replacing(mesh, 0, true, 1, 0.3 * size, 0.1)}, usual); }

std::optional<GrownMesh> moved(const Mesh& before, const GrownMesh& grown, const Point& to) {
  return move_tips(before, grown, {{0, true, {to}, 1, true}}, usual);
}

double overlap_difference(const GrownMesh& one, const GrownMesh& other) {
  return (one.change.overlap - other.change.overlap).norm();
}

double node_difference(const Mesh& one, const Mesh& other) {
  double most = 0;
  for (int node = 0; node < one.node_count(); ++node)
    most = std::max(most, (one.nodes[node] - other.nodes[node]).norm());
  return most;
}

/// Topology and numbers are those of `grown`, and nothing has moved that must not.
void expect_same_but_moved(const Mesh& before, const GrownMesh& grown, const GrownMesh& moved) {
  expect_sound(before, moved);
  ASSERT_EQ(moved.mesh.cell_nodes, grown.mesh.cell_nodes);
  ASSERT_EQ(moved.mesh.cell_faces, grown.mesh.cell_faces);
  ASSERT_EQ(moved.mesh.face_side, grown.mesh.face_side);
  ASSERT_EQ(moved.mesh.cell_region, grown.mesh.cell_region);
  ASSERT_EQ(moved.mesh.cell_rank, grown.mesh.cell_rank);
  ASSERT_EQ(moved.extension_cells, grown.extension_cells);
  ASSERT_EQ(moved.change.cell, grown.change.cell);
  ASSERT_EQ(moved.change.fracture_cell, grown.change.fracture_cell);
  ASSERT_EQ(moved.change.ridge, grown.change.ridge);
  for (int f = 0; f < grown.mesh.face_count(); ++f) {
    const auto [one, other] = grown.mesh.face_cells[f];
    const bool is_interface = other != none && grown.mesh.cell_region[one] != grown.mesh.cell_region[other];
    if (!is_interface && grown.mesh.face_side[f] == none) continue;
    for (const int node : grown.mesh.face_nodes[f]) ASSERT_EQ(moved.mesh.nodes[node], grown.mesh.nodes[node]);
  }
}

TEST(MoveTips, ToWhereTheyAreGivesTheSameMesh) {
  const Mesh before = sample();
  const GrownMesh grown = lengthened(before);
  const auto same = moved(before, grown, tip(grown.mesh, 0, true));
  ASSERT_TRUE(same);
  expect_same_but_moved(before, grown, *same);
  EXPECT_EQ(same->mesh.nodes, grown.mesh.nodes);
  EXPECT_EQ(same->change.face, grown.change.face);
  EXPECT_EQ(same->smallest_angle, grown.smallest_angle);
  EXPECT_EQ(overlap_difference(*same, grown), 0);
}

TEST(MoveTips, AlongAndAcross) {
  const Mesh before = sample();
  const GrownMesh grown = lengthened(before);
  const Point at = tip(grown.mesh, 0, true), along = direction(grown.mesh, 0, true);
  for (const double by : {-0.2, 0.1, 0.5, 1.0}) {
    for (const double turn : {-0.3, 0.0, 0.3}) {
      const Point from = anchor(grown.mesh, 0, true, 1);
      const Point to = from + turned(at - from + by * size * along, turn);
      const auto result = moved(before, grown, to);
      ASSERT_TRUE(result) << by << ' ' << turn;
      expect_same_but_moved(before, grown, *result);
      EXPECT_EQ(tip(result->mesh, 0, true), to);
      // All of the cavity follows, its neighbours by nearly as much, none by more.
      EXPECT_NEAR(node_difference(result->mesh, grown.mesh), (to - at).norm(), 1e-15);
    }
  }
}

TEST(MoveTips, IsContinuous) {
  const Mesh before = sample();
  const GrownMesh grown = lengthened(before);
  const Point tip_of_grown = tip(grown.mesh, 0, true);
  // From where the mesh was made, and from elsewhere.
  for (const Point& start : {tip_of_grown, Point(tip_of_grown + size * Point(0.3, 0.1))}) {
    const auto at_start = moved(before, grown, start);
    ASSERT_TRUE(at_start);
    const Point way = turned({1, 0}, 0.7);
    const auto far = moved(before, grown, start + 1e-3 * size * way);
    ASSERT_TRUE(far);
    for (const double part : {1e-3, 1e-6, 1e-9}) {
      const auto next = moved(before, grown, start + part * size * way);
      ASSERT_TRUE(next);
      expect_same_but_moved(before, grown, *next);
      EXPECT_NEAR(node_difference(next->mesh, at_start->mesh), part * size, 1e-15);
      for (int node = 0; node < grown.mesh.node_count(); ++node) {
        const Point expected = part / 1e-3 * (far->mesh.nodes[node] - at_start->mesh.nodes[node]);
        ASSERT_NEAR((next->mesh.nodes[node] - at_start->mesh.nodes[node] - expected).norm(), 0, 1e-15);
      }
      // An edge of a cell is at most 0.1 m long. Areas are lost at 1e-16 of a cell's.
      EXPECT_LT(overlap_difference(*next, *at_start), part * size * 0.5 + 1e-16);
      EXPECT_NEAR(next->mesh.fracture_cells[next->extension_cells[0][0]].measure,
                  at_start->mesh.fracture_cells[next->extension_cells[0][0]].measure, part * size + 1e-16);
      EXPECT_NEAR(next->smallest_angle, at_start->smallest_angle, 2 * part);
    }
  }
}

TEST(MoveTips, OfTwoAreTheSumOfBoth) {
  const Mesh mesh = with_fractures({fracture("main", {{0.9, 0.9}, {1.1, 1.1}})});
  const auto paths = [&](const Point& a, const Point& b) {
    std::vector<PathExtension> paths{replacing(mesh, 0, true, 0, size, 0.4), replacing(mesh, 0, false, 0, size, 0.4)};
    paths[0].points[0] += a;
    paths[1].points[0] += b;
    return paths;
  };
  const Point a = 0.3 * size * Point(1, 0.2), b = 0.2 * size * Point(-0.5, -1), zero = Point::Zero();
  const CavityOptions wide{.radius = 10 * size, .size = size, .growth = 0.3};  // one cavity
  const GrownMesh grown = extended(mesh, paths(zero, zero), wide);
  const auto both = move_tips(mesh, grown, paths(a, b), wide), one = move_tips(mesh, grown, paths(a, zero), wide),
             other = move_tips(mesh, grown, paths(zero, b), wide);
  ASSERT_TRUE(both && one && other);
  expect_same_but_moved(mesh, grown, *both);
  for (int node = 0; node < grown.mesh.node_count(); ++node) {
    const Point sum = one->mesh.nodes[node] + other->mesh.nodes[node] - grown.mesh.nodes[node];
    ASSERT_NEAR((both->mesh.nodes[node] - sum).norm(), 0, 1e-15);
  }
}

/// A mesh turned by an angle, about the origin, and mirrored on the x axis before that if asked.
Mesh image(const Mesh& mesh, double angle, bool is_mirrored) {
  RawMesh raw = to_raw_mesh(mesh);
  for (Point& x : raw.nodes) x = turned({x.x(), is_mirrored ? -x.y() : x.y()}, angle);
  Mesh result = build_mesh(raw);
  for (int i = 0; i < result.fracture_cell_count(); ++i) result.fracture_cells[i].grown = mesh.fracture_cells[i].grown;
  return result;
}

TEST(MoveTips, TurnedAndMirrored) {
  const Mesh before = sample();
  const GrownMesh grown = lengthened(before);
  const Point to = tip(grown.mesh, 0, true) + size * Point(0.4, -0.2);
  const auto upright = moved(before, grown, to);
  ASSERT_TRUE(upright);
  for (const bool is_mirrored : {false, true}) {
    for (const double angle : {30 * degree, 90 * degree, 180 * degree}) {
      const auto place = [&](const Point& x) { return turned({x.x(), is_mirrored ? -x.y() : x.y()}, angle); };
      GrownMesh other = grown;
      other.mesh = image(grown.mesh, angle, is_mirrored);
      const Mesh other_before = image(before, angle, is_mirrored);
      const auto result = moved(other_before, other, place(to));
      ASSERT_TRUE(result);
      for (int node = 0; node < grown.mesh.node_count(); ++node)
        ASSERT_NEAR((result->mesh.nodes[node] - place(upright->mesh.nodes[node])).norm(), 0, 1e-14);
      EXPECT_LT(overlap_difference(*result, *upright), 1e-15);
      EXPECT_NEAR(result->smallest_angle, upright->smallest_angle, 1e-12);
      if (!is_mirrored) expect_same_but_moved(other_before, other, *result);
    }
  }
}

TEST(MoveTips, RanksStay) {
  Mesh before = sample();
  for (int c = 0; c < before.cell_count(); ++c) before.cell_rank[c] = before.cell_center[c].x() > 1.02 ? 1 : 0;
  const GrownMesh grown = lengthened(before);
  const auto result = moved(before, grown, tip(grown.mesh, 0, true) + size * Point(0.4, -0.2));
  ASSERT_TRUE(result);
  expect_same_but_moved(before, grown, *result);
}

TEST(MoveTips, GivesUpWhereTheMeshMustBeMadeAnew) {
  const Mesh before = sample();
  const GrownMesh grown = lengthened(before);
  const Point at = tip(grown.mesh, 0, true);
  // Much too far, into the next fracture, and through the interface: cells would turn over.
  EXPECT_FALSE(moved(before, grown, at + size * Point(3.5, 0)));
  EXPECT_FALSE(moved(before, grown, {1.09, 1}));
  EXPECT_THROW(moved(before, grown, {1.02, 1.08}), ExtensionError);
  // Shorter than what it replaces, though longer than nothing.
  EXPECT_THROW(moved(before, grown, anchor(before, 0, true, 1) + Point(0.9 * size, 0)), ExtensionError);
  // Onto the outer boundary, or away from it.
  const Mesh near_side = with_fractures({fracture("main", {{1.7, 1}, {1.96, 1}})});
  const GrownMesh inside = extended(near_side, {{0, true, {{1.98, 1}}, 0, true}}, usual);
  EXPECT_TRUE(move_tips(near_side, inside, {{0, true, {{1.981, 1}}, 0, true}}, usual));
  EXPECT_FALSE(move_tips(near_side, inside, {{0, true, {{2, 1}}, 0, true}}, usual));
  const GrownMesh through = extended(near_side, {{0, true, {{2, 1}}, 0, true}}, usual);
  EXPECT_TRUE(move_tips(near_side, through, {{0, true, {{2, 1}}, 0, true}}, usual));
  EXPECT_FALSE(move_tips(near_side, through, {{0, true, {{2, 1.001}}, 0, true}}, usual));
  EXPECT_FALSE(move_tips(near_side, through, {{0, true, {{1.985, 1}}, 0, true}}, usual));
  // A path that was divided.
  const GrownMesh divided = extended(before, {{0, true, {anchor(before, 0, true, 0) + Point(2.2 * size, 0)}}}, usual);
  ASSERT_EQ(divided.extension_cells[0].size(), 2u);
  EXPECT_FALSE(move_tips(before, divided, {{0, true, {anchor(before, 0, true, 0) + Point(2.2 * size, 0)}}}, usual));
}

TEST(MoveTips, PathsAlongAnInterfaceStay) {
  const Mesh mesh =
      with_fractures({fracture("main", {{0.7, 1}, {1, 1}})}, {region("top", {{0, 1}, {2, 1}, {2, 2}, {0, 2}})});
  PathExtension path{0, true, {{1 + 0.6 * size, 1}, {1 + 1.6 * size, 1 + 0.5 * size}}, 0, true};
  const GrownMesh grown = extended(mesh, {path}, usual);
  ASSERT_EQ(grown.extension_cells[0].size(), 2u);
  path.points[1] += Point(0.1 * size, 0.2 * size);
  const auto result = move_tips(mesh, grown, {path}, usual);
  ASSERT_TRUE(result);
  expect_same_but_moved(mesh, grown, *result);
  path.points[0].y() += 0.01 * size;
  EXPECT_FALSE(move_tips(mesh, grown, {path}, usual));
}

TEST(MoveTips, BeyondAnInterfaceWhichTheyCross) {
  const Mesh before = sample();
  PathExtension path{0, true, {tip(before, 0, true) + size * Point(4, 0.3)}, 0, true};
  const GrownMesh grown = extended(before, {path}, usual);
  ASSERT_EQ(grown.extension_cells[0].size(), 2u);
  const int crossing = grown.mesh.fracture_cells[grown.extension_cells[0][0]].ridges[1];
  path.points[0] += size * Point(0.3, 0.1);
  const auto result = move_tips(before, grown, {path}, usual);
  ASSERT_TRUE(result);
  expect_same_but_moved(before, grown, *result);
  EXPECT_EQ(tip(result->mesh, 0, true), path.points[0]);
  EXPECT_EQ(result->mesh.ridges[crossing].center, grown.mesh.ridges[crossing].center);
}

TEST(MoveTips, HowFar) {
  // A single tip in a cavity of five edge lengths, of a cell of one edge length.
  const Mesh mesh = with_fractures({fracture("main", {{0.9, 0.9}, {1.1, 1.1}})});
  const PathExtension path = replacing(mesh, 0, true, 0, size);
  const GrownMesh grown = extended(mesh, {path}, usual);
  // Measured: 2.2 on, 0.75 and 1.25 aside, 0.45 back.
  for (const auto& [angle, least] : {std::pair(0.0, 1.5), {90.0, 0.6}, {-90.0, 0.6}, {180.0, 0.3}}) {
    double part = 0;
    while (part < 3) {
      PathExtension further = path;
      further.points[0] += (part + 0.05) * size * turned(direction(mesh, 0, true), angle * degree);
      const auto result = move_tips(mesh, grown, {further}, usual);
      if (!result) break;
      expect_same_but_moved(mesh, grown, *result);
      part += 0.05;
    }
    EXPECT_GT(part, least) << angle;
  }
}

TEST(MoveTips, RandomNetworks) {
  int changes = 0, moves = 0;
  for (int network = 0; network < 3; ++network) {
    RandomNetwork random(network);
    const auto uniform = [&random](double low, double high) { return random.uniform(low, high); };
    const std::vector<FractureGeometry> fractures = random.fractures();
    std::vector<RegionGeometry> regions;
    if (network == 2) regions.push_back(region("hard", {{0.2, 0.5}, {1.8, 0.55}, {1.8, 0.7}, {0.2, 0.65}}));
    Mesh mesh = with_fractures(fractures, regions);
    for (int change = 0; change < 6; ++change) {
      std::vector<PathExtension> extensions;
      for (int f = 0; f < RandomNetwork::fracture_count; ++f) {
        for (const bool at_end : {true, false}) {
          if (uniform(0, 1) < 0.4) continue;
          const int replaced = grown_cells(mesh, f, at_end) > 0 && uniform(0, 1) < 0.7 ? 1 : 0;
          extensions.push_back(
              replacing(mesh, f, at_end, replaced, uniform(replaced == 1 ? 0.05 : 0.3, 1) * size, uniform(-0.4, 0.4)));
        }
      }
      while (!extensions.empty()) {
        try {
          GrownMesh grown = extended(mesh, extensions, usual);
          // Each tip a bit on and aside, and that mesh is gone on with.
          for (PathExtension& extension : extensions)
            extension.points[0] += size * uniform(0.02, 0.3) *
                                   turned(direction(grown.mesh, extension.fracture, extension.at_end), uniform(-1, 1));
          auto result = move_tips(mesh, grown, extensions, usual);
          EXPECT_TRUE(result || network == 2) << network << ' ' << change;  // there, an interface is near
          if (result) {
            ++moves;
            expect_same_but_moved(mesh, grown, *result);
            if (HasFatalFailure()) return;
            grown = std::move(*result);
          }
          mesh = std::move(grown.mesh);
          ++changes;
          break;
        } catch (const ExtensionError& error) {
          extensions.erase(extensions.begin() + error.extension());
        }
      }
    }
  }
  EXPECT_GE(changes, 15);
  EXPECT_GE(moves, 12);
}

}  // namespace
}  // namespace sprekk::test
