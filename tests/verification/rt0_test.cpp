// matrix_flow/rt0 in scenes: orders, closed forms through the couplers, conservation, a turned twin, growth.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "components/matrix_flow/matrix_flow.hpp"
#include "framework/mesh/build_mesh.hpp"
#include "tests/verification/mandel_solution.hpp"
#include "tests/verification/mesh_file.hpp"
#include "tests/verification/scene_run.hpp"

namespace sprekk::testing {
namespace {

using std::numbers::pi;
const Override rt0 = {"components.pore.type", "matrix_flow/rt0"};

Vector areas(const Mesh& mesh) { return Eigen::Map<const Vector>(mesh.cell_measure.data(), mesh.cell_count()); }

const Vector& fluxes_of(SceneRun& run) {
  for (Part* part : run.model().parts())
    if (const auto* flow = dynamic_cast<const matrix_flow::MatrixFlow*>(part)) return flow->face_fluxes();
  throw std::logic_error("no flow in the matrix");
}

/// Relative, of the pressures at the centres of cells, and of the fluxes through faces per length (L2 over the cells).
struct Errors {
  double pressure, flux;
};

/// Steady flow with the pressure cos(pi x) cosh(pi y), whose conjugate function is −sin(pi x) sinh(pi y).
Errors steady_errors(const std::string& mesh_text) {
  std::string scene = R"(
geometry: {box: {x: [0 m, 1 m], y: [0 m, 1 m]}}
mesh: MESH
components:
  pore:
    type: matrix_flow/rt0
    permeability: 1 m^2
    viscosity: 1 Pa*s
    storage: 0 1/Pa
    boundary: {left: {pressure: EXACT}, right: {pressure: EXACT}, bottom: {flux: 0 m/s}, top: {pressure: EXACT}}
schedule: [{solve: pore}]
time: {end: 1 s, step: 1 s}
)";
  const auto replace = [&](const std::string& word, const std::string& by) {
    for (auto at = scene.find(word); at != std::string::npos; at = scene.find(word)) scene.replace(at, word.size(), by);
  };
  replace("MESH", mesh_text);
  replace("EXACT", "(cos(pi*x)*cosh(pi*y)) Pa");
  SceneRun run = SceneRun::from_text(scene);
  run.run();
  const Mesh& mesh = run.mesh();
  Vector exact(mesh.cell_count());
  for (int c = 0; c < mesh.cell_count(); ++c)
    exact[c] = std::cos(pi * mesh.cell_center[c][0]) * std::cosh(pi * mesh.cell_center[c][1]);
  const auto conjugate = [&](int node) {
    return -std::sin(pi * mesh.nodes[node][0]) * std::sinh(pi * mesh.nodes[node][1]);
  };
  Vector flux(mesh.face_count()), weights = Vector::Zero(mesh.face_count());
  for (int f = 0; f < mesh.face_count(); ++f) {
    flux[f] = (conjugate(mesh.face_nodes[f][0]) - conjugate(mesh.face_nodes[f][1])) / mesh.face_measure[f];
    for (const int cell : mesh.face_cells[f])
      if (cell != none) weights[f] += mesh.cell_measure[cell];
  }
  const Vector lengths = Eigen::Map<const Vector>(mesh.face_measure.data(), mesh.face_count());
  return {relative_error(areas(mesh), run.field("pore.pressure"), exact),
          relative_error(weights, fluxes_of(run).cwiseQuotient(lengths), flux)};
}

void expect_orders(const std::string& coarse_mesh, const std::string& fine_mesh, double pressure, double flux) {
  const Errors coarse = steady_errors(coarse_mesh), fine = steady_errors(fine_mesh);
  EXPECT_GT(std::log2(coarse.pressure / fine.pressure), pressure) << coarse.pressure << " " << fine.pressure;
  EXPECT_GT(std::log2(coarse.flux / fine.flux), flux) << coarse.flux << " " << fine.flux;
  EXPECT_LT(fine.pressure, 1.5e-3);
}

TEST(Rt0, PressureIsOfSecondOrderAndFluxOfFirst) {
  expect_orders("{size: 0.05 m}", "{size: 0.025 m}", 1.8, 0.95);
  expect_orders("{kind: structured, cells: [20, 20]}", "{kind: structured, cells: [40, 40]}", 1.9, 0.95);
  expect_orders("{kind: structured, shape: quadrilaterals, cells: [20, 20]}",
                "{kind: structured, shape: quadrilaterals, cells: [40, 40]}", 1.9, 0.95);
  expect_orders("{size: 0.05 m, shape: quadrilaterals}", "{size: 0.025 m, shape: quadrilaterals}", 1.8, 0.95);
}

double mandel_error(const std::string& mesh) {
  SceneRun run("verification/mandel.yaml", {{"mesh", mesh}, rt0});
  run.run();
  EXPECT_NEAR(run.quantity("fluid_balance_error"), 0, 1e-12 * run.quantity("fluid_outflow"));
  const Mandel exact;
  Vector p(run.mesh().cell_count());
  for (int c = 0; c < p.size(); ++c) p[c] = exact.pressure(run.mesh().cell_center[c][0], run.time(), run.steps());
  return relative_error(areas(run.mesh()), run.field("pore.pressure"), p);
}

TEST(Rt0, MandelIsOfSecondOrder) {
  const double coarse = mandel_error("{size: 0.1 m}"), fine = mandel_error("{size: 0.05 m}");
  EXPECT_LT(fine, 2e-3);
  EXPECT_GT(std::log2(coarse / fine), 1.8) << coarse << " " << fine;
}

double terzaghi_error(int cells) {
  SceneRun run("verification/terzaghi.yaml",
               {{"mesh.cells", "[" + std::to_string(cells / 10) + ", " + std::to_string(cells) + "]"}, rt0});
  run.run();
  Vector exact(run.mesh().cell_count());
  for (int c = 0; c < exact.size(); ++c) {
    double sum = 0;
    for (int k = 0; k < 2000; ++k) {
      const double n = (k + 0.5) * pi;
      sum += 2 / n * std::sin(n * run.mesh().cell_center[c][1]) * std::pow(1 + 0.01 * n * n, -run.steps());
    }
    exact[c] = sum;
  }
  return relative_error(areas(run.mesh()), run.field("pore.pressure"), exact);
}

TEST(Rt0, TerzaghiIsOfSecondOrder) {
  const double coarse = terzaghi_error(20), fine = terzaghi_error(40);
  EXPECT_LT(fine, 1.5e-3);
  EXPECT_GT(std::log2(coarse / fine), 1.8) << coarse << " " << fine;
}

TEST(Rt0, BarryMercerConvergesToTheTable) {
  const auto rows = read_numbers(std::string(SPREKK_SOURCE_DIR) + "/tests/verification/references/barry_mercer.csv");
  std::vector<double> errors(2, -1);  // extrapolated in time
  for (const int steps : {50, 100}) {
    SceneRun run(
        "verification/barry_mercer.yaml",
        {{"mesh.cells", "[32, 32]"}, {"time.step", std::to_string(1.535889741755005e6 / steps) + "e-3 s"}, rt0});
    run.run();
    for (int i = 0; i < 2; ++i)
      errors[i] += (steps == 100 ? 2 : -1) * run.quantity(i == 0 ? "p_5_5" : "p_75_5") / rows[i][3];
  }
  for (const double error : errors) EXPECT_LT(std::abs(error), 4e-3);
}

/// The lowest pressure after one short step of a front that enters from the left.
double lowest_pressure(const std::string& flux_mass) {
  SceneRun run = SceneRun::from_text(R"(
geometry: {box: {x: [0 m, 1 m], y: [0 m, 1 m]}}
mesh: {kind: structured, shape: quadrilaterals, cells: [10, 8]}
components:
  pore: {type: matrix_flow/rt0, permeability: 1 m^2, viscosity: 1 Pa*s, storage: 1 1/Pa, boundary: {left: {pressure: 1 Pa}}, flux_mass: )" +
                                     flux_mass + R"(}
schedule: [{solve: pore}]
time: {end: 1e-5 s, step: 1e-5 s}
)");
  run.run();
  return run.field("pore.pressure").minCoeff();
}

TEST(Rt0, LumpedFluxesKeepTheBoundsOnRectangles) {
  EXPECT_LT(lowest_pressure("exact"), -1e-4);
  EXPECT_GT(lowest_pressure("lumped"), -1e-15);
}

/// The integral of the squared pressure, and the largest flux, after three steps of a well in anisotropic rock. The
/// pressures of its outer sides hold it.
std::array<double, 2> around_a_well(const std::string& flux_mass, double degrees, const std::string& mesh) {
  const Tensor turn = turned_by(degrees);
  const Point well = turn * Point(0.31, 0.42);
  SceneRun run = SceneRun::from_text(fmt::format(
      "{{geometry: {{file: {}}}, components: {{pore: {{type: matrix_flow/rt0, permeability: {{along: 3 m^2, across: 1 "
      "m^2, angle: {} deg}}, viscosity: 1 Pa*s, storage: 1 1/Pa, boundary: {{left: {{pressure: 1 Pa}}, top: "
      "{{pressure: 0 Pa}}}}, wells: {{feed: {{at: [{:.17g} m, {:.17g} m], rate: 1 m^2/s}}}}, flux_mass: {}}}}}, "
      "schedule: [{{solve: pore}}], time: {{end: 0.03 s, step: 0.01 s}}}}",
      mesh, 20 + degrees, well.x(), well.y(), flux_mass));
  run.run();
  double sum = 0;
  for (int c = 0; c < run.mesh().cell_count(); ++c)
    sum += run.mesh().cell_measure[c] * std::pow(run.field("pore.pressure")[c], 2);
  return {sum, fluxes_of(run).lpNorm<Eigen::Infinity>()};
}

TEST(Rt0, TurnsWithItsBox) {
  SceneRun box = SceneRun::from_text(
      "{geometry: {box: {x: [0 m, 1 m], y: [0 m, 1 m]}}, mesh: {size: 0.15 m}, components: {pore: {type: "
      "matrix_flow/rt0, permeability: 1 m^2, viscosity: 1 Pa*s, storage: 1 1/Pa}}, schedule: [{solve: pore}], time: "
      "{end: 1 s, step: 1 s}}");
  const RawMesh mesh = to_raw_mesh(box.mesh());
  for (const std::string flux_mass : {"exact", "lumped"}) {
    const auto drawn =
        around_a_well(flux_mass, 0, write_msh(mesh, Tensor::Identity(), Point::Zero(), "rt0_" + flux_mass));
    for (const double degrees : {30.0, 77.0}) {
      const auto turned =
          around_a_well(flux_mass, degrees, write_msh(mesh, turned_by(degrees), Point::Zero(), "rt0_" + flux_mass));
      for (int i = 0; i < 2; ++i) EXPECT_NEAR(turned[i] / drawn[i], 1, 1e-9) << flux_mass << " " << degrees;
    }
  }
}

/// A flat cell conducts a million times more than it lets through, and what cancels leaves round-off: it must not keep
/// steps from their end. The state that is reached is the linear pressure on the sides.
TEST(Rt0, StepsEndWithAFlatCell) {
  RawMesh mesh;
  mesh.nodes = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0.45, 1e-6}};
  mesh.cells = {Ring(0, 1, 4), Ring(1, 2, 4), Ring(2, 3, 4), Ring(3, 0, 4)};
  mesh.regions = {0, 0, 0, 0};
  mesh.region_names = {"rock"};
  mesh.side_names = {"bottom", "right", "top", "left"};
  for (int k = 0; k < 4; ++k) mesh.boundary_faces.push_back({{k, (k + 1) % 4}, k});
  for (const double degrees : {0.0, 33.0}) {
    const Tensor turn = turned_by(degrees);
    const std::string on_side =
        fmt::format("{{pressure: \"(1e5*(1 + {:.17g}*x + {:.17g}*y)) Pa\"}}", turn(0, 0), turn(1, 0));
    SceneRun run = SceneRun::from_text(fmt::format(
        "{{geometry: {{file: {}}}, components: {{pore: {{type: matrix_flow/rt0, permeability: 1 m^2, viscosity: 1 "
        "Pa*s, storage: 1 1/Pa, initial_pressure: 1e5 Pa, boundary: {{left: {}, right: {}, bottom: {}, top: {}}}}}}}, "
        "schedule: [{{solve: pore}}], time: {{end: 40 s, step: 1 s}}}}",
        write_msh(mesh, turn, Point::Zero(), "rt0_flat"), on_side, on_side, on_side, on_side));
    for (int step = 0; step < 40; ++step) {
      ASSERT_TRUE(run.step());
      EXPECT_LE(run.iterations(), 2);
    }
    for (int c = 0; c < 4; ++c)
      EXPECT_NEAR(run.field("pore.pressure")[c], 1e5 * (1 + turn.col(0).dot(run.mesh().cell_center[c])), 1);
  }
}

