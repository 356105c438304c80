// Regions that are taken away, against the closed form of a circular hole (Kirsch 1898).
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "framework/config/input_error.hpp"
#include "tests/verification/scene_run.hpp"

namespace sprekk::testing {
namespace {

constexpr double young = 10e9, poisson = 0.25, shear = young / (2 * (1 + poisson));
constexpr double one = -12e6, two = -5e6;  // Pa, principal stresses; `one` acts along the angle of the scene

/// A circle of the radius 1 m around (0, 0) as a polygon of the same area.
std::string circle(int corners) {
  const double turn = 2 * std::numbers::pi / corners, radius = std::sqrt(turn / std::sin(turn));
  std::string text;
  for (int i = 0; i < corners; ++i)
    text += fmt::format("{}[{} m, {} m]", i ? ", " : "", radius * std::cos(i * turn), radius * std::sin(i * turn));
  return text;
}

/// The state around a hole of the radius 1 m in rock without end, whose displacement is counted from the state before
/// the hole. `poisson`: undrained where the fluid stays.
struct Kirsch {
  double angle, nu = poisson;
  Point displacement(const Point& at) const {
    const Point x = turned(at, -angle);
    const double r = x.norm(), c = x.x() / r, s = x.y() / r, cos2 = c * c - s * s, sin2 = 2 * c * s;
    const double radial = (one + two + (one - two) * (4 * (1 - nu) - 1 / (r * r)) * cos2) / (4 * shear * r);
    const double along = -(one - two) * (2 * (1 - 2 * nu) + 1 / (r * r)) * sin2 / (4 * shear * r);
    return turned(Point(radial * c - along * s, radial * s + along * c), angle);
  }
  /// xx, yy, xy, Pa.
  SymmetricTensor stress(const Point& at) const {
    const Point x = turned(at, -angle);
    const double r = x.norm(), c = x.x() / r, s = x.y() / r, cos2 = c * c - s * s, sin2 = 2 * c * s, q = 1 / (r * r);
    const double mean = (one + two) / 2, half = (one - two) / 2;
    const double rr = mean * (1 - q) + half * (1 - 4 * q + 3 * q * q) * cos2;
    const double tt = mean * (1 + q) - half * (1 + 3 * q * q) * cos2;
    const double rt = -half * (1 + 2 * q - 3 * q * q) * sin2;
    Tensor turn = (Tensor() << c, -s, s, c).finished(), polar = (Tensor() << rr, rt, rt, tt).finished();
    const double a = std::cos(angle), b = std::sin(angle);
    turn = (Tensor() << a, -b, b, a).finished() * turn;
    const Tensor stress = turn * polar * turn.transpose();
    return {stress(0, 0), stress(1, 1), stress(0, 1)};
  }
  static Point turned(const Point& x, double by) {
    return {std::cos(by) * x.x() - std::sin(by) * x.y(), std::sin(by) * x.x() + std::cos(by) * x.y()};
  }
  /// The displacement as expressions of x and y.
  std::string text() const {
    const std::string x = fmt::format("({}*x+{}*y)", std::cos(angle), std::sin(angle));
    const std::string y = fmt::format("({}*y-{}*x)", std::cos(angle), std::sin(angle)), r2 = "(x*x+y*y)";
    const std::string cos2 = fmt::format("(({0}*{0}-{1}*{1})/{2})", x, y, r2),
                      sin2 = fmt::format("(2*{}*{}/{})", x, y, r2);
    const std::string radial =
        fmt::format("(({}+({})*({}-1/{})*{})/({}*{}))", one + two, one - two, 4 * (1 - nu), r2, cos2, 4 * shear, r2);
    const std::string along =
        fmt::format("((-({}))*({}+1/{})*{}/({}*{}))", one - two, 2 * (1 - 2 * nu), r2, sin2, 4 * shear, r2);
    const std::string ux = fmt::format("({0}*{1}-{2}*{3})", radial, x, along, y);
    const std::string uy = fmt::format("({0}*{3}+{2}*{1})", radial, x, along, y);
    return fmt::format("[({0}*{2}-{1}*{3}) m, ({1}*{2}+{0}*{3}) m]", std::cos(angle), std::sin(angle), ux, uy);
  }
};

struct Hole {
  std::string rock = "poromechanics/mpsa";
  int corners = 32;
  double degrees = 0;
  std::string support = "0", end = "1 s";
  std::string side = "";  ///< displacement on all sides; that of Kirsch if empty
  double nu = poisson;
  std::string couplers = "[]", flow = "", schedule = "solve: rock";
};

std::string scene(const Hole& hole) {
  const Kirsch kirsch{hole.degrees * std::numbers::pi / 180, hole.nu};
  const std::string held = "{displacement: " + (hole.side.empty() ? kirsch.text() : hole.side) + "}";
  return fmt::format(R"(
geometry:
  box: {{x: [-5 m, 5 m], y: [-5 m, 5 m]}}
  regions: {{tunnel: {{polygon: [{0}]}}}}
mesh: {{size: {1} m}}
components:
  rock:
    type: {2}
    young_modulus: 10 GPa
    poisson_ratio: 0.25
    initial_stress: {{along: {3} Pa, across: {4} Pa, angle: {5} deg}}
    boundary: {{left: {6}, right: {6}, bottom: {6}, top: {6}}}
    excavation: {{tunnel: {{support: {7}}}}}
{8}
couplers: {9}
schedule: [{{{10}}}]
time: {{end: {11}, step: 1 s}}
)",
                     circle(hole.corners), 2 * std::numbers::pi / hole.corners, hole.rock, one, two, hole.degrees, held,
                     hole.support, hole.flow, hole.couplers, hole.schedule, hole.end);
}

Vector stress_of(SceneRun& run) {
  for (const OutputField& field : run.model().output())
    if (field.name == "rock.stress") return field.values;
  throw std::logic_error("no stress");
}

struct Errors {
  double displacement, stress, hoop;
};

/// Relative L2 errors outside of the hole, and the mean error of the hoop stress in the cells at the hole over its
/// mean.
Errors errors(SceneRun& run, const Kirsch& kirsch) {
  const Mesh& mesh = run.mesh();
  const Vector stress = stress_of(run), &u = run.field("rock.displacement");
  double du = 0, nu = 0, ds = 0, ns = 0, dh = 0, nh = 0;
  const bool on_cells = u.size() == 2 * mesh.cell_count();
  for (int c = 0; c < mesh.cell_count(); ++c) {
    if (mesh.region_names[mesh.cell_region[c]] == "tunnel") continue;
    const Point x = mesh.cell_center[c];
    const double area = mesh.cell_measure[c];
    const SymmetricTensor exact = kirsch.stress(x), error = stress.segment<3>(3 * c) - exact;
    ds += area * error.squaredNorm();
    ns += area * exact.squaredNorm();
    if (on_cells) {
      du += area * (u.segment<2>(2 * c) - kirsch.displacement(x)).squaredNorm();
      nu += area * kirsch.displacement(x).squaredNorm();
    }
    bool is_at_hole = false;
    for (const int face : mesh.cell_faces[c])
      for (const int other : mesh.face_cells[face])
        is_at_hole = is_at_hole || (other != none && mesh.region_names[mesh.cell_region[other]] == "tunnel");
    if (!is_at_hole) continue;
    const Point t(-x.y() / x.norm(), x.x() / x.norm());
    const auto hoop = [&](const SymmetricTensor& s) {
      return s[0] * t.x() * t.x() + s[1] * t.y() * t.y() + 2 * s[2] * t.x() * t.y();
    };
    dh += std::abs(hoop(error));
    nh += std::abs(hoop(exact));
  }
  if (!on_cells)
    for (int n = 0; n < mesh.node_count(); ++n) {
      if (mesh.nodes[n].norm() < 0.99) continue;
      du += (u.segment<2>(2 * n) - kirsch.displacement(mesh.nodes[n])).squaredNorm();
      nu += kirsch.displacement(mesh.nodes[n]).squaredNorm();
    }
  return {std::sqrt(du / nu), std::sqrt(ds / ns), dh / nh};
}

/// Reference: Kirsch, with the hole as a polygon of as many corners as the mesh has cells around it, at principal
/// stresses of 12 and 5 MPa along three angles.
TEST(Excavation, HoleIsThatOfKirsch) {
  for (const bool is_fem : {false, true})
    for (const double degrees : is_fem ? std::vector{30.0} : std::vector{0.0, 30.0, 90.0}) {
      const std::string rock = is_fem ? "poromechanics/fem" : "poromechanics/mpsa";
      Errors coarser{};
      for (const int corners : {32, 64}) {
        SceneRun run = SceneRun::from_text(scene({.rock = rock, .corners = corners, .degrees = degrees}));
        run.run();
        const Errors now = errors(run, {degrees * std::numbers::pi / 180});
        std::printf("%s, %.0f deg, %d corners: displacement %.2e, stress %.2e, hoop stress at the hole %.2e\n",
                    rock.c_str(), degrees, corners, now.displacement, now.stress, now.hoop);
        EXPECT_LT(now.displacement, is_fem ? 8e-4 : 8e-3);
        EXPECT_LT(now.hoop, is_fem ? 4e-3 : 8e-2);
        if (corners == 64) {
          EXPECT_GT(std::log2(coarser.displacement / now.displacement), is_fem ? 2.7 : 1.8);
          EXPECT_GT(std::log2(coarser.stress / now.stress), is_fem ? 1.8 : 0.9);
        }
        coarser = now;
      }
    }
}

/// Reference: the equations are linear. A hole that is supported by a part of the stress moves by the rest, also when
/// the support falls in steps.
TEST(Excavation, DisplacementIsLinearInTheSupport) {
  for (const std::string rock : {"poromechanics/mpsa", "poromechanics/fem"}) {
    SceneRun run = SceneRun::from_text(
        scene({.rock = rock, .degrees = 30, .support = "'max(0, 1 - t/(4*s))'", .end = "6 s", .side = "[0 m, 0 m]"}));
    std::vector<Vector> states;
    run.run_until(6, [&] { states.push_back(run.field("rock.displacement")); });
    const Vector& whole = states.back();
    for (int step = 0; step < 6; ++step) {
      const double part = std::min(1.0, (step + 1) / 4.0);
      EXPECT_LT((states[step] - part * whole).lpNorm<Eigen::Infinity>(), 1e-9 * whole.lpNorm<Eigen::Infinity>())
          << step;
    }
  }
}

/// Before it is taken away a region is rock as any other: nothing moves.
TEST(Excavation, NothingMovesBefore) {
  for (const std::string rock : {"poromechanics/mpsa", "poromechanics/fem"}) {
    SceneRun run = SceneRun::from_text(
        scene({.rock = rock, .degrees = 30, .support = "{value: 1, to: 2 s}", .end = "3 s", .side = "[0 m, 0 m]"}));
    std::vector<double> largest;
    run.run_until(3, [&] { largest.push_back(run.field("rock.displacement").lpNorm<Eigen::Infinity>()); });
    EXPECT_LT(largest[0], 1e-15);
    EXPECT_LT(largest[1], 1e-15);
    EXPECT_GT(largest[2], 1e-4);
  }
}

/// Reference: without time to flow, the rock has its undrained Poisson's ratio, and the pore pressure changes by
///   −B (1 + nu_u)/3 (change of sigma_xx + sigma_yy), here B (1 + nu_u)/3 2 (one − two) cos(2 theta)/r^2.
TEST(Excavation, PressureOfTheUndrainedRock) {
  const double alpha = 0.8, storage = 2e-11, bulk = young / (3 * (1 - 2 * poisson));
  const double undrained = bulk + alpha * alpha / storage, skempton = alpha / (storage * undrained);
  const double nu = (3 * undrained - 2 * shear) / (2 * (3 * undrained + shear));
  double coarser = 0;
  for (const int corners : {32, 64}) {
    SceneRun run = SceneRun::from_text(
        scene({.corners = corners,
               .degrees = 30,
               .nu = nu,
               .couplers = "[{type: biot, between: [pore, rock], biot_coefficient: 0.8}]",
               .flow = "  pore: {type: matrix_flow/mpfa, permeability: 1e-25 m^2, viscosity: 1 mPa*s, storage: 2e-11 "
                       "1/Pa, initial_pressure: 4 MPa}",
               .schedule = "solve: [pore, rock]"}));
    run.run();
    const Mesh& mesh = run.mesh();
    double error = 0, norm = 0;
    for (int c = 0; c < mesh.cell_count(); ++c) {
      if (mesh.region_names[mesh.cell_region[c]] == "tunnel") continue;
      const Point x = mesh.cell_center[c], y = Kirsch::turned(x, -std::numbers::pi / 6);
      const double cos2 = (y.x() * y.x() - y.y() * y.y()) / y.squaredNorm();
      const double exact = skempton * (1 + nu) / 3 * 2 * (one - two) * cos2 / x.squaredNorm();
      error += mesh.cell_measure[c] * std::pow(run.field("pore.pressure")[c] - 4e6 - exact, 2);
      norm += mesh.cell_measure[c] * exact * exact;
    }
    const double now = std::sqrt(error / norm);
    std::printf("%d corners: error of the undrained pressure %.2e, order %.2f; displacement %.2e\n", corners, now,
                std::log2(coarser / now), errors(run, {std::numbers::pi / 6, nu}).displacement);
    EXPECT_LT(now, 0.1 * 32 / corners);
    coarser = now;
  }
}

/// Reference: a column in equilibrium with its weight of which the upper fifth is dug off rises by rho g h (y +
/// H)/(lambda
/// + 2 G), and a support by a half of the stress lets it rise by a half.
TEST(Excavation, PitUnloadsWhatIsBelow) {
  const double modulus = young * (1 - poisson) / ((1 + poisson) * (1 - 2 * poisson));
  for (const std::string rock : {"mpsa", "fem"})
    for (const double support : {0.0, 0.5}) {
      SceneRun run = SceneRun::from_text(fmt::format(R"(
geometry:
  box: {{x: [0 m, 10 m], y: [-100 m, 0 m]}}
  regions: {{pit: {{polygon: [[0 m, -20 m], [10 m, -20 m], [10 m, 0 m], [0 m, 0 m]]}}}}
mesh: {{kind: structured, shape: quadrilaterals, cells: [2, 20]}}
components:
  rock:
    type: poromechanics/{}
    young_modulus: 10 GPa
    poisson_ratio: 0.25
    rock_density: 2000 kg/m^3
    gravity: [0, -10 m/s^2]
    boundary: {{left: {{displacement_x: 0 m}}, right: {{displacement_x: 0 m}}, bottom: {{displacement_y: 0 m}}}}
    excavation: {{pit: {{support: [{{value: 1, to: 1 s}}, {{value: {}, from: 1 s}}]}}}}
start: {{settle: rock}}
schedule: [{{solve: rock}}]
time: {{end: 2 s, step: 1 s}}
)",
                                                     rock, support));
      EXPECT_TRUE(run.step());
      EXPECT_LT(run.field("rock.displacement").lpNorm<Eigen::Infinity>(), 1e-14);  // its weight shortens it by 8 mm
      EXPECT_TRUE(run.step());
      const Vector& u = run.field("rock.displacement");
      const bool on_cells = u.size() == 2 * run.mesh().cell_count();
      const double load = (1 - support) * 2000 * 10 * 20, top = load * 80 / modulus;
      for (int i = 0; i < u.size() / 2; ++i) {
        const double y = (on_cells ? run.mesh().cell_center[i] : run.mesh().nodes[i]).y();
        if (y > -19.9) continue;
        EXPECT_NEAR(u[2 * i + 1], load * (y + 100) / modulus, 1e-9 * top) << rock << y;
        EXPECT_NEAR(u[2 * i], 0, 1e-9 * top);
      }
    }
}

