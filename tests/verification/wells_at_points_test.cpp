// Wells, and prescribed pressures, act at their points and not in the cells around them.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "tests/verification/balance_error.hpp"

namespace sprekk::testing {
namespace {

constexpr double pi = std::numbers::pi;

/// A map of the plane by whole right angles and mirrors, with the names of the sides.
struct Twin {
  std::string name;
  double xx, xy, yx, yy;
  std::array<std::string, 4> sides;  ///< what left, right, bottom and top become
  std::string operator()(double x, double y) const {
    return fmt::format("[{:.17g} m, {:.17g} m]", xx * x + xy * y, yx * x + yy * y);
  }
  /// A box around the middle.
  std::string box(double half_x, double half_y) const {
    const double x = std::abs(xx * half_x + xy * half_y), y = std::abs(yx * half_x + yy * half_y);
    return fmt::format("{{x: [-{0} m, {0} m], y: [-{1} m, {1} m]}}", x, y);
  }
  std::string cells(int along_x, int along_y) const {
    return xx != 0 ? fmt::format("[{}, {}]", along_x, along_y) : fmt::format("[{}, {}]", along_y, along_x);
  }
};
const Twin same{"same", 1, 0, 0, 1, {"left", "right", "bottom", "top"}};
const Twin turned{"turned", 0, -1, 1, 0, {"bottom", "top", "right", "left"}};
const Twin mirrored{"mirrored", -1, 0, 0, 1, {"right", "left", "bottom", "top"}};

/// A fracture that hardly conducts from side to side of a box; its rock is drained at 4 m on both sides.
std::string leaking_fracture(const Twin& at, const std::string& points, double well, const std::string& with,
                             const std::string& probes) {
  return fmt::format(R"(
geometry: {{box: {}, fractures: {{f: {{points: {}}}}}}}
mesh: {{size: 0.5 m, fracture_size: 0.2 m}}
components:
  pore:
    type: matrix_flow/mpfa
    permeability: 1e-17 m^2
    viscosity: 1e-3 Pa*s
    storage: 1e-10 1/Pa
    boundary: {{{}: {{pressure: 0 Pa}}, {}: {{pressure: 0 Pa}}}}
  conduit:
    type: fracture_flow/tpfa
    viscosity: 1e-3 Pa*s
    fluid_compressibility: 4e-10 1/Pa
    initial_aperture: 1 mm
    law: {{type: constant, transmissivity: 1e-16 m^3}}
    normal_permeability: constant
    normal_permeability_value: 1e-13 m/(Pa*s)
{}
time: {{end: 1e14 s, step: 1e14 s}}
output: {{probes: {{{}}}}}
)",
                     at.box(10, 4), points, at.sides[2], at.sides[3],
                     fmt::format(fmt::runtime(with), fmt::arg("at", at(well, 0))), probes);
}

const std::string by_well =
    R"(  wells: {{type: wells/limited, wells: {{w: {{at: {at}, fracture: f, rate: 1e-9 m^2/s}}}}}}
couplers: [{{type: wall_exchange, between: [pore, conduit]}}, {{type: well_exchange, between: [pore, conduit, wells]}}]
schedule: [{{solve: [pore, conduit, wells]}}])";
const std::string by_injection = R"(    injection: {{w: {{at: {at}, rate: 1e-9 m^2/s}}}}
couplers: [{{type: wall_exchange, between: [pore, conduit]}}]
schedule: [{{solve: [pore, conduit]}}])";
const std::string by_pressure = R"(    prescribed: {{w: {{at: {at}, pressure: 20 kPa}}}}
couplers: [{{type: wall_exchange, between: [pore, conduit]}}]
schedule: [{{solve: [pore, conduit]}}])";

/// Reference: the sum of the modes cos(k (x + 10 m)) of a fracture between closed ends, in each of which the fracture
/// takes T k^2 p and its walls let out 2 p/(1/kappa + tanh(k H)/(m k)), H = 4 m.
double leaking_pressure(double x, double well) {
  const double conductance = 1e-13, mobility = 1e-14, wall = 1e-13, length = 20;
  double sum = 1 / length / (2 / (1 / wall + 4 / mobility));
  for (int n = 1; n < 50000; ++n) {
    const double k = n * pi / length;
    const double out = 2 / (1 / wall + std::tanh(4 * k) / (mobility * k));
    sum += 2 / length * std::cos(k * (x + 10)) * std::cos(k * (well + 10)) / (conductance * k * k + out);
  }
  return 1e-9 * sum;
}

