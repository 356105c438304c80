// Poroelastic problems with closed-form answers, run as scenes.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "framework/config/yaml/load_scene.hpp"
#include "tests/verification/mandel_solution.hpp"
#include "tests/verification/scene_run.hpp"

namespace sprekk::testing {
namespace {

Vector areas(const Mesh& mesh) { return Eigen::Map<const Vector>(mesh.cell_measure.data(), mesh.cell_count()); }

const std::string references = std::string(SPREKK_SOURCE_DIR) + "/tests/verification/references/";

/// p/p0 after m backward-Euler steps (verification.yaml: H = 1, c = 1, p0 = 1, drained at y = 0).
double terzaghi(double y, double dt, int steps) {
  double sum = 0;
  for (int k = 0; k < 20000; ++k) {
    const double n = (k + 0.5) * M_PI;
    sum += 2 / n * std::sin(n * y) * std::pow(1 + dt * n * n, -steps);
  }
  return sum;
}

double terzaghi_error(int cells) {
  SceneRun run("verification/terzaghi.yaml",
               {{"mesh.cells", "[" + std::to_string(cells / 10) + ", " + std::to_string(cells) + "]"}});
  run.run();
  Vector exact(run.mesh().cell_count());
  for (int c = 0; c < exact.size(); ++c) exact[c] = terzaghi(run.mesh().cell_center[c][1], 0.01, run.steps());
  return relative_error(areas(run.mesh()), run.field("pore.pressure"), exact);
}

TEST(Terzaghi, SeriesAgreesWithTable) {
  for (const auto& row : read_numbers(references + "terzaghi_backward_euler_exact.csv")) {
    if (row[0] < 1e-3) continue;  // where the series needs more terms than a test should sum
    EXPECT_NEAR(terzaghi(row[1], row[0], 10), row[3], 1e-6) << row[0] << " " << row[1];
  }
}

TEST(Terzaghi, IsSecondOrder) {
  const double coarse = terzaghi_error(20), fine = terzaghi_error(40);
  EXPECT_LT(fine, 1e-3);
  EXPECT_GT(std::log2(coarse / fine), 1.9) << coarse << " " << fine;
}

/// With layers of 1/40 m and c = 1.
Override one_step(double ratio) {
  const std::string dt = std::to_string(ratio / 1600 * 1e9) + "e-9 s";
  return {"time", "{end: " + dt + ", step: " + dt + "}"};
}

TEST(Terzaghi, RectanglesHaveNoOvershoot) {
  for (const double ratio : {1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 1e-1, 1.0})
    for (const char* cells : {"[1, 40]", "[4, 40]", "[16, 40]"}) {
      SceneRun run("verification/terzaghi.yaml",
                   {{"mesh.shape", "quadrilaterals"}, {"mesh.cells", cells}, one_step(ratio)});
      run.run();
      EXPECT_LT(run.field("pore.pressure").maxCoeff() - 1, 1e-10) << "c dt/h^2 = " << ratio << ", " << cells;
      EXPECT_GT(run.field("pore.pressure").minCoeff(), 0) << "c dt/h^2 = " << ratio << ", " << cells;
    }
}

TEST(Terzaghi, OvershootOnTrianglesStaysBelowTheKnownLimit) {
  // The aim is max p/p0 - 1 < 1e-10, which rectangles reach and triangles miss: cells of one layer drain at different
  // rates, and the rock's response to that raises the next layer by at most 0.40 % of what the drained cells lose
  // (docs/numerics). The bound is that mechanism's: half a percent of the largest loss of pressure.
  for (const double ratio : {1e-6, 1e-4, 1e-2, 0.1, 1.0}) {
    for (const char* kind : {"structured", "unstructured"}) {
      SceneRun run("verification/terzaghi.yaml", {{"mesh.cells", ""},
                                                  {"mesh.kind", kind},
                                                  {"mesh.shape", "triangles"},
                                                  {"mesh.size", "0.025 m"},
                                                  one_step(ratio)});
      run.run();
      const double loss = 1 - run.field("pore.pressure").minCoeff();
      EXPECT_LT(run.field("pore.pressure").maxCoeff() - 1, 5e-3 * loss + 1e-11)
          << "c dt/h^2 = " << ratio << ", " << kind;
      EXPECT_GT(run.field("pore.pressure").minCoeff(), -1e-10) << "c dt/h^2 = " << ratio << ", " << kind;
    }
  }
}

struct MandelErrors {
  double pressure, displacement;
};

MandelErrors mandel_errors(const std::string& mesh, const std::vector<Override>& more = {}) {
  std::vector<Override> overrides = {{"mesh", mesh}};
  overrides.insert(overrides.end(), more.begin(), more.end());
  SceneRun run("verification/mandel.yaml", overrides);
  run.run();
  const Mandel exact;
  const int cells = run.mesh().cell_count();
  Vector p(cells), u(2 * cells), weights(2 * cells);
  for (int c = 0; c < cells; ++c) {
    p[c] = exact.pressure(run.mesh().cell_center[c][0], run.time(), run.steps());
    u.segment<2>(2 * c) = exact.displacement(run.mesh().cell_center[c], run.time(), run.steps());
    weights.segment<2>(2 * c).setConstant(run.mesh().cell_measure[c]);
  }
  return {relative_error(areas(run.mesh()), run.field("pore.pressure"), p),
          relative_error(weights, run.field("rock.displacement"), u)};
}

TEST(Mandel, ClosedFormAgreesWithTable) {
  const Mandel exact;
  for (const auto& row : read_numbers(references + "mandel_seedrock.csv")) {
    EXPECT_NEAR(exact.pressure(0, row[1]) / row[2], 1, 1e-6);
    EXPECT_NEAR(exact.pressure(0.5, row[1]) / row[4], 1, 1e-6);
    EXPECT_NEAR(exact.displacement({1, 0}, row[1])[0] / row[7], 1, 1e-6);
    EXPECT_NEAR(exact.displacement({0, 1}, row[1])[1] / row[8], 1, 1e-6);
  }
}

TEST(Mandel, PlateOfTheSceneFollowsTheClosedForm) {
  const Mandel exact;
  const std::string file = std::string(SPREKK_SOURCE_DIR) + "/configs/verification/mandel_plate.csv";
  std::ifstream stream(file);
  std::string line;
  std::getline(stream, line);
  for (int m = 0; std::getline(stream, line); ++m) {
    if (m == 0) continue;
    const double time = std::stod(line), value = std::stod(line.substr(line.find(',') + 1));
    EXPECT_NEAR(value / exact.displacement({0, 1}, time, m)[1], 1, 1e-12);
  }
}

TEST(Mandel, IsSecondOrder) {
  const MandelErrors coarse = mandel_errors("{size: 0.1 m}"), fine = mandel_errors("{size: 0.05 m}");
  EXPECT_LT(fine.pressure, 2e-3);
  EXPECT_LT(fine.displacement, 7.1e-4);  // what PorePy leaves at a comparable resolution
  EXPECT_GT(std::log2(coarse.pressure / fine.pressure), 1.8) << coarse.pressure << " " << fine.pressure;
  EXPECT_GT(std::log2(coarse.displacement / fine.displacement), 1.8) << coarse.displacement << " " << fine.displacement;
}

TEST(Mandel, IsSecondOrderOnQuadrilaterals) {
  const MandelErrors coarse = mandel_errors("{kind: structured, shape: quadrilaterals, cells: [15, 15]}"),
                     fine = mandel_errors("{kind: structured, shape: quadrilaterals, cells: [30, 30]}");
  EXPECT_LT(fine.pressure, 2e-3);
  EXPECT_LT(fine.displacement, 7.1e-4);
  EXPECT_GT(std::log2(coarse.pressure / fine.pressure), 1.9) << coarse.pressure << " " << fine.pressure;
  EXPECT_GT(std::log2(coarse.displacement / fine.displacement), 1.9) << coarse.displacement << " " << fine.displacement;
  const MandelErrors rough = mandel_errors("{size: 0.1 m, shape: quadrilaterals}"),
                     smooth = mandel_errors("{size: 0.05 m, shape: quadrilaterals}");
  EXPECT_LT(smooth.pressure, 2e-3);
  EXPECT_LT(smooth.displacement, 7.1e-4);
  EXPECT_GT(std::log2(rough.pressure / smooth.pressure), 1.8) << rough.pressure << " " << smooth.pressure;
  EXPECT_GT(std::log2(rough.displacement / smooth.displacement), 1.8)
      << rough.displacement << " " << smooth.displacement;
}

/// Relative errors of p and u_x at two points at the end of the scene, extrapolated to dt = 0 from two step sizes.
std::vector<double> barry_mercer_errors(int cells) {
  const auto rows = read_numbers(references + "barry_mercer.csv");
  const std::vector<std::string> names = {"p_5_5", "p_75_5", "u_5_5.x", "u_75_5.x"};
  const std::vector<double> exact = {rows[0][3], rows[1][3], rows[0][4], rows[1][4]};
  const std::string mesh = "[" + std::to_string(cells) + ", " + std::to_string(cells) + "]";
  const double quarter = 1535.889741755005;
  std::vector<double> errors(4, -1);
  for (const int steps : {50, 100}) {
    SceneRun run("verification/barry_mercer.yaml",
                 {{"mesh.cells", mesh}, {"time.step", std::to_string(quarter / steps * 1e3) + "e-3 s"}});
    run.run();
    for (int i = 0; i < 4; ++i) errors[i] += (steps == 100 ? 2 : -1) * run.quantity(names[i]) / exact[i];
  }
  return errors;
}

TEST(BarryMercer, ConvergesToTable) {
  const std::vector<double> coarse = barry_mercer_errors(16), fine = barry_mercer_errors(32);
  for (int i = 0; i < 2; ++i) EXPECT_LT(std::abs(fine[i]), 2e-3) << i;  // pressures
  for (int i = 2; i < 4; ++i) {                                         // displacements
    EXPECT_LT(std::abs(fine[i]), 1.5e-2) << i;
    EXPECT_GT(std::log2(coarse[i] / fine[i]), 1.8) << i << ": " << coarse[i] << " " << fine[i];
  }
}

}  // namespace
}  // namespace sprekk::testing
