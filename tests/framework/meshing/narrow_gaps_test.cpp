#include "framework/meshing/plane/narrow_gaps.hpp"

#include <functional>
#include <map>

#include "framework/mesh/quality/mesh_quality.hpp"
#include "framework/meshing/generate_mesh.hpp"
#include "framework/meshing/plane/size_field.hpp"
#include "framework/meshing/validate_geometry.hpp"
#include "tests/framework/mesh/mesh_checks.hpp"

namespace sprekk::test {
namespace {

constexpr double size = 0.1;

using Fractures = std::vector<FractureGeometry>;

/// In a box of 2 m: fractures with a gap of the given width.
const std::map<std::string, std::function<Fractures(double)>> with_gap = {
    {"end and side",
     [](double gap) -> Fractures {
       return {fracture("a", {{1.2, 1}, {2 - gap, 1.1}})};
     }},
    {"end and slanted side",
     [](double gap) -> Fractures {
       return {fracture("a", {{1.9 - gap, 0.4}, {2 - gap, 1.1}})};
     }},
    {"walls",
     [](double gap) -> Fractures {
       return {fracture("a", {{0.6, 1}, {1.4, 1}}), fracture("b", {{0.9, 1 + gap}, {1.2, 1 + gap}})};
     }},
    {"two ends",
     [](double gap) -> Fractures {
       return {fracture("a", {{0.5, 1}, {1, 1.1}}), fracture("b", {{1 + gap, 1.1}, {1.5, 1.2}})};
     }},
    {"end and wall",
     [](double gap) -> Fractures {
       return {fracture("a", {{0.5, 1}, {1.5, 1}}), fracture("b", {{1, 1 + gap}, {1.1, 1.5}})};
     }},
    {"hairpin",
     [](double gap) -> Fractures {
       return {fracture("a", {{0.5, 1}, {1, 1.1}, {1, 1.1 + gap}, {0.5, 1.2 + gap}})};
     }},
};

Geometry in_box(const Fractures& fractures) {
  Geometry geometry = box(0, 2, 0, 2);
  geometry.fractures = fractures;
  return geometry;
}

MeshQuality quality(const Fractures& fractures, const MeshOptions& options) {
  const Mesh mesh = generate_mesh(in_box(fractures), options);
  expect_consistent(mesh);
  return mesh_quality(mesh);
}

/// Delaunay refinement keeps angles above 20.7 degrees where lines meet at 60 or more (Ruppert, J. Algorithms 18 (1995)
/// 548); gmsh promises nothing. Measured: 19.2 for the hairpin, 21.8 for the others.
constexpr double wanted_angle = 18 * degree;

TEST(NarrowGaps, AnglesDoNotDependOnTheWidth) {
  for (const auto& [name, fractures] : with_gap) {
    for (const double growth : {0.3, 1.0, 2.0}) {
      for (const double width : {0.5, 0.1, 0.02, 0.004}) {
        const MeshOptions options{.size = 2 * size, .fracture_size = size, .growth = growth, .gap_length = 1e9};
        EXPECT_GT(quality(fractures(width * size), options).smallest_angle, wanted_angle)
            << name << ", " << width << ", growth " << growth;
      }
    }
  }
}

TEST(NarrowGaps, WithoutRefinementAnglesFallWithTheWidth) {
  for (const auto& [name, fractures] : with_gap) {
    const MeshOptions options{.size = 2 * size, .fracture_size = size, .gap_edges = 0};
    EXPECT_LT(quality(fractures(0.02 * size), options).smallest_angle, 3 * degree) << name;
  }
}

TEST(NarrowGaps, QuadrilateralsToo) {
  for (const auto& [name, fractures] : with_gap) {
    const MeshOptions options{
        .shape = MeshOptions::Shape::quadrilaterals, .size = 2 * size, .fracture_size = size, .gap_length = 1e9};
    EXPECT_GT(quality(fractures(0.02 * size), options).smallest_angle, wanted_angle) << name;
  }
}

TEST(NarrowGaps, CellsGrowWithTheLogarithmOfTheWidth) {
  const MeshOptions options{.size = 2 * size, .fracture_size = size};
  std::vector<int> cells;
  for (const double width : {0.1, 0.02, 0.004})
    cells.push_back(quality(with_gap.at("end and side")(width * size), options).cells);
  // A mesh of edge length h has 4 / (sqrt(3) h^2) triangles per area. With h = g + growth r, half a disc between the
  // radii g / growth and 5 g / growth, where the next gap begins, has so many:
  const double step = 4 / std::sqrt(3.0) * std::numbers::pi / (0.3 * 0.3) * std::log(5.0);
  EXPECT_NEAR(cells[2] - cells[0], 2 * step, 0.3 * 2 * step);
  EXPECT_NEAR(cells[2] - cells[1], cells[1] - cells[0], 0.2 * step);
}

TEST(NarrowGaps, WallsSideBySideAreLeftAloneButForTheirEnds) {
  const double gap = 0.02 * size;
  const Geometry geometry = in_box(with_gap.at("walls")(gap));
  const MeshOptions options{.size = 2 * size, .fracture_size = size};
  const SizeField sizes(geometry, options);
  for (const double end : {0.9, 1.2}) EXPECT_LT(sizes.at({end, 1}), 3 * gap);
  EXPECT_GT(sizes.at({1.05, 1}), 0.3 * size);
  MeshOptions whole = options;
  whole.gap_length = 300 * size / gap;
  EXPECT_LT(generate_mesh(geometry, options).cell_count(), 0.5 * generate_mesh(geometry, whole).cell_count());
}

TEST(NarrowGaps, WideGapsChangeNothing) {
  std::vector<std::pair<Geometry, MeshOptions>> wide;
  // Half an edge is the limit, and edges at the side are longer by growth * gap.
  for (const auto& [name, fractures] : with_gap)
    wide.emplace_back(in_box(fractures(0.75 * size)), MeshOptions{.size = 2 * size, .fracture_size = size});
  // Ends on sides at any angle, kinks, a fine polyline, and interfaces that a fracture crosses and follows.
  Geometry busy = box(-1, 3, 0, 2);
  busy.fractures = {fracture("kinked", {{-0.3, 0.3}, {0.2, 0.5}, {0.4, 0.9}}), fracture("edge", {{3, 1.2}, {2.2, 1.1}}),
                    fracture("flat", {{1.5, 0}, {2.5, 0.3}}), fracture("along", {{1.2, 1.6}, {1.8, 1.6}})};
  FractureGeometry arc = fracture("arc", {});
  for (int i = 0; i <= 100; ++i) {
    const double angle = std::numbers::pi * i / 100;
    arc.points.push_back({-0.5 + 0.3 * std::cos(angle), 1 + 0.3 * std::sin(angle)});
  }
  busy.fractures.push_back(arc);
  busy.regions = {region("layer", {{-1, 1.6}, {3, 1.6}, {3, 2}, {-1, 2}}),
                  region("cut", {{0, 0.2}, {0.2, 0.2}, {0, 0.7}})};
  wide.emplace_back(busy, MeshOptions{.size = 0.1, .fracture_size = 0.05});
  wide.emplace_back(paper_geometry(), MeshOptions{.size = 0.1, .fracture_size = 0.01, .tip_size = 0.002});
  for (const auto& [geometry, options] : wide) {
    MeshOptions off = options;
    off.gap_edges = 0;
    const Mesh mesh = generate_mesh(geometry, options), without = generate_mesh(geometry, off);
    EXPECT_EQ(mesh.nodes, without.nodes);
    EXPECT_EQ(mesh.cell_nodes, without.cell_nodes);
  }
}

TEST(NarrowGaps, AreNotWherePolylinesMeet) {
  // Two of short segments cross, and a third one ends on one of them, at about right angles. They cross in the middle
  // of segments: a short piece that a crossing cuts off would have shorter edges.
  const auto polyline = [](const std::string& name, const Point& from, const Point& to) {
    FractureGeometry line = fracture(name, {});
    for (int i = 0; i <= 60; ++i) line.points.push_back(from + i / 60.0 * (to - from));
    return line;
  };
  Geometry geometry = box(0, 2, 0, 2);
  geometry.fractures = {polyline("a", {0.2, 1}, {1.8, 1.03}), polyline("b", {1.0123, 0.2}, {1.0143, 1.8})};
  geometry.fractures.push_back(polyline("c", geometry.fractures[0].points[20], {0.7, 0.3}));
  const MeshOptions options{.size = 0.2, .fracture_size = 0.08};
  MeshOptions off = options;
  off.gap_edges = 0;
  const Mesh mesh = generate_mesh(geometry, options);
  EXPECT_EQ(mesh.nodes, generate_mesh(geometry, off).nodes);
  EXPECT_EQ(mesh.junctions.size(), 2u);
  // Beside it, without touching it, there is one.
  geometry.fractures[2] = polyline("c", geometry.fractures[0].points[20] - Point(0, 0.01), {0.7, 0.3});
  EXPECT_GT(generate_mesh(geometry, options).cell_count(), generate_mesh(geometry, off).cell_count());
}

TEST(SizeField, AnEndOnAnotherFractureIsNoTip) {
  Geometry geometry = box(0, 2, 0, 2);
  geometry.fractures = {fracture("a", {{0.4, 1}, {1.6, 1}}), fracture("b", {{1, 1}, {1, 1.6}})};
  const SizeField sizes(geometry, {.size = 0.2, .fracture_size = 0.1, .tip_size = 0.01});
  EXPECT_DOUBLE_EQ(sizes.at({1, 1}), 0.1);
  for (const Point& tip : {Point(0.4, 1), Point(1.6, 1), Point(1, 1.6)}) EXPECT_DOUBLE_EQ(sizes.at(tip), 0.01);
}

TEST(NarrowGaps, SizesAreThoseOfTheGapAndGrowFromThere) {
  const double gap = 0.02 * size, growth = 0.3;
  const Geometry geometry = in_box(with_gap.at("end and side")(gap));
  for (const double edges : {0.5, 1.0}) {
    const SizeField sizes(geometry, {.size = 2 * size, .fracture_size = size, .growth = growth, .gap_edges = edges});
    const double at_end = gap / edges;
    EXPECT_NEAR(sizes.at({2 - gap, 1.1}), at_end, 0.1 * at_end);
    EXPECT_NEAR(sizes.at({2, 1.1}), at_end, 0.1 * at_end);
    EXPECT_NEAR(sizes.at({2, 1.1 + 0.1}), at_end + growth * 0.1, 0.02 * growth * 0.1);
    EXPECT_DOUBLE_EQ(sizes.at({1, 0}), 2 * size);
  }
}

TEST(NarrowGaps, GapSizeIsTheShortest) {
  const Geometry geometry = in_box(with_gap.at("end and side")(1e-6 * size));
  const SizeField chosen(geometry, {.size = 2 * size, .fracture_size = size, .gap_size = 0.01});
  EXPECT_DOUBLE_EQ(chosen.at({2, 1.1}), 0.01);
  const SizeField large(geometry, {.size = 2 * size, .gap_size = 3 * size});
  EXPECT_DOUBLE_EQ(large.at({2, 1.1}), 2 * size);
  const SizeField usual(geometry, {.size = 2 * size, .fracture_size = size});
  EXPECT_DOUBLE_EQ(usual.at({2, 1.1}), size / 500);  // the default of gap_size
}

// Half an edge across a gap: edges of a five-hundredth fit a gap of a thousandth. A wider one gets its own edges, and
// one that is narrower no smaller ones.
TEST(NarrowGaps, OfAThousandthOfAnEdgeAreTheNarrowestThatAreToldApart) {
  const auto at_gap = [](double gap) {
    return SizeField(in_box(with_gap.at("end and side")(gap * size)), {.size = 2 * size, .fracture_size = size})
               .at({2, 1.1}) /
           size;
  };
  EXPECT_NEAR(at_gap(1.1e-3), 2.2e-3, 1e-5);
  EXPECT_NEAR(at_gap(0.9e-3), 2e-3, 1e-12);
  EXPECT_NEAR(at_gap(1e-5), 2e-3, 1e-12);
}

TEST(NarrowGaps, InterfacesLeaveGapsToo) {
  // The end of a fracture is a hundredth of the edge length before an interface, another passes its corner.
  Geometry geometry =
      in_box({fracture("a", {{0.5, 0.5}, {0.7, 1 - 0.01 * size}}), fracture("b", {{1.431, 0.8}, {1.571, 1.2}})});
  geometry.regions = {region("block", {{0.2, 1}, {1.5, 1}, {1.5, 1.5}, {0.2, 1.5}})};
  const MeshOptions options{.size = size};
  const Mesh mesh = generate_mesh(geometry, options);
  expect_consistent(mesh);
  EXPECT_GT(mesh_quality(mesh).smallest_angle, wanted_angle);
}

TEST(NarrowGaps, MakeTheCellCountAnHonestError) {
  const Geometry geometry = in_box(with_gap.at("walls")(2e-7));
  const MeshOptions options{.size = 2 * size, .fracture_size = size, .gap_length = 1e9, .gap_size = 1e-7};
  EXPECT_THAT(input_error([&] { validate_geometry(geometry, options); }), testing::HasSubstr("gap_size"));
}

}  // namespace
}  // namespace sprekk::test
