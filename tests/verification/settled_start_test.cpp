// Rock with weight that starts in equilibrium (start: settle), against closed forms.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "framework/config/input_error.hpp"
#include "tests/verification/scene_run.hpp"

namespace sprekk::testing {
namespace {

constexpr double gravity = 10, alpha = 0.8, depth = 1000, interface = 400, width = 100;

/// Which way is up: (0, 1) or along (1, 0).
struct Frame {
  std::string name, rock;
  bool along_x = false;
  std::string mesh = "size: 30 m";
  double stress = 1e-9;  ///< the error of the stress, of the largest
  std::string place(double across, double up) const {
    return along_x ? fmt::format("[{} m, {} m]", up, across) : fmt::format("[{} m, {} m]", across, up);
  }
  std::string box() const {
    const std::string sides[2] = {fmt::format("[0 m, {} m]", width), fmt::format("[{} m, 0 m]", -depth)};
    return fmt::format("{{x: {}, y: {}}}", sides[along_x], sides[!along_x]);
  }
  std::string pull() const { return along_x ? "[-10 m/s^2, 0]" : "[0, -10 m/s^2]"; }
  std::string up() const { return along_x ? "x" : "y"; }
  std::string across() const { return along_x ? "y" : "x"; }
  std::string side(const std::string& what) const {
    if (!along_x) return what;
    return what == "left" ? "bottom" : what == "right" ? "top" : what == "bottom" ? "left" : "right";
  }
};

/// A column of two layers under its weight, full of water up to its top. Its total stress without the weight is
/// −alpha p_0, so that K_0 holds for the effective stress.
std::string column(const Frame& frame, const std::string& more = "", const std::string& mesh = "") {
  const std::string layer = fmt::format("[{}, {}, {}, {}]", frame.place(0, -depth), frame.place(width, -depth),
                                        frame.place(width, -interface), frame.place(0, -interface));
  return fmt::format(R"(
geometry:
  box: {0}
  regions: {{lower: {{polygon: {1}}}}}
  {2}
mesh: {{{3}}}
components:
  pore:
    type: matrix_flow/mpfa
    permeability: 1e-15 m^2
    viscosity: 1 mPa*s
    storage: 1e-10 1/Pa
    fluid_density: 1000 kg/m^3
    gravity: {4}
    initial_pressure: (-1e4*{5}) Pa
    boundary: {{{6}: {{pressure: 0 Pa}}}}
  rock:
    type: {7}
    young_modulus: {{regions: {{lower: 40 GPa, default: 10 GPa}}}}
    poisson_ratio: {{regions: {{lower: 0.2, default: 0.3}}}}
    rock_density: {{regions: {{lower: 2600 kg/m^3, default: 2200 kg/m^3}}}}
    gravity: {4}
    initial_stress: (0.8*1e4*{5}) Pa
    boundary:
      {8}: {{displacement_{9}: 0 m}}
      {10}: {{displacement_{9}: 0 m}}
      {11}: {{displacement_{5}: 0 m}}
)",
                     frame.box(), layer, more, mesh.empty() ? frame.mesh : mesh, frame.pull(), frame.up(),
                     frame.side("top"), frame.rock, frame.side("left"), frame.across(), frame.side("right"),
                     frame.side("bottom"));
}

const std::string without_fault = R"(
couplers: [{type: biot, between: [pore, rock], biot_coefficient: 0.8}]
start: {settle: rock}
schedule: [{solve: [pore, rock]}]
time: {end: 4 day, step: 1 day}
)";

Vector stress_of(SceneRun& run) {
  for (const OutputField& field : run.model().output())
    if (field.name == "rock.stress") return field.values;
  throw std::logic_error("no stress");
}

double poisson(double up) { return up < -interface ? 0.2 : 0.3; }

/// The vertical total stress, the integral of the weight.
double vertical(double up) {
  return gravity * (up < -interface ? 2600 * (up + interface) - 2200 * interface : 2200 * up);
}