/// In the middle of the fracture, where two cells meet, at a quarter of a cell from there, and at a centre: the
/// pressure at 1 m on both sides, for each direction of the fracture and each twin. With the pressure prescribed at the
/// point the rate comes out instead.
TEST(WellsAtPoints, FeedAFractureFromTheirPoint) {
  for (const double well : {0.0, 0.05, 0.1}) {
    const double exact_left = leaking_pressure(well - 1, well), exact_right = leaking_pressure(well + 1, well);
    for (const Twin& at : {same, turned, mirrored})
      for (const bool is_reversed : {false, true}) {
        const std::string points = is_reversed ? fmt::format("[{}, {}]", at(10, 0), at(-10, 0))
                                               : fmt::format("[{}, {}]", at(-10, 0), at(10, 0));
        const std::string probes =
            fmt::format("l: {{of: conduit.pressure, at: {}}}, r: {{of: conduit.pressure, at: {}}}", at(well - 1, 0),
                        at(well + 1, 0));
        double rate = 0;
        for (const std::string& with : {by_well, by_injection, by_pressure}) {
          if (with != by_well && (&at != &same || is_reversed)) continue;
          SceneRun run = SceneRun::from_text(leaking_fracture(at, points, well, with, probes));
          run.run();
          EXPECT_LT(balance_error(run), 1e-9);
          const double scale = with == by_pressure ? run.quantity("conduit.w.rate") / 1e-9 : 1;
          const double left = run.quantity("l") / scale / exact_left - 1,
                       right = run.quantity("r") / scale / exact_right - 1;
          std::printf("well at %.2f m, %s%s: 1 m beside it %+.2e %+.2e\n", well, at.name.c_str(),
                      is_reversed ? ", reversed" : "", left, right);
          EXPECT_LT(std::abs(left), 5e-4);
          EXPECT_LT(std::abs(right), 5e-4);
          if (well == 0) {  // the mesh is not quite symmetric
            EXPECT_NEAR(run.quantity("l") / run.quantity("r"), 1, 1e-5);
          }
          // What a rate needs as pressure at its point is what a pressure there lets in.
          if (with == by_well) rate = 1e-9 / run.quantity("wells.w.pressure");
          if (with == by_injection) {
            EXPECT_NEAR(1e-9 / run.quantity("conduit.w.pressure") / rate, 1, 1e-9);
          }
          if (with == by_pressure) {
            EXPECT_NEAR(run.quantity("conduit.w.rate") / 20e3 / rate, 1, 1e-9);
          }
        }
      }
  }
}

/// A well where two fractures cross in their middle feeds four arms alike, in rock that is symmetric around it.
TEST(WellsAtPoints, FeedAllArmsOfACrossingAlike) {
  for (const bool is_reversed : {false, true})
    for (const char* fracture : {"a", "b"})
      for (const double disturbed : {0.0, 1e-9}) {
        SceneRun run = SceneRun::from_text(fmt::format(
            R"(
geometry: {{box: {{x: [0 m, 10 m], y: [0 m, 10 m]}}, fractures: {{a: {{points: {}}}, b: {{points: [[5 m, 2 m], [5 m, 8 m]]}}}}}}
mesh: {{kind: structured, cells: [20, 20], shape: quadrilaterals}}
components:
  pore: {{type: matrix_flow/mpfa, permeability: 1e-14 m^2, viscosity: 1 mPa*s, storage: 1e-9 1/Pa, initial_pressure: 5 MPa}}
  conduit: {{type: fracture_flow/tpfa, viscosity: 1 mPa*s, fluid_compressibility: 4e-10 1/Pa, initial_aperture: 0.1 mm, initial_pressure: 5 MPa}}
  wells: {{type: wells/limited, wells: {{w: {{rate: 1e-7 m^2/s, at: [{:.17g} m, 5 m], fracture: {}}}}}}}
couplers: [{{type: well_exchange, between: [wells, pore, conduit]}}, {{type: wall_exchange, between: [pore, conduit]}}]
schedule: [{{solve: [pore, conduit, wells]}}]
time: {{end: 1 day, step: 1 h}}
output:
  probes: {{pl: {{of: pore.pressure, at: [1 m, 5 m]}}, pr: {{of: pore.pressure, at: [9 m, 5 m]}}, pt: {{of: pore.pressure, at: [5 m, 9 m]}}, pb: {{of: pore.pressure, at: [5 m, 1 m]}}}}
)",
            is_reversed ? "[[8 m, 5 m], [2 m, 5 m]]" : "[[2 m, 5 m], [8 m, 5 m]]", 5 * (1 + disturbed), fracture));
        run.run();
        const double left = run.quantity("pl") - 5e6;
        EXPECT_GT(left, 1e4);
        for (const char* side : {"pr", "pt", "pb"}) EXPECT_NEAR((run.quantity(side) - 5e6) / left, 1, 1e-6);
        EXPECT_LT(balance_error(run), 1e-9);
      }
}