/// Reference: a hole in rock of a uniform stress S and pressure p_0 that drains it, in the steady state. With the
/// pressure p = p_0 ln(r/a)/ln(R/a) and no total stress on the outline,
///   u_r = S a^2/(2 G r) + alpha/((lambda + 2 G) r) times the integral of (p − p_0) r from a to r,
/// and 2 pi (k/mu) p_0/ln(R/a) flows into the hole: a region that conducts well, in which a well holds the pressure
/// zero.
TEST(Excavation, HoleThatDrainsTheRock) {
  const double alpha = 0.8, pressure = 2e6, stress = -5e6, log = std::log(20.0), mobility = 1e-12;
  const double lambda = 2 * shear * poisson / (1 - 2 * poisson), per_p = alpha / (lambda + 2 * shear);
  const auto radial = [&](double r) {  // u_r/r
    const double drained = (r * r / 2 * std::log(r) - (r * r - 1) / 4) / log - (r * r - 1) / 2;
    return (stress / (2 * shear) + per_p * pressure * drained) / (r * r);
  };
  const std::string r2 = "(x*x+y*y)";
  const std::string of_r = fmt::format("(({}+{}*(({}/4*log({})-({}-1)/4)/{}-({}-1)/2))/{})", stress / (2 * shear),
                                       per_p * pressure, r2, r2, r2, log, r2, r2);
  const std::string held = fmt::format("{{displacement: [(x*{0}) m, (y*{0}) m]}}", of_r);
  const std::string given = fmt::format("{{pressure: ({}*log({})/{}) Pa}}", pressure / 2, r2, log);
  double coarser_u = 0, coarser_p = 0;
  for (const int corners : {32, 64}) {
    SceneRun run = SceneRun::from_text(fmt::format(R"(
geometry:
  box: {{x: [-4 m, 4 m], y: [-4 m, 4 m]}}
  regions: {{tunnel: {{polygon: [{0}]}}}}
mesh: {{size: {1} m}}
components:
  pore:
    type: matrix_flow/mpfa
    permeability: {{regions: {{tunnel: 1e-8 m^2, default: 1e-15 m^2}}}}
    viscosity: 1 mPa*s
    storage: 1e-11 1/Pa
    initial_pressure: 2 MPa
    boundary: {{left: {2}, right: {2}, bottom: {2}, top: {2}}}
  rock:
    type: poromechanics/mpsa
    young_modulus: 10 GPa
    poisson_ratio: 0.25
    initial_stress: -5 MPa
    boundary: {{left: {3}, right: {3}, bottom: {3}, top: {3}}}
    excavation: {{tunnel: {{support: 0}}}}
  wells: {{type: wells/limited, wells: {{drain: {{at: [0 m, 0 m], pressure: 0 Pa, index: 1 m^2/(Pa*s)}}}}}}
couplers:
  - {{type: biot, between: [pore, rock], biot_coefficient: 0.8}}
  - {{type: well_exchange, between: [wells, pore]}}
schedule: [{{solve: [pore, rock, wells]}}]
time: {{end: 1e10 s, step: 1e9 s}}
)",
                                                   circle(corners), 2 * std::numbers::pi / corners, given, held));
    run.run();
    const Mesh& mesh = run.mesh();
    double du = 0, nu = 0, dp = 0, np = 0;
    for (int c = 0; c < mesh.cell_count(); ++c) {
      if (mesh.region_names[mesh.cell_region[c]] == "tunnel") continue;
      const Point x = mesh.cell_center[c], exact = radial(x.norm()) * x;
      const double area = mesh.cell_measure[c];
      du += area * (run.field("rock.displacement").segment<2>(2 * c) - exact).squaredNorm();
      nu += area * exact.squaredNorm();
      dp += area * std::pow(run.field("pore.pressure")[c] - pressure * std::log(x.norm()) / log, 2);
      np += area * pressure * pressure;
    }
    const double u = std::sqrt(du / nu), p = std::sqrt(dp / np);
    const double inflow = -run.quantity("wells.drain.rate") / (2 * std::numbers::pi * mobility * pressure / log) - 1;
    std::printf("%d corners: displacement %.2e, order %.2f; pressure %.2e, order %.2f; inflow off by %.1e\n", corners,
                u, std::log2(coarser_u / u), p, std::log2(coarser_p / p), inflow);
    EXPECT_LT(u, 4e-3 * 32 / corners);
    EXPECT_LT(p, 5e-4 * 32 / corners);
    EXPECT_LT(std::abs(inflow), 3e-3 * 32 / corners);
    coarser_u = u;
    coarser_p = p;
  }
}

/// What a scene may not ask for, and the words of the answer.
TEST(Excavation, MistakesAreRefused) {
  const auto said = [](const std::string& from, const std::string& to) -> std::string {
    std::string text = scene({});
    const auto place = text.find(from);
    EXPECT_NE(place, std::string::npos) << from;
    text.replace(place, from.size(), to);
    try {
      SceneRun run = SceneRun::from_text(text);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  const auto has = [&](const std::string& text, const std::string& words) {
    EXPECT_NE(text.find(words), std::string::npos) << text;
  };
  const std::string good = "excavation: {tunnel: {support: 0}}";
  has(said(good, "excavation: {tunel: {support: 0}}"), "did you mean 'tunnel'");
  has(said(good, "excavation: {tunnel: {support: 1.5}}"), "support");
  has(said(good, "excavation: {tunnel: {}}"), "support");
  has(said(good, "excavation: {tunnel: {support: 0.1*x}}"), "varies in space");
}

}  // namespace
}  // namespace sprekk::testing
