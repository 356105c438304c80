// Wells in rock beyond the last centres of cells before a side, a fracture, or other rock.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "framework/discretization/plane/point_source.hpp"
#include "tests/verification/balance_error.hpp"

namespace sprekk::testing {
namespace {

constexpr const char* closed_box = R"(
geometry:
  box: {{x: [0 m, 30 m], y: [{} m, 26 m]}}
mesh: {{kind: structured, cells: [15, {}], shape: quadrilaterals}}
components:
  pore:
    type: matrix_flow/mpfa
    permeability: 1e-14 m^2
    viscosity: 1 mPa*s
    storage: 1e-10 1/Pa
    initial_pressure: 10 MPa
    boundary: {{left: {{pressure: 10 MPa}}, right: {{pressure: 12 MPa}}}}
  wells:
    type: wells/limited
    wells:
{}
couplers: [{{type: well_exchange, between: [pore, wells]}}]
schedule: [{{solve: [pore, wells]}}]
time: {{end: 4000 s, step: 1000 s}}
)";

std::string well(const char* name, double x, double y) {
  return fmt::format("      {}: {{at: [{} m, {} m], index: 1e-11 m^2/(Pa*s), rate: 1e-5 m^2/s}}\n", name, x, y);
}

/// Reference: symmetry. A closed side is a mirror: the well beside it is one of two in a box that is twice as high,
/// whose cells on both sides of the middle share the rates of both. The well is above the middle of a cell, where
/// shares along the side are the same in both boxes.
TEST(WellsBesideSides, AClosedSideIsAMirror) {
  for (const double y : {0.9, 0.5, 0.01}) {
    SceneRun half = SceneRun::from_text(fmt::format(closed_box, 0, 13, well("w", 13, y)));
    SceneRun whole = SceneRun::from_text(fmt::format(closed_box, -26, 26, well("w", 13, y) + well("mirrored", 13, -y)));
    half.run();
    whole.run();
    const double rise = whole.quantity("wells.w.pressure") - 10e6;
    std::printf("%.2f m from a closed side: %.9g Pa, its mirror %.9g Pa\n", y, half.quantity("wells.w.pressure") - 10e6,
                rise);
    EXPECT_NEAR((half.quantity("wells.w.pressure") - 10e6) / rise, 1, 1e-9) << y;
  }
}

/// Fluid that is let in raises the pressure of every cell, and that of a shut well lies among those of the cells: with
/// shares below zero a well draws from cells, and a shut one sees what is nowhere.
TEST(WellsBesideSides, NoCellIsDrawnFromAndShutWellsSeeWhatIsThere) {
  for (const char* mesh : {"{kind: structured, cells: [12, 4], shape: triangles}", "{size: 0.4 m}"})
    for (const auto& [x, y] :
         {std::array{1.51, 0.01}, {1.47, 1.99}, {0.01, 0.01}, {2.99, 1.99}, {1.63, 1.03}, {1.01, 1.01}}) {
      const auto run = [&](const std::string& control) {
        return SceneRun::from_text(fmt::format(R"(
geometry:
  box: {{x: [0 m, 3 m], y: [0 m, 2 m]}}
  fractures: {{f: {{points: [[1 m, 1 m], [2 m, 1 m]]}}}}
mesh: {}
components:
  pore:
    type: matrix_flow/tpfa
    permeability: 1e-16 m^2
    viscosity: 1 mPa*s
    storage: 1e-9 1/Pa
    initial_pressure: 10 MPa
    boundary: {{left: {{pressure: 10 MPa}}, bottom: {{pressure: 13 MPa}}}}
  wells: {{type: wells/limited, wells: {{w: {{at: [{} m, {} m], index: 1e-12 m^2/(Pa*s), {}}}}}}}
couplers: [{{type: well_exchange, between: [pore, wells]}}]
schedule: [{{solve: [pore, wells]}}]
time: {{end: 1000 s, step: 100 s}}
)",
                                               mesh, x, y, control));
      };
      SceneRun shut = run("rate: 0 m^2/s"), open = run("rate: 1e-7 m^2/s");
      shut.run();
      open.run();
      const double seen = shut.quantity("wells.w.pressure");
      const Vector rise = open.field("pore.pressure") - shut.field("pore.pressure");
      std::printf("%s (%.2f, %.2f) m: sees %.6g of %.6g to %.6g Pa, raises cells by %.3g Pa at least\n", mesh, x, y,
                  seen, shut.field("pore.pressure").minCoeff(), shut.field("pore.pressure").maxCoeff(),
                  rise.minCoeff());
      EXPECT_GE(seen, shut.field("pore.pressure").minCoeff());
      EXPECT_LE(seen, shut.field("pore.pressure").maxCoeff());
      EXPECT_GE(rise.minCoeff(), -1e-9 * rise.maxCoeff());
    }
}