/// A well where a fracture crosses another one that conducts a millionth of it: what the other one takes is in
/// proportion. Reference: steady flow to the four ends. An arm leads from its end to the middle of the crossing, the
/// last half aperture through what fills it, whose permeability is the harmonic mean of both.
TEST(WellsAtPoints, FeedArmsAsTheyConduct) {
  for (const double small : {1e-9, 1e-12, 1e-15})
    for (const double off : {0.0, 0.03, -0.03}) {
      SceneRun run = SceneRun::from_text(fmt::format(R"(
geometry: {{box: {{x: [-1 m, 1 m], y: [-1 m, 1 m]}}, fractures: {{a: {{points: [[-1 m, 0 m], [1 m, 0 m]]}}, b: {{points: [[0 m, -1 m], [0 m, 1 m]]}}}}}}
mesh: {{kind: structured, cells: [10, 10], shape: quadrilaterals}}
components:
  conduit:
    type: fracture_flow/tpfa
    viscosity: 1 mPa*s
    fluid_compressibility: 0 1/Pa
    initial_aperture: 1 mm
    law: {{type: constant, transmissivity: {{fractures: {{a: 1e-9 m^3, b: {} m^3}}}}}}
    boundary: {{left: {{pressure: 0 Pa}}, right: {{pressure: 0 Pa}}, top: {{pressure: 0 Pa}}, bottom: {{pressure: 0 Pa}}}}
  wells: {{type: wells/limited, wells: {{w: {{rate: 1e-6 m^2/s, at: [{} m, 0 m], fracture: a}}}}}}
couplers: [{{type: well_exchange, between: [wells, conduit]}}]
schedule: [{{solve: [conduit, wells]}}]
time: {{end: 1 s, step: 1 s}}
)",
                                                     small, off));
      run.run();
      const double aperture = 1e-3, half = aperture / 2, of_a = 1e-9 / aperture, of_b = small / aperture;
      const double of_fill = 2 / (1 / of_a + 1 / of_b);
      const auto arm = [&](double permeability) {
        return 1e-3 / aperture * ((1 - half) / permeability + half / of_fill);
      };
      const double outwards = 1e-3 / aperture * (1 - std::abs(off)) / of_a;
      const double beyond = 1 / (1 / arm(of_a) + 2 / arm(of_b));
      const double exact = off == 0 ? 1e-6 / (2 / arm(of_a) + 2 / arm(of_b))
                                    : 1e-6 / (1 / outwards + 1 / (arm(of_a) - outwards + beyond));
      EXPECT_NEAR(run.quantity("wells.w.pressure") / exact, 1, 1e-9) << small << " " << off;
    }
}

/// Steady flow from a well in a box whose left and right side hold a pressure: the logarithm of a strip and its images
/// in the other two sides (bore hole of the radius 0.1 m; its pressure is the mean around it).
double bore_hole_in_a_box(double x, double y, double width, double height) {
  const auto strip = [&](double px, double py, double source) {
    const double far = std::cosh(pi * (py - source) / width);
    return std::log((far - std::cos(pi * (px + x) / width)) / (far - std::cos(pi * (px - x) / width))) / (4 * pi);
  };
  double sum = 0;
  constexpr int around = 8;
  for (int k = 0; k < around; ++k) {
    const double px = x + 0.1 * std::cos(2 * pi * k / around), py = y + 0.1 * std::sin(2 * pi * k / around);
    for (int image = -20; image <= 20; ++image)
      sum += (strip(px, py, 2 * image * height + y) + strip(px, py, 2 * image * height - y)) / around;
  }
  return sum;
}