const std::string squares = "kind: structured, shape: quadrilaterals, cells: ";
const std::vector<Frame> frames = {
    {"mpsa", "poromechanics/mpsa", false, "size: 30 m", 1e-2},
    {"mpsa, finer", "poromechanics/mpsa", false, "size: 15 m", 5e-3},
    {"mpsa, squares", "poromechanics/mpsa", false, squares + "[4, 40]"},
    {"fem", "poromechanics/fem", false},
    {"mpsa, turned", "poromechanics/mpsa", true, "size: 30 m", 1e-2},
    {"mpsa, squares, turned", "poromechanics/mpsa", true, squares + "[40, 4]"},
    {"fem, turned", "poromechanics/fem", true},
};

/// Reference: sigma_v is the integral of the weight, and the effective stress across is nu/(1 − nu) of that along it:
/// exactly on squares, and for elements of second order, since the displacement is quadratic; on triangles MPSA, which
/// is exact for linear ones, is of first order. Nothing moves afterwards, and the pressure stays hydrostatic.
TEST(SettledStart, ColumnOfLayersHasItsWeightAndRests) {
  for (const Frame& frame : frames) {
    SceneRun run = SceneRun::from_text(column(frame) + without_fault);
    double largest = 0, moved = 0, leaked = 0;
    const Vector before = run.field("pore.pressure");
    run.run_until(4 * 86400,
                  [&] { moved = std::max(moved, run.field("rock.displacement").lpNorm<Eigen::Infinity>()); });
    leaked = (run.field("pore.pressure") - before).lpNorm<Eigen::Infinity>();
    const Vector stress = stress_of(run);
    const int up = frame.along_x ? 0 : 1;
    for (int c = 0; c < run.mesh().cell_count(); ++c) {
      const double y = run.mesh().cell_center[c][up], pore = alpha * -1e4 * y;
      const double along = vertical(y), k0 = poisson(y) / (1 - poisson(y));
      const double error =
          std::max({std::abs(stress[3 * c + up] - along),
                    std::abs(stress[3 * c + 1 - up] - (k0 * (along + pore) - pore)), std::abs(stress[3 * c + 2])});
      largest = std::max(largest, error / -vertical(-depth));
    }
    std::printf("%s: stress off by %.1e of the largest, moved by %.1e m, pressure by %.1e Pa\n", frame.name.c_str(),
                largest, moved, leaked);
    EXPECT_LT(largest, frame.stress) << frame.name;
    EXPECT_LT(moved, 1e-14) << frame.name;  // the weight shortens the column by half a metre
    EXPECT_LT(leaked, 1e-7) << frame.name;
  }
}

std::string with_fault(const Frame& frame, double friction) {
  const std::string fault =
      fmt::format("fractures: {{fault: {{points: [{}, {}]}}}}", frame.place(20, -700), frame.place(70, -580));
  return column(frame, fault, "size: 40 m, fracture_size: 15 m") + fmt::format(R"(
  contact: {{type: contact/coulomb, friction: {}}}
couplers:
  - {{type: biot, between: [pore, rock], biot_coefficient: 0.8}}
  - {{type: wall_traction, between: [rock, contact]}}
start: {{settle: [rock, contact]}}
schedule: [{{solve: [pore, rock, contact]}}]
time: {{end: 4 day, step: 1 day}}
)",
                                                                               friction);
}

/// Reference: a fault that friction holds changes nothing: its tractions are those of the column, and neither it nor
/// the rock moves afterwards.
TEST(SettledStart, FaultThatSticksRests) {
  for (const Frame& frame : frames) {
    if (frame.mesh != "size: 30 m") continue;
    SceneRun run = SceneRun::from_text(with_fault(frame, 0.6));
    double moved = 0, slipped = 0, worst = 0;
    run.run_until(4 * 86400, [&] {
      moved = std::max(moved, run.field("rock.displacement").lpNorm<Eigen::Infinity>());
      slipped = std::max(slipped, run.field("contact.jump").lpNorm<Eigen::Infinity>());
    });
    for (int i = 0; i < run.mesh().fracture_cell_count(); ++i) {
      const FractureCell& cell = run.mesh().fracture_cells[i];
      const int up = frame.along_x ? 0 : 1;
      const double y = cell.center[up], pore = alpha * -1e4 * y, along = vertical(y);
      Tensor stress = Tensor::Zero();
      stress(up, up) = along;
      stress(1 - up, 1 - up) = poisson(y) / (1 - poisson(y)) * (along + pore) - pore;
      const Point traction = cell.to_local(stress * cell.normal);
      worst = std::max(worst, (run.field("contact.traction").segment<2>(2 * i) - traction).norm() / -along);
    }
    std::printf("%s: moved by %.1e m, slipped by %.1e m, traction off by %.1e\n", frame.name.c_str(), moved, slipped,
                worst);
    EXPECT_LT(moved, 1e-14) << frame.name;
    EXPECT_LT(slipped, 1e-14) << frame.name;
    EXPECT_LT(worst, 2e-3) << frame.name;
  }
}

