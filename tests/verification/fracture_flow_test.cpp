// Flow across and along a fracture: a single mode, for every transmissivity and normal permeability of the table.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/verification/scene_run.hpp"

namespace sprekk::testing {
namespace {

struct Mode {
  double transmissivity, kappa, a, b, f;
};

std::vector<Mode> modes() {
  std::vector<Mode> modes;
  for (const auto& row :
       read_numbers(std::string(SPREKK_SOURCE_DIR) + "/tests/verification/references/single_mode_fracture.csv"))
    modes.push_back({row[0], row[1], row[2], row[3], row[4]});
  return modes;
}

struct Errors {
  double matrix, fracture;  ///< relative to the largest pressure
};

Errors errors(const Mode& mode, const std::string& mesh_text) {
  const auto text = [](double value, const char* unit) { return std::to_string(value * 1e9) + "e-9 " + unit; };
  SceneRun run("verification/single_mode_fracture.yaml",
               {{"mesh", mesh_text},
                {"components.conduit.transmissivity_value", text(mode.transmissivity, "m^3")},
                {"components.conduit.normal_permeability_value", text(mode.kappa, "m/(Pa*s)")}});
  run.run();
  const Mesh& mesh = run.mesh();
  double square = 0, area = 0, fracture_square = 0;
  for (int c = 0; c < mesh.cell_count(); ++c) {
    const Point& x = mesh.cell_center[c];
    const double y = M_PI * std::abs(x[1]);
    const double exact = std::cos(M_PI * x[0]) * (mode.a * std::cosh(y) + mode.b * std::sinh(y));
    square += mesh.cell_measure[c] * std::pow(run.field("pore.pressure")[c] - exact, 2);
    area += mesh.cell_measure[c];
  }
  for (int i = 0; i < mesh.fracture_cell_count(); ++i) {
    const FractureCell& cell = mesh.fracture_cells[i];
    const double exact = mode.f * std::cos(M_PI * cell.center[0]);
    fracture_square += cell.measure * std::pow(run.field("conduit.pressure")[i] - exact, 2);
  }
  return {std::sqrt(square / area), std::sqrt(fracture_square)};
}

void expect_second_order(const std::string& coarse_mesh, const std::string& fine_mesh) {
  const std::vector<Mode> all = modes();
  ASSERT_EQ(all.size(), 25u);
  double worst_coarse = 0, worst = 0, worst_fracture_coarse = 0, worst_fracture = 0;
  for (const Mode& mode : all) {
    const Errors coarse = errors(mode, coarse_mesh), fine = errors(mode, fine_mesh);
    worst_coarse = std::max(worst_coarse, coarse.matrix);
    worst = std::max(worst, fine.matrix);
    worst_fracture_coarse = std::max(worst_fracture_coarse, coarse.fracture);
    worst_fracture = std::max(worst_fracture, fine.fracture);
    EXPECT_LT(fine.matrix, 1.5e-3) << "T = " << mode.transmissivity << ", kappa = " << mode.kappa;
    EXPECT_LT(fine.fracture, 1.5e-3) << "T = " << mode.transmissivity << ", kappa = " << mode.kappa;
  }
  // Over all pairs together: the error is uniform, and falls with the square of the mesh size.
  EXPECT_GT(std::log2(worst_coarse / worst), 1.8) << worst_coarse << " " << worst;
  EXPECT_GT(std::log2(worst_fracture_coarse / worst_fracture), 1.8) << worst_fracture_coarse << " " << worst_fracture;
}

TEST(SingleMode, IsSecondOrderUniformlyInTransmissivityAndPermeability) {
  expect_second_order("{size: 0.1 m}", "{size: 0.05 m}");
}

TEST(SingleMode, IsSecondOrderOnQuadrilaterals) {
  const std::string squares = "{kind: structured, shape: quadrilaterals, cells: ";
  expect_second_order(squares + "[14, 14]}", squares + "[28, 28]}");
}

}  // namespace
}  // namespace sprekk::testing