/// Wherever a point lies: shares are not negative, add up to 1, and have their mean where the source says it stands;
/// they change by little with the point, and turn and mirror with it.
TEST(WellsBesideSides, SharesAreMeans) {
  const auto box = [](bool is_mirrored) {
    return SceneRun::from_text(fmt::format(R"(
geometry:
  box: {{x: [0 m, 3 m], y: [0 m, 2 m]}}
  fractures: {{f: {{points: [[1 m, {} m], [2 m, {} m]]}}}}
mesh: {{kind: structured, cells: [6, 4], shape: quadrilaterals}}
components: {{pore: {{type: matrix_flow/mpfa, permeability: 1e-16 m^2, viscosity: 1 mPa*s, storage: 1e-9 1/Pa, initial_pressure: 10 MPa}}}}
schedule: [{{solve: [pore]}}]
time: {{end: 1 s, step: 1 s}}
)",
                                           is_mirrored ? 0.5 : 1.5, is_mirrored ? 0.5 : 1.5));
  };
  SceneRun run = box(false), mirrored = box(true);
  const Mesh &mesh = run.mesh(), &other = mirrored.mesh();
  for (int i = 0; i < 61; ++i)
    for (int j = 0; j < 41; ++j) {
      const Point x(0.013 + 0.0489 * i, 0.011 + 0.0489 * j);
      const auto any = [](int) { return true; };
      const auto right_half = [](const Mesh& of) { return [&of](int cell) { return of.cell_center[cell].x() > 1.5; }; };
      for (const bool everywhere : {true, false}) {
        if (!everywhere && x.x() < 1.5) continue;
        const auto source_at = [&](const Mesh& of, const Point& at) {
          return everywhere ? point_source(of, at, any) : point_source(of, at, right_half(of));
        };
        const PointSource source = source_at(mesh, x), moved = source_at(mesh, x * (1 + 1e-9)),
                          mirror = source_at(other, Point(x.x(), 2 - x.y()));
        Vector shares = Vector::Zero(mesh.cell_count()), near = shares;
        Point mean = Point::Zero();
        for (const auto& [cell, share] : source.shares) {
          EXPECT_GE(share, 0);
          EXPECT_TRUE(everywhere || mesh.cell_center[cell].x() > 1.5);
          shares[cell] += share;
          mean += share * mesh.cell_center[cell];
        }
        for (const auto& [cell, share] : moved.shares) near[cell] += share;
        EXPECT_NEAR(shares.sum(), 1, 1e-14);
        EXPECT_LT((mean - source.at).norm(), 1e-13);
        EXPECT_LT((source.at - x).norm(), 0.5 * std::sqrt(0.5)) << x.transpose();  // half of the diagonal of a cell
        EXPECT_LT((shares - near).lpNorm<1>(), 1e-7) << x.transpose();
        EXPECT_LT((mirror.at - Point(source.at.x(), 2 - source.at.y())).norm(), 1e-12) << x.transpose();
      }
    }
}

}  // namespace
}  // namespace sprekk::testing