/// Reference: the same rock with the closed form of its stress as initial stress. What happens afterwards (the pressure
/// of the upper side rises) is the same to round-off.
TEST(SettledStart, GoesOnAsFromTheStressThatIsGiven) {
  for (const std::string rock : {"poromechanics/mpsa", "poromechanics/fem"}) {
    const auto scene = [&](const std::string& stress, const std::string& start) {
      return fmt::format(R"(
geometry: {{box: {{x: [0 m, 100 m], y: [-200 m, 0 m]}}}}
mesh: {{size: 20 m}}
components:
  pore: {{type: matrix_flow/mpfa, permeability: 1e-14 m^2, viscosity: 1 mPa*s, storage: 1e-10 1/Pa, boundary: {{top: {{pressure: 1 MPa}}}}}}
  rock:
    type: {}
    young_modulus: 10 GPa
    poisson_ratio: 0.25
    rock_density: 2400 kg/m^3
    gravity: [0, -10 m/s^2]
    initial_stress: {}
    boundary: {{left: {{displacement_x: 0 m}}, right: {{displacement_x: 0 m}}, bottom: {{displacement_y: 0 m}}}}
couplers: [{{type: biot, between: [pore, rock], biot_coefficient: 0.8}}]
{}
schedule: [{{solve: [pore, rock]}}]
time: {{end: 10 day, step: 1 day}}
)",
                         rock, stress, start);
    };
    SceneRun settled = SceneRun::from_text(scene("0 Pa", "start: {settle: rock}"));
    SceneRun given = SceneRun::from_text(scene("{xx: (8000*y) Pa, yy: (24000*y) Pa}", ""));
    for (SceneRun* run : {&settled, &given}) run->run();
    for (const std::string name : {"rock.displacement", "pore.pressure"}) {
      const Vector &one = settled.field(name), &other = given.field(name);
      EXPECT_GT(other.lpNorm<Eigen::Infinity>(), 1e-4) << name;
      EXPECT_LT((one - other).lpNorm<Eigen::Infinity>(), 1e-9 * other.lpNorm<Eigen::Infinity>()) << rock << name;
    }
    const double stress = (stress_of(settled) - stress_of(given)).lpNorm<Eigen::Infinity>() / 4.8e6;
    EXPECT_LT(stress, rock == "poromechanics/fem" ? 1e-9 : 5e-3) << rock;
  }
}

/// What a scene may not ask for, and the words of the answer.
TEST(SettledStart, MistakesAreRefused) {
  const auto said = [](std::string scene, const std::string& from, const std::string& to) -> std::string {
    const auto place = scene.find(from);
    EXPECT_NE(place, std::string::npos) << from;
    scene.replace(place, from.size(), to);
    try {
      SceneRun run = SceneRun::from_text(scene);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  const std::string scene = column(frames[0]) + without_fault, start = "start: {settle: rock}";
  const auto has = [&](const std::string& text, const std::string& words) {
    EXPECT_NE(text.find(words), std::string::npos) << text;
  };
  has(said(scene, start, "start: {settle: rok}"), "did you mean 'rock'");
  has(said(with_fault(frames[0], 0.6), "settle: [rock, contact]", "settle: rock"), "is settled without 'contact'");
  has(said(scene, start, "start: {settle: rock, from: results}"), "'from' contradicts 'settle'");
  has(said(with_fault(frames[0], 0.6), "settle: [rock, contact]", "settle: [contact]"), "is settled without");
  has(said(column(frames[3]) + without_fault, "type: poromechanics/fem", "type: poromechanics/fem\n    order: first"),
      "use 'order: second'");
}

}  // namespace
}  // namespace sprekk::testing