TEST(Rt0, WingsGrowAndNoFluidIsLost) {
  SceneRun run("paper/wing_cracks.yaml", {{"mesh", "{size: 0.3 m, fracture_size: 25 mm}"},
                                          {"components.tips.size", "0.3 m"},
                                          {"components.tips.sectors", "8"},
                                          {"components.tips.mesh_ratio", "1"},
                                          rt0});
  run.run_until(7200,
                [&] { EXPECT_NEAR(run.quantity("fluid_balance_error"), 0, 1e-9 * run.quantity("fluid_injected")); });
  EXPECT_GE(run.mesh_changes(), 1);
  EXPECT_EQ(run.field("pore.face_pressure").size(), run.mesh().face_count());
  // Pressures of faces lie between those of the cells beside them, or nearly so: they follow from them.
  const double range = run.field("pore.pressure").maxCoeff() - run.field("pore.pressure").minCoeff();
  for (int f = 0; f < run.mesh().face_count(); ++f) {
    const auto [cell, other] = run.mesh().face_cells[f];
    if (other == none) continue;
    const double one = run.field("pore.pressure")[cell], two = run.field("pore.pressure")[other];
    EXPECT_NEAR(run.field("pore.face_pressure")[f], (one + two) / 2, std::abs(one - two) + 0.1 * range);
  }
}

}  // namespace
}  // namespace sprekk::testing