/// Wherever the well lies in its cell: in the middle, beside it, on the side of a cell, and at a node.
TEST(WellsAtPoints, StandInRockWhereTheyAre) {
  for (const char* mesh : {"{kind: structured, cells: [15, 13], shape: quadrilaterals}",
                           "{kind: structured, cells: [15, 13], shape: triangles}", "{size: 20 m}"})
    for (const char* type : {"tpfa", "mpfa"}) {
      if (std::string(type) == "tpfa" && std::string(mesh).find("quadrilaterals") == std::string::npos) continue;
      double worst = 0;
      for (const double dx : {0.0, 1.0, 5.0, 10.0})
        for (const double dy : {0.0, 3.0, 10.0}) {
          const double x = 110 + dx, y = 130 + dy;
          SceneRun run = SceneRun::from_text(fmt::format(R"(
geometry: {{box: {{x: [0 m, 300 m], y: [0 m, 260 m]}}}}
mesh: {}
components:
  pore:
    type: matrix_flow/{}
    permeability: 1e-14 m^2
    viscosity: 1 mPa*s
    storage: 0 1/Pa
    initial_pressure: 10 MPa
    boundary: {{left: {{pressure: 10 MPa}}, right: {{pressure: 10 MPa}}}}
  wells: {{type: wells/limited, wells: {{w: {{at: [{} m, {} m], rate: -1e-5 m^2/s}}}}}}
couplers: [{{type: well_exchange, between: [pore, wells]}}]
schedule: [{{solve: [pore, wells]}}]
time: {{end: 1 s, step: 1 s}}
)",
                                                         mesh, type, x, y));
          run.run();
          const double exact = 1e-5 / 1e-11 * bore_hole_in_a_box(x, y, 300, 260);
          const double error = (1e7 - run.quantity("wells.w.pressure")) / exact - 1;
          std::printf("%s %s, %4.1f %4.1f m from the middle: %+.1e\n", mesh, type, dx, dy, error);
          worst = std::max(worst, std::abs(error));
        }
      EXPECT_LT(worst, 1e-3) << mesh << type;
    }
}

/// Between two pressures in one fracture the flow is that of their distance, wherever they lie in cells.
TEST(WellsAtPoints, PrescribedPressuresHoldAtTheirPoints) {
  for (const double one : {-0.5, -0.53, -0.55, -0.56})
    for (const double other : {0.25, 0.3, 0.31}) {
      SceneRun run = SceneRun::from_text(fmt::format(R"(
geometry: {{box: {{x: [-1 m, 1 m], y: [-1 m, 1 m]}}, fractures: {{a: {{points: [[-1 m, 0.2 m], [1 m, -0.2 m]]}}}}}}
mesh: {{size: 0.5 m, fracture_size: 0.1 m}}
components:
  conduit:
    type: fracture_flow/tpfa
    viscosity: 1 mPa*s
    fluid_compressibility: 4e-10 1/Pa
    initial_aperture: 1 mm
    law: {{type: constant, transmissivity: 1e-9 m^3}}
    prescribed:
      high: {{at: [{:.17g} m, {:.17g} m], pressure: 3 MPa}}
      low: {{at: [{:.17g} m, {:.17g} m], pressure: 1 MPa}}
schedule: [{{solve: conduit}}]
time: {{end: 1e6 s, step: 1e5 s}}
)",
                                                     one, -0.2 * one, other, -0.2 * other));
      run.run();
      const double exact = 1e-6 * 2e6 / ((other - one) * std::hypot(1, 0.2));
      EXPECT_NEAR(run.quantity("conduit.high.rate") / exact, 1, 1e-8);
      EXPECT_NEAR(run.quantity("conduit.low.rate") / exact, -1, 1e-8);
      EXPECT_LT(balance_error(run), 1e-9);
    }
}

/// Reference: a box of one pressure and of the capacity C whose well holds a pressure behind the resistance R,
/// e^(−t/RC) from the start: with two stages a step the error falls by four when steps are halved.
TEST(WellsAtPoints, TwoStagesHaveSecondOrder) {
  double coarser = 0;
  for (const double dt : {2000.0, 1000.0, 500.0}) {
    SceneRun run = SceneRun::from_text(fmt::format(R"(
geometry: {{box: {{x: [0 m, 10 m], y: [0 m, 10 m]}}}}
mesh: {{kind: structured, cells: [5, 5], shape: quadrilaterals}}
components:
  pore: {{type: matrix_flow/tpfa, permeability: 1e-8 m^2, viscosity: 1 mPa*s, storage: 1e-9 1/Pa, initial_pressure: 1 MPa}}
  wells: {{type: wells/limited, wells: {{w: {{at: [5.7 m, 4.4 m], index: 1e-11 m^2/(Pa*s), pressure: 2 MPa}}}}}}
couplers: [{{type: well_exchange, between: [wells, pore]}}]
schedule: [{{solve: [pore, wells]}}]
time: {{end: 2e4 s, step: {} s, scheme: sdirk2}}
)",
                                                   dt));
    run.run();
    const double exact = 1e-11 * 1e6 * std::exp(-2e4 / 1e4), error = run.quantity("wells.w.rate") / exact - 1;
    std::printf("steps of %.0f s: error %+.2e, order %.2f\n", dt, error, std::log2(std::abs(coarser / error)));
    EXPECT_LT(std::abs(error), 0.1 * std::pow(dt / 1e4, 2));
    if (coarser != 0) {
      EXPECT_NEAR(std::log2(std::abs(coarser / error)), 2, 0.15);
    }
    EXPECT_LT(balance_error(run), 1e-9);
    coarser = error;
  }
}

}  // namespace
}  // namespace sprekk::testing
