#include "framework/remeshing/extend_fractures.hpp"

#include "framework/mesh/plane/planar.hpp"
#include "framework/mesh/quality/mesh_quality.hpp"
#include "framework/meshing/generate_mesh.hpp"
#include "tests/framework/remeshing/growth_checks.hpp"

namespace sprekk::test {
namespace {

using Kind = Ridge::Kind;

constexpr double size = 0.02;
constexpr CavityOptions usual{.radius = 5 * size, .size = size, .growth = 0.3};
constexpr MeshOptions coarse_outside{.size = 0.1, .fracture_size = size};

Mesh with_fractures(std::vector<FractureGeometry> fractures, const MeshOptions& options = coarse_outside) {
  Geometry geometry = box(0, 2, 0, 2);
  geometry.fractures = std::move(fractures);
  return generate_mesh(geometry, options);
}

/// A fracture of 0.28 m at 45 degrees in the middle of a box of 2 m.
Mesh one_fracture() { return with_fractures({fracture("main", {{0.9, 0.9}, {1.1, 1.1}})}); }

TEST(ExtendFractures, EitherEndStraightOn) {
  const Mesh mesh = one_fracture();
  for (const bool at_end : {true, false}) {
    const GrownMesh grown = extend_fractures(mesh, {straight(mesh, 0, at_end, 2 * size)}, usual);
    expect_sound(mesh, grown);
    EXPECT_GE(grown.smallest_angle, 35 * degree);
    EXPECT_NEAR((tip(grown.mesh, 0, at_end) - tip(mesh, 0, at_end)).norm(), 2 * size, 1e-14);
    EXPECT_EQ(tip(grown.mesh, 0, !at_end), tip(mesh, 0, !at_end));
    // Counted from the old tip on.
    const int old_count = mesh.fracture_cell_count();
    EXPECT_EQ(grown.extension_cells[0], (at_end ? std::vector{old_count, old_count + 1} : std::vector{1, 0}));
    // A few cells only are touched.
    EXPECT_LT(grown.change.new_cells.size(), 0.1 * mesh.cell_count());
    EXPECT_EQ(euler_characteristic(grown.mesh), euler_characteristic(mesh));
  }
}

TEST(ExtendFractures, OnlyCellsNearThePathAreRemoved) {
  const Mesh mesh = one_fracture();
  const PathExtension path = straight(mesh, 0, true, 3 * size, 0.5);
  const GrownMesh grown = extend_fractures(mesh, {path}, usual);
  const Segment segment{tip(mesh, 0, true), path.points[0]};
  std::vector<bool> is_removed(mesh.cell_count());
  for (const int cell : grown.change.removed_cells) is_removed[cell] = true;
  const double longest = 0.1;  // filled notches are a cell deep
  for (int cell = 0; cell < mesh.cell_count(); ++cell) {
    const double away = distance(mesh.cell_center[cell], segment);
    EXPECT_TRUE(is_removed[cell] || away >= usual.radius);
    EXPECT_TRUE(!is_removed[cell] || away <= usual.radius + longest);
  }
}

TEST(ExtendFractures, KinksAndLengths) {
  const Mesh mesh = one_fracture();
  for (const double angle : {-75.0, -50.0, -20.0, 0.0, 35.0, 75.0}) {
    for (const double length : {0.5, 1.0, 3.0, 10.0}) {
      const GrownMesh grown = extend_fractures(mesh, {straight(mesh, 0, true, length * size, angle * degree)}, usual);
      expect_sound(mesh, grown);
      EXPECT_EQ(grown.extension_cells[0].size(), std::max(1.0, length));
      EXPECT_GE(grown.smallest_angle, 30 * degree) << angle << ' ' << length;
    }
  }
}

TEST(ExtendFractures, GradesFromSmallEdgesToACoarseMesh) {
  // Edges at the path ten times shorter than those around it.
  const Mesh mesh = with_fractures({fracture("main", {{0.9, 0.9}, {1.1, 1.1}})}, {.size = 0.1});
  const GrownMesh grown =
      extend_fractures(mesh, {straight(mesh, 0, true, 0.03, 0.4)}, {.radius = 0.05, .size = 0.01, .growth = 0.3});
  expect_sound(mesh, grown);
  EXPECT_EQ(grown.extension_cells[0].size(), 3u);
  EXPECT_GE(grown.smallest_angle, 20 * degree);
}

TEST(ExtendFractures, SeveralSegments) {
  const Mesh mesh = one_fracture();
  PathExtension path = straight(mesh, 0, false, 2 * size, 0.3);
  path.points.push_back(path.points[0] + Point(-1.5 * size, 0));
  path.points.push_back(path.points[1] + Point(-0.4 * size, 0.4 * size));
  const GrownMesh grown = extend_fractures(mesh, {path}, usual);
  expect_sound(mesh, grown);
  EXPECT_EQ(grown.extension_cells[0].size(), 2u + 2u + 1u);
  EXPECT_EQ(tip(grown.mesh, 0, false), path.points[2]);
  for (const Point& x : path.points) {
    EXPECT_EQ(std::count_if(grown.mesh.ridges.begin(), grown.mesh.ridges.end(),
                            [&](const Ridge& point) { return point.center == x; }),
              1);
  }
  EXPECT_GE(grown.smallest_angle, 20 * degree);
}

TEST(ExtendFractures, TwoTipsAtOnce) {
  const Mesh mesh = one_fracture();
  const GrownMesh grown =
      extend_fractures(mesh, {straight(mesh, 0, true, 2 * size, 0.5), straight(mesh, 0, false, 3 * size, 0.5)}, usual);
  expect_sound(mesh, grown);
  EXPECT_EQ(grown.extension_cells[0].size(), 2u);
  EXPECT_EQ(grown.extension_cells[1], (std::vector{2, 1, 0}));
  EXPECT_EQ(grown.change.fracture_cell[3], 0);
  EXPECT_GE(grown.smallest_angle, 30 * degree);
}

TEST(ExtendFractures, CavitiesThatOverlapAreMerged) {
  // The tips are three edges apart; one fracture is passed by the path of the other.
  const Mesh mesh =
      with_fractures({fracture("one", {{0.6, 1}, {0.97, 1}}), fracture("two", {{1.4, 1.03}, {1.03, 1.03}})});
  const GrownMesh grown =
      extend_fractures(mesh, {straight(mesh, 0, true, 3 * size, -0.3), straight(mesh, 1, true, 3 * size, -0.3)}, usual);
  expect_sound(mesh, grown);
  EXPECT_GE(grown.smallest_angle, 30 * degree);
}

TEST(ExtendFractures, NeighboursInTheCavityStay) {
  // One fracture lies within the cavity altogether, another reaches into it.
  const Mesh mesh =
      with_fractures({fracture("main", {{0.7, 1}, {1, 1}}), fracture("small", {{1.02, 1.05}, {1.06, 1.07}}),
                      fracture("long", {{0.98, 0.6}, {1.05, 0.95}})});
  const GrownMesh grown = extend_fractures(mesh, {straight(mesh, 0, true, 3 * size)}, usual);
  expect_sound(mesh, grown);
  EXPECT_GE(grown.smallest_angle, 25 * degree);
}

TEST(ExtendFractures, ThirtyTimesAlongACurve) {
  // Two ends curl into spirals, with different lengths.
  Mesh mesh = one_fracture();
  double smallest = 10;
  for (int step = 0; step < 30; ++step) {
    const double turn = 0.02 + 0.004 * step;
    const GrownMesh grown = extend_fractures(
        mesh, {straight(mesh, 0, true, 1.3 * size, turn), straight(mesh, 0, false, 0.9 * size, turn)}, usual);
    expect_sound(mesh, grown);
    smallest = std::min(smallest, grown.smallest_angle);
    mesh = grown.mesh;
  }
  EXPECT_GE(smallest, 25 * degree);  // measured: 27.5
  EXPECT_NEAR(fracture_length(mesh, 0), 0.2 * std::sqrt(2.0) + 30 * 2.2 * size, 1e-12);
  // Quality is not used up: the whole mesh is as good as the new cells were.
  EXPECT_GE(mesh_quality(mesh).smallest_angle, 25 * degree);
}

TEST(ExtendFractures, BesideTheOuterBoundary) {
  // At one edge length from a side whose edges are five times as long.
  const Mesh mesh = with_fractures({fracture("main", {{0.8, 2 * size}, {1, size}})});
  const GrownMesh grown = extend_fractures(mesh, {{0, true, {{1 + 4 * size, size}}}}, usual);
  expect_sound(mesh, grown);
  EXPECT_EQ(grown.mesh.ridges[grown.mesh.fracture_cells.back().ridges[1]].kind, Kind::tip);
  EXPECT_GE(grown.smallest_angle, 20 * degree);
}

TEST(ExtendFractures, OutOfNarrowGaps) {
  // From an end much nearer to a side or to another fracture than an edge is long, where edges are short by now.
  for (const double gap : {0.5, 0.1, 0.02}) {
    for (const double angle : {20.0, 45.0, 60.0}) {
      const double y = gap * size;
      const Point way = 3 * size * turned({1, 0}, angle * degree);
      const Mesh beside_side = with_fractures({fracture("main", {{0.8, y + 0.05}, {1, y}})});
      const Mesh beside_wall =
          with_fractures({fracture("main", {{0.8, 1.05 + y}, {1, 1 + y}}), fracture("other", {{0.8, 1}, {1.1, 1}})});
      for (const auto& [mesh, path] : {std::pair(beside_side, PathExtension{0, true, {Point(1, y) + way}}),
                                       std::pair(beside_wall, PathExtension{0, true, {Point(1, 1 + y) + way}})}) {
        const GrownMesh grown = extend_fractures(mesh, {path}, usual);
        expect_sound(mesh, grown);
        EXPECT_GE(grown.smallest_angle, 18 * degree) << gap << ' ' << angle;  // measured: 20.5; without gap_edges 3.3
      }
    }
  }
}

TEST(ExtendFractures, EndsOnTheOuterBoundary) {
  const Mesh mesh = with_fractures({fracture("main", {{0.7, 0.7}, {1.3, 1.92}})});
  for (double x = 1.3; x < 1.4; x += 0.007) {
    // Not quite there: the last hundredth of an edge is made up for.
    const GrownMesh grown = extend_fractures(mesh, {{0, true, {{x, 2 - 0.005 * size}}}}, usual);
    expect_sound(mesh, grown);
    const Ridge& end = grown.mesh.ridges[grown.mesh.fracture_cells.back().ridges[1]];
    EXPECT_EQ(end.kind, Kind::on_boundary);
    EXPECT_EQ(end.center, Point(x, 2));
    EXPECT_EQ(grown.mesh.side_names[end.side], "top");
    EXPECT_EQ(euler_characteristic(grown.mesh), euler_characteristic(mesh) + 1);  // the hole opens
    // The corner between fracture and side holds two cells.
    const double incidence = std::atan2(0.08, x - 1.3);
    EXPECT_GE(grown.smallest_angle, std::min(20 * degree, 0.5 * incidence - 0.1 * degree)) << x;
    EXPECT_THROW(extend_fractures(grown.mesh, {straight(grown.mesh, 0, true, size)}, usual), ExtensionError);
  }
}

TEST(ExtendFractures, JoinsAnotherFracture) {
  const Mesh mesh =
      with_fractures({fracture("main", {{0.7, 1}, {1.2, 1}}), fracture("wall", {{1.3, 0.6}, {1.3, 1.4}})});
  const auto& [name, first, count] = mesh.fractures[1];
  for (int n = 0; n <= count; ++n) {
    const FractureCell& cell = mesh.fracture_cells[first + std::min(n, count - 1)];
    const Point place = mesh.ridges[cell.ridges[n < count ? 0 : 1]].center;
    if (std::abs(place.y() - 1) > 0.25) continue;  // at less than 22 degrees
    const GrownMesh grown = extend_fractures(mesh, {{0, true, {place}}}, usual);
    expect_sound(mesh, grown);
    EXPECT_EQ(euler_characteristic(grown.mesh), euler_characteristic(mesh) + 1);  // two holes become one
    ASSERT_EQ(grown.mesh.junctions.size(), 1u);
    EXPECT_EQ(grown.mesh.junctions[0].cells.size(), 3u);
    // The corner between both holds two cells.
    const double incidence = std::atan2(0.1, std::abs(place.y() - 1));
    EXPECT_GE(grown.smallest_angle, std::min(20 * degree, 0.5 * incidence - 0.1 * degree)) << place.y();
    const auto& [pair, end] = std::pair(grown.mesh.junctions[0].ridges.back(), grown.mesh.junctions[0].ridges.front());
    EXPECT_NE(grown.change.ridge[pair], none);  // between the cells of the wall
    EXPECT_EQ(grown.change.ridge[end], none);
    EXPECT_THROW(extend_fractures(grown.mesh, {straight(grown.mesh, 0, true, size)}, usual), ExtensionError);

    // The joint stays when others grow beside it.
    const GrownMesh next = extend_fractures(grown.mesh, {straight(grown.mesh, 1, true, 2 * size, 0.5)}, usual);
    expect_sound(grown.mesh, next);
    ASSERT_EQ(next.mesh.junctions.size(), 1u);
    for (const int point : next.mesh.junctions[0].ridges) EXPECT_NE(next.change.ridge[point], none);
  }
}

TEST(ExtendFractures, JoinsTheTipOfAnother) {
  const Mesh mesh =
      with_fractures({fracture("main", {{0.7, 1}, {1.2, 1}}), fracture("next", {{1.3, 1.05}, {1.6, 1.2}})});
  const GrownMesh grown = extend_fractures(mesh, {{0, true, {{1.3, 1.05}}}}, usual);
  expect_sound(mesh, grown);
  ASSERT_EQ(grown.mesh.junctions.size(), 1u);
  EXPECT_EQ(grown.mesh.junctions[0].cells.size(), 2u);
}

TEST(ExtendFractures, ThroughTheBoxSeparatesIt) {
  Mesh mesh = with_fractures({fracture("main", {{0.1, 1}, {1.9, 1.05}})});
  const GrownMesh grown = extend_fractures(mesh, {{0, true, {{2, 1}}}, {0, false, {{0, 1.02}}}}, usual);
  expect_sound(mesh, grown);
  EXPECT_EQ(component_count(mesh), 1);
  EXPECT_EQ(component_count(grown.mesh), 2);
}

TEST(ExtendFractures, RegionInterfacesStay) {
  Geometry geometry = box(0, 2, 0, 2);
  geometry.fractures = {fracture("main", {{0.7, 1}, {1, 1}})};
  geometry.regions = {region("hard", {{1.05, 0.5}, {1.6, 0.6}, {1.5, 1.7}, {1.02, 1.5}})};
  const Mesh mesh = generate_mesh(geometry, coarse_outside);
  // Ends before the interface, near it, behind it; and crosses it obliquely.
  for (const double length : {1.0, 1.8, 2.0, 3.0, 7.0}) {
    for (const double angle : {-0.7, 0.0, 0.6}) {
      const GrownMesh grown = extend_fractures(mesh, {straight(mesh, 0, true, length * size, angle)}, usual);
      expect_sound(mesh, grown);
      EXPECT_GE(grown.smallest_angle, 20 * degree) << length << ' ' << angle;
    }
  }
  const GrownMesh grown = extend_fractures(mesh, {straight(mesh, 0, true, 7 * size)}, usual);
  const Mesh& after = grown.mesh;
  EXPECT_EQ(after.cell_region[after.face_cells[after.fracture_cells.back().faces[0]][0]], 1);
  double area = 0;
  for (int c = 0; c < after.cell_count(); ++c) area += after.cell_region[c] == 1 ? after.cell_measure[c] : 0;
  EXPECT_NEAR(area, signed_area(geometry.regions[0].polygon), 1e-12);
}

// A path that passes a corner of a region by less than a tenth of an edge bends to it, one that is farther away stays
// straight and crosses the interface beside the corner.
TEST(ExtendFractures, CornersOfRegionsTakeWhatPassesThemClosely) {
  for (const double away : {0.08, 0.12, -0.08, -0.12}) {
    Geometry geometry = box(0, 2, 0, 2);
    geometry.fractures = {fracture("main", {{0.7, 1}, {1, 1}})};
    const Point corner(1 + 2.5 * size, 1 + away * size);
    geometry.regions = {region("hard", {corner, {1.5, 0.5}, {1.5, 1.5}})};
    const Mesh mesh = generate_mesh(geometry, coarse_outside);
    const GrownMesh grown = extend_fractures(mesh, {straight(mesh, 0, true, 5 * size)}, usual);
    expect_sound(mesh, grown);
    double to_corner = 1, off_line = 0;
    for (const Ridge& point : grown.mesh.ridges) {
      to_corner = std::min(to_corner, (point.center - corner).norm());
      off_line = std::max(off_line, std::abs(point.center.y() - 1));
    }
    const bool bends = std::abs(away) < 0.1;
    EXPECT_EQ(to_corner == 0, bends) << away;
    EXPECT_NEAR(off_line, bends ? std::abs(away) * size : 0, 1e-12) << away;
  }
}

TEST(ExtendFractures, AlongAnInterface) {
  Geometry geometry = box(0, 2, 0, 2);
  geometry.regions = {region("top half", {{0, 1}, {2, 1}, {2, 2}, {0, 2}})};
  // On the interface already, and onto it with a turn.
  for (const Point& from : {Point(0.7, 1), Point(0.9, 0.95)}) {
    geometry.fractures = {fracture("main", {from, {1, 1}})};
    const Mesh mesh = generate_mesh(geometry, coarse_outside);
    for (const double length : {0.6, 1.0, 1.7, 5.0, 12.0}) {
      const GrownMesh grown = extend_fractures(mesh, {{0, true, {{1 + length * size, 1}}}}, usual);
      expect_sound(mesh, grown);
      EXPECT_GE(grown.smallest_angle, 25 * degree) << from << ' ' << length;
      EXPECT_NEAR(fracture_length(grown.mesh, 0), fracture_length(mesh, 0) + length * size, 1e-12);
    }
  }
}

TEST(ExtendFractures, SameInputSameBits) {
  const Mesh mesh = one_fracture();
  const std::vector<PathExtension> paths{straight(mesh, 0, true, 4 * size, 0.6), straight(mesh, 0, false, size)};
  const GrownMesh one = extend_fractures(mesh, paths, usual), two = extend_fractures(mesh, paths, usual);
  EXPECT_EQ(one.mesh.nodes, two.mesh.nodes);
  EXPECT_EQ(one.mesh.cell_nodes, two.mesh.cell_nodes);
  EXPECT_EQ(one.change.cell, two.change.cell);
  EXPECT_EQ((one.change.overlap - two.change.overlap).norm(), 0);
}

TEST(ExtendFractures, FarFromTheOriginAndSmall) {
  for (const double scale : {1e-3, 1e4}) {
    const Point origin(3e3 * scale, -5e3 * scale);
    Geometry geometry = box(origin.x(), origin.x() + scale, origin.y(), origin.y() + scale);
    geometry.fractures = {fracture("main", {origin + scale * Point(0.4, 0.4), origin + scale * Point(0.6, 0.5)})};
    const Mesh mesh = generate_mesh(geometry, {.size = 0.1 * scale, .fracture_size = 0.02 * scale});
    const GrownMesh grown = extend_fractures(mesh, {straight(mesh, 0, true, 0.05 * scale, 0.5)},
                                             {.radius = 0.1 * scale, .size = 0.02 * scale, .growth = 0.3});
    EXPECT_NEAR(total_area(grown.mesh), scale * scale, 1e-11 * scale * scale);
    EXPECT_GE(grown.smallest_angle, 30 * degree);
    const Vector rows = grown.change.overlap * Vector::Ones(mesh.cell_count());
    for (int c = 0; c < grown.mesh.cell_count(); ++c) {
      EXPECT_NEAR(rows[c], grown.mesh.cell_measure[c], 1e-12 * grown.mesh.cell_measure[c]);
    }
  }
}

TEST(ExtendFractures, RanksAreInherited) {
  Mesh mesh = one_fracture();
  for (int c = 0; c < mesh.cell_count(); ++c) mesh.cell_rank[c] = mesh.cell_center[c].x() > 1.11 ? 1 : 0;
  const GrownMesh grown = extend_fractures(mesh, {straight(mesh, 0, true, size)}, usual);
  expect_sound(mesh, grown);
  for (const int c : grown.change.new_cells) {
    const double x = grown.mesh.cell_center[c].x();
    EXPECT_TRUE(std::abs(x - 1.11) < 0.05 || grown.mesh.cell_rank[c] == (x > 1.11 ? 1 : 0));
  }
}

TEST(ExtendFractures, CoarserPathsFreeNumbers) {
  // Fewer cells than before: the last ones take the free numbers.
  const Mesh mesh = with_fractures({fracture("main", {{0.9, 0.9}, {1.1, 1.1}})}, {.size = 0.02});
  const GrownMesh grown =
      extend_fractures(mesh, {straight(mesh, 0, true, 0.2)}, {.radius = 0.3, .size = 0.1, .growth = 0.3});
  ASSERT_LT(grown.mesh.cell_count(), mesh.cell_count());
  expect_sound(mesh, grown);
}

TEST(ExtendFractures, RefusesBadOptions) {
  const Mesh mesh = one_fracture();
  for (const CavityOptions& options :
       {CavityOptions{0, 1, 1}, CavityOptions{1, -1, 1}, CavityOptions{1, 1, std::nan("")}}) {
    EXPECT_THROW(extend_fractures(mesh, {straight(mesh, 0, true, size)}, options), std::invalid_argument);
  }
}

}  // namespace
}  // namespace sprekk::test
