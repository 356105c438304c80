// Flow and heat through crossings of unlike fractures, against closed forms and an equi-dimensional solution.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "tests/verification/scene_run.hpp"

namespace sprekk::testing {
namespace {

constexpr double width = 0.002;  // of all fractures, m

/// Turned by an angle (degrees) about the middle, or mirrored before.
struct Frame {
  double angle = 0;
  bool is_mirrored = false;
  std::string point(double x, double y) const {
    const double a = angle * M_PI / 180;
    if (is_mirrored) x = -x;
    return fmt::format("[{:.17g}, {:.17g}]", std::cos(a) * x - std::sin(a) * y, std::sin(a) * x + std::cos(a) * y);
  }
};

/// Fractures alone, without storage; pressures hold at two points, one end cell each.
double flow_between(const std::string& fractures, const std::string& conduit, const std::string& from,
                    const std::string& to, const std::string& widths = fmt::format("{} m", width)) {
  SceneRun run = SceneRun::from_text(
      "{geometry: {box: {x: [-2, 2], y: [-2, 2]}, fractures: " + fractures +
      "}, mesh: {size: 1, fracture_size: 0.25}, components: {conduit: {type: fracture_flow/tpfa, viscosity: 0.5 Pa*s, "
      "fluid_compressibility: 0 1/Pa, initial_aperture: " +
      widths + ", prescribed: {from: {at: " + from + ", pressure: 3 Pa}, to: {at: " + to + ", pressure: 1 Pa}}, " +
      conduit + "}}, schedule: [{solve: conduit}], time: {end: 1 s, step: 1 s}}");
  run.run();
  EXPECT_NEAR(run.quantity("conduit.from.rate"), -run.quantity("conduit.to.rate"), 1e-12);
  return run.quantity("conduit.from.rate");
}

/// The same between the ends of a, whose half cells beside the crossing pass `within` of k_x, the rest of k_a: with
/// the pressures in the centres of the cells at both ends, over a length of 2 - 0.25.
double exact_flow(double k_a, double k_x, double within) {
  return 2 * width / 0.5 / ((1.75 - 2 * within) / k_a + 2 * within / k_x);
}

const std::vector<Frame> frames = {{}, {30, false}, {77, true}, {0, true}};

std::string two_fractures(const Frame& frame, double angle) {
  const double c = std::cos(angle * M_PI / 180), s = std::sin(angle * M_PI / 180);
  return "{a: {points: [" + frame.point(-1, 0) + ", " + frame.point(1, 0) + "]}, b: {points: [" + frame.point(-c, -s) +
         ", " + frame.point(c, s) + "]}}";
}

const std::string unlike =
    "transmissivity: constant, transmissivity_value: {fractures: {a: 20 m^3, b: 0.02 m^3, default: 0.05 m^3}}";

TEST(CrossingFill, HasTheHarmonicMeanOfBothPermeabilities) {
  // k_a = 1e4, k_b = 10: what fills the crossing has 2/(1/k_a + 1/k_b), whatever the angle.
  const double exact = exact_flow(1e4, 2 / (1e-4 + 0.1), width / 2);
  for (const Frame& frame : frames)
    for (const double angle : {90.0, 40.0})
      EXPECT_NEAR(flow_between(two_fractures(frame, angle), unlike, frame.point(-1, 0), frame.point(1, 0)), exact,
                  1e-11 * exact)
          << frame.angle << " " << angle;
}

TEST(CrossingFill, IsTheSameWithValuesThatAreDisturbed) {
  const Frame frame;
  const double exact = exact_flow(1e4, 2 / (1e-4 + 0.1), width / 2);
  const double flow = flow_between(two_fractures(frame, 90),
                                   "transmissivity: constant, transmissivity_value: {fractures: {a: 20.00000002 m^3, "
                                   "b: 0.02000000002 m^3}}",
                                   frame.point(-1, 0), frame.point(1, 0));
  EXPECT_NEAR(flow, exact, 2e-9 * exact);
}

TEST(CrossingFill, IsThatOfATAndOfThreeFractures) {
  // A branch that only ends there lies in the way all the same; three fractures have the mean of three.
  for (const Frame& frame : frames) {
    const std::string a = "a: {points: [" + frame.point(-1, 0) + ", " + frame.point(1, 0) + "]}";
    const std::string t = ", b: {points: [" + frame.point(0, 0) + ", " + frame.point(0.2, 1) + "]}";
    const std::string third = ", c: {points: [" + frame.point(-0.7, -0.7) + ", " + frame.point(0.7, 0.7) + "]}";
    const double of_t = exact_flow(1e4, 2 / (1e-4 + 0.1), width / 2);
    EXPECT_NEAR(flow_between("{" + a + t + "}", unlike, frame.point(-1, 0), frame.point(1, 0)), of_t, 1e-11 * of_t);
    const double of_three = exact_flow(1e4, 3 / (1e-4 + 0.1 + 0.04), width / 2);
    EXPECT_NEAR(flow_between("{" + a + t + third + "}", unlike, frame.point(-1, 0), frame.point(1, 0)), of_three,
                1e-11 * of_three);
  }
}

TEST(CrossingFill, IsWhatTheSceneSays) {
  const Frame frame;
  const auto flow = [&](const std::string& crossing, const std::string& more = "") {
    return flow_between(two_fractures(frame, 90), unlike + ", crossings: {x: {" + crossing + "}}" + more,
                        frame.point(-1, 0), frame.point(1, 0));
  };
  const double given = exact_flow(1e4, 1e-3, width / 2);
  EXPECT_NEAR(flow("between: [b, a], permeability: 1e-3 m^2"), given, 1e-11 * given);
  EXPECT_NEAR(flow("permeability: 1e-3 m^2"), given, 1e-11 * given);
  const double conductor = exact_flow(1e4, 1e4, width / 2), barrier = exact_flow(1e4, 10, width / 2);
  EXPECT_NEAR(flow("through: a"), conductor, 1e-11 * conductor);
  EXPECT_NEAR(flow("through: b"), barrier, 1e-11 * barrier);
  // The walls of what goes through: 1/kappa each, over the width of a.
  const double walls = 2 / ((1.75 - width) * 0.5 / (1e4 * width) + 2 / (0.3 * width));
  EXPECT_NEAR(flow("through: b",
                   ", normal_permeability: constant, normal_permeability_value: {fractures: {b: 0.3 m/(Pa*s), a: 7 "
                   "m/(Pa*s)}}"),
              walls, 1e-11 * walls);
}

TEST(CrossingFill, IsSealedByADryFractureThatGoesThrough) {
  // Fluid injected into one half of a stays there.
  const auto pressure = [](const std::string& more) {
    SceneRun run = SceneRun::from_text(
        "{geometry: {box: {x: [-2, 2], y: [-2, 2]}, fractures: {a: {points: [[-1, 0], [1, 0]]}, b: {points: [[0, -1], "
        "[0, 1]]}}}, mesh: {size: 1, fracture_size: 0.25}, components: {conduit: {type: fracture_flow/tpfa, viscosity: "
        "0.5 Pa*s, fluid_compressibility: 1e-3 1/Pa, initial_aperture: 1 mm, fractures: a, transmissivity: constant, "
        "transmissivity_value: 1 m^3, normal_permeability: constant, normal_permeability_value: 1 m/(Pa*s), injection: "
        "{well: {at: [-0.9, 0], rate: 1e-6 m^2/s}}" +
        more + "}}, schedule: [{solve: conduit}], time: {end: 1 s, step: 1 s}}");
    run.run();
    double least = 1, most = 0;
    for (int i = 0; i < run.mesh().fracture_cell_count(); ++i) {
      if (run.mesh().fracture_cells[i].fracture != 0) continue;
      least = std::min(least, run.field("conduit.pressure")[i]);
      most = std::max(most, run.field("conduit.pressure")[i]);
    }
    return std::array{least, most};
  };
  const std::array sealed = pressure(", crossings: {x: {through: b}}"), open = pressure("");
  EXPECT_EQ(sealed[0], 0);
  EXPECT_NEAR(sealed[1], 1e-6 / (1e-3 * 1e-3 * 1), 1e-5);
  EXPECT_NEAR(open[0], 1e-6 / (1e-3 * 1e-3 * 2), 1e-5);
}

TEST(CrossingFill, IsOpenWhereApertureSaysHowFracturesConduct) {
  // Channels of 2 mm and 0.02 mm: the narrow one takes nothing from the wide one. A plug does.
  const Frame frame;
  const auto flow = [&](const std::string& conduit) {
    return flow_between(two_fractures(frame, 90), conduit, frame.point(-1, 0), frame.point(1, 0),
                        "{fractures: {a: 2 mm, b: 0.02 mm}}");
  };
  const double k = width * width / 12, open = exact_flow(k, k, 0);
  EXPECT_NEAR(flow("transmissivity: cubic_law"), open, 1e-11 * open);
  const double plugged = exact_flow(k, 1e-12, 1e-5);
  EXPECT_NEAR(flow("crossings: {x: {permeability: 1e-12 m^2}}"), plugged, 1e-11 * plugged);
}

TEST(CrossingFill, ConductsHeatAsItConductsFluid) {
  // One step of 1e15 s: steady. Ends on the sides; 4 m from side to side.
  const auto heat = [](const std::string& more) {
    SceneRun run = SceneRun::from_text(
        "{geometry: {box: {x: [-2, 2], y: [-2, 2]}, fractures: {a: {points: [[-2, 0], [2, 0]]}, b: {points: [[0.3, "
        "-1], [0.1, 1]]}}}, mesh: {size: 1, fracture_size: 0.25}, components: {water: {type: fracture_heat/tpfa, "
        "aperture: 2 mm, conductivity: {fractures: {a: 20 W/(m*K), b: 0.5 W/(m*K)}}, heat_capacity: 1 J/(m^3*K), "
        "initial_temperature: 300 K, boundary: {left: {temperature: 340 K}, right: {temperature: 300 K}}" +
        more + "}}, schedule: [{solve: water}], time: {end: 1e15 s, step: 1e15 s}}");
    run.run();
    const Mesh& mesh = run.mesh();
    for (int i = 0; i < mesh.fracture_cell_count(); ++i) {
      const FractureCell& cell = mesh.fracture_cells[i];
      if (mesh.ridges[cell.ridges[0]].kind == Ridge::Kind::on_boundary && cell.center.x() < -1)
        return 20 * width * (340 - run.field("water.temperature")[i]) / (0.5 * cell.measure);
    }
    return 0.0;
  };
  const auto exact = [](double filled) { return 40 * width / ((4 - width) / 20 + width / filled); };
  const double mean = exact(2 / (1 / 20.0 + 1 / 0.5));
  EXPECT_NEAR(heat(""), mean, 1e-9 * mean);
  EXPECT_NEAR(heat(", crossings: {x: {conductivity: 1e-3 W/(m*K)}}"), exact(1e-3), 1e-9 * exact(1e-3));
  EXPECT_NEAR(heat(", crossings: {x: {between: [a, b], through: b}}"), exact(0.5), 1e-9 * exact(0.5));
  EXPECT_NEAR(heat(", crossings: {x: {through: a}}"), exact(20), 1e-9 * exact(20));
}

/// The flow through a unit square with a barrier, from the left to the right, as in tests/verification/references/
/// crossing.py.
double flow_across(const std::vector<double>& row, const std::string& mesh) {
  const double barrier = row[0], conductor = row[1], along = row[2], normal = row[3], k = row[4];
  const std::vector<std::string> fills = {"", "crossings: {x: {between: [barrier, conductor], through: barrier}}, ",
                                          "crossings: {x: {between: [barrier, conductor], through: conductor}}, "};
  SceneRun run = SceneRun::from_text(fmt::format(
      "{{geometry: {{box: {{x: [0, 1], y: [0, 1]}}, fractures: {{barrier: {{points: [[0.5, 0], [0.5, 1]]}}, conductor: "
      "{{points: [[0.1, 0.53], [0.9, 0.53]]}}}}}}, mesh: {}, components: {{pore: {{type: matrix_flow/mpfa, viscosity: "
      "1 Pa*s, permeability: 1 m^2, storage: 0 1/Pa, boundary: {{left: {{pressure: 1 Pa}}, right: {{pressure: 0 "
      "Pa}}}}}}, conduit: {{type: fracture_flow/tpfa, viscosity: 1 Pa*s, fluid_compressibility: 0 1/Pa, {}"
      "initial_aperture: {{fractures: {{barrier: {} m, conductor: {} m}}}}, transmissivity: constant, "
      "transmissivity_value: {{fractures: {{barrier: {} m^3, conductor: {} m^3}}}}, normal_permeability: constant, "
      "normal_permeability_value: {{fractures: {{barrier: {} m/(Pa*s), conductor: {} m/(Pa*s)}}}}}}}}, couplers: "
      "[{{type: wall_exchange, between: [pore, conduit]}}], schedule: [{{solve: [pore, conduit]}}], time: {{end: 1 s, "
      "step: 1 s}}}}",
      mesh, fills[static_cast<std::size_t>(row[5])], barrier, conductor, along * barrier, k * conductor,
      2 * normal / barrier, 2 * k / conductor));
  run.run();
  EXPECT_LE(std::abs(run.quantity("fluid_balance_error")), 1e-11);
  return run.quantity("pore.right.outflow");
}

TEST(CrossingFill, HasTheFlowOfAnEquidimensionalSolution) {
  // Fractures without width leave rock in their place: right to about their width, of the lengths over which the rock
  // takes pressure. A conductor that goes through has its ends 0.1 m from the sides, where lines replace blunt ends.
  const auto reference = read_numbers(std::string(SPREKK_SOURCE_DIR) + "/tests/verification/references/crossing.csv");
  ASSERT_EQ(reference.size(), 24u);
  for (const std::vector<double>& row : reference) {
    const double flow = flow_across(row, "{size: 0.1, fracture_size: 0.05}");
    const double bound = row[5] == 2 ? 0.01 + row[1] / (2 * 0.1) : 0.002 + std::max(row[0], row[1]);
    EXPECT_NEAR(flow / row[6], 1, bound) << row[0] << " " << row[1] << " " << row[3] << " fill " << row[5];
    RecordProperty(fmt::format("{:g} {:g} {:g} {:g}", row[0], row[1], row[3], row[5]),
                   fmt::format("{:.1e}", flow / row[6] - 1));
  }
}

}  // namespace
}  // namespace sprekk::testing
