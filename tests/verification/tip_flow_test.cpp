// Flow from a fracture into the rock, and around one, with singular fluxes at the tips.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <string>

#include "tests/verification/scene_run.hpp"

namespace sprekk::testing {
namespace {

const char* const coarse = "{size: 0.2 m, fracture_size: 40 mm, growth: 0.2}";
const char* const medium = "{size: 0.1 m, fracture_size: 20 mm, growth: 0.1}";
const char* const fine = "{size: 0.05 m, fracture_size: 10 mm, growth: 0.05}";

/// Of the pressure in the fracture, 2 Pa, over that of the surroundings.
double inflow_error(const std::string& mesh, const std::string& type = "matrix_flow/mpfa") {
  SceneRun run("verification/fracture_inflow.yaml", {{"mesh", mesh}, {"components.pore.type", type}});
  run.run();
  return run.quantity("p_fracture") - 2;
}

TEST(FractureInflow, PressureInTheFractureIsThatOfTheClosedForm) {
  // Second order. With linear pressures alone the error is that of a fracture which is shorter by a part of a cell:
  // 0.129, 0.059 and 0.029 Pa.
  EXPECT_NEAR(inflow_error(coarse), 0, 0.008);
  EXPECT_NEAR(inflow_error(medium), 0, 0.002);
  EXPECT_NEAR(inflow_error(fine), 0, 0.0005);
}

/// Relative, L2 over the cells within 0.3 m.
double barrier_error(const std::string& mesh_text, const std::string& type = "matrix_flow/mpfa") {
  SceneRun run("verification/fracture_barrier.yaml", {{"mesh", mesh_text}, {"components.pore.type", type}});
  run.run();
  const Mesh& mesh = run.mesh();
  double square = 0, exact_square = 0;
  for (int c = 0; c < mesh.cell_count(); ++c) {
    const std::complex<double> z(mesh.cell_center[c][0], mesh.cell_center[c][1]);
    if (std::abs(z) > 0.3) continue;
    const double size = std::abs(std::sqrt(z * z - 0.01).imag()), exact = z.imag() < 0 ? -size : size;
    square += mesh.cell_measure[c] * std::pow(run.field("pore.pressure")[c] - exact, 2);
    exact_square += mesh.cell_measure[c] * exact * exact;
  }
  return std::sqrt(square / exact_square);
}

TEST(FractureBarrier, PressureAroundASealedFractureIsThatOfTheClosedForm) {
  // Second order. With linear pressures alone: 0.029, 0.014 and 0.007.
  EXPECT_LT(barrier_error(coarse), 0.006);
  EXPECT_LT(barrier_error(medium), 0.0015);
  EXPECT_LT(barrier_error(fine), 0.0004);
}

TEST(FractureInflow, OfMixedElementsIsThatOfTheClosedForm) {
  // With linear pressures alone: 0.143, 0.068 and 0.032 Pa.
  EXPECT_NEAR(inflow_error(coarse, "matrix_flow/rt0"), 0, 0.008);
  EXPECT_NEAR(inflow_error(medium, "matrix_flow/rt0"), 0, 0.004);
  EXPECT_NEAR(inflow_error(fine, "matrix_flow/rt0"), 0, 0.0015);
}

TEST(FractureBarrier, OfMixedElementsIsThatOfTheClosedForm) {
  const double first = barrier_error(coarse, "matrix_flow/rt0"), second = barrier_error(medium, "matrix_flow/rt0"),
               third = barrier_error(fine, "matrix_flow/rt0");
  EXPECT_LT(first, 0.01);
  EXPECT_GT(std::log2(first / second), 1.5) << first << " " << second;
  EXPECT_GT(std::log2(second / third), 1.5) << second << " " << third;
}

}  // namespace
}  // namespace sprekk::testing
