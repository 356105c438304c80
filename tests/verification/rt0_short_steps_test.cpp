// matrix_flow/rt0 in steps that are short against the diffusion time of a cell: a front that enters a half space keeps
// its bounds, on cells of any shape and in any direction.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "framework/mesh/build_mesh.hpp"
#include "tests/verification/mesh_file.hpp"
#include "tests/verification/scene_run.hpp"

namespace sprekk::testing {
namespace {

using std::numbers::pi;

constexpr int cells_across = 12;
constexpr double size = 1.0 / cells_across;

RawMesh drawn(const std::string& mesh) {
  SceneRun run = SceneRun::from_text(fmt::format(
      "{{geometry: {{box: {{x: [0 m, 1 m], y: [0 m, 1 m]}}}}, mesh: {}, components: {{pore: {{type: matrix_flow/rt0, "
      "permeability: 1 m^2, viscosity: 1 Pa*s, storage: 1 1/Pa}}}}, schedule: [{{solve: pore}}], time: {{end: 1 s, "
      "step: "
      "1 s}}}}",
      mesh));
  return to_raw_mesh(run.mesh());
}

/// With all inner nodes moved at random by up to this part of the size of cells in each direction.
RawMesh distorted(RawMesh mesh, double by) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> along(-by * size, by * size);
  for (Point& node : mesh.nodes) {
    const Point moved = node + Point(along(random), along(random));
    const bool is_inside = (node.array() > 1e-9).all() && (node.array() < 1 - 1e-9).all();
    if (is_inside) node = moved;
  }
  return mesh;
}

struct Front {
  double undershoot = 0, overshoot = 0;  ///< over all steps, of the pressure of the side
  double opposed = 0;                    ///< the same undershoot, over the largest pressure of a cell in the step
  double error = 0;                      ///< of the pressure at the end against erfc, relative L2
};

/// The side `left` gets 1 Pa; the rock has a diffusivity of 1 m^2/s.
Front front(const RawMesh& mesh, const Tensor& map, double step, int steps, const std::string& flux_mass) {
  const std::string file = write_msh(mesh, map, Point(0.3, -0.2), "rt0_front");
  SceneRun run = SceneRun::from_text(fmt::format(
      "{{geometry: {{file: {}}}, components: {{pore: {{type: matrix_flow/rt0, permeability: 1 m^2, viscosity: 1 Pa*s, "
      "storage: 1 1/Pa, boundary: {{left: {{pressure: 1 Pa}}}}, flux_mass: {}}}}}, schedule: [{{solve: pore}}], time: "
      "{{end: {:.17g} s, step: {:.17g} s}}}}",
      file, flux_mass, steps * step, step));
  Front found;
  run.run_until(steps * step, [&] {
    const Vector& p = run.field("pore.pressure");
    found.undershoot = std::max(found.undershoot, -p.minCoeff());
    found.overshoot = std::max(found.overshoot, p.maxCoeff() - 1);
    found.opposed = std::max(found.opposed, -p.minCoeff() / p.maxCoeff());
  });
  Vector exact(run.mesh().cell_count());
  for (int c = 0; c < exact.size(); ++c) {
    const Point x = map.inverse() * (run.mesh().cell_center[c] - Point(0.3, -0.2));
    exact[c] = std::erfc(x[0] / (2 * std::sqrt(run.time())));
  }
  const Vector areas = Eigen::Map<const Vector>(run.mesh().cell_measure.data(), exact.size());
  found.error = relative_error(areas, run.field("pore.pressure"), exact);
  return found;
}

struct Cells {
  std::string name;
  RawMesh mesh;
};

std::vector<Cells> cells_of_all_shapes() {
  const std::string counts = fmt::format("cells: [{0}, {0}]", cells_across);
  const RawMesh squares = drawn("{kind: structured, shape: quadrilaterals, " + counts + "}");
  const RawMesh halves = drawn("{kind: structured, " + counts + "}");
  const RawMesh triangles = drawn(fmt::format("{{size: {} m}}", size));
  return {{"squares", squares},
          {"distorted quadrilaterals", distorted(squares, 0.25)},
          {"halves of squares", halves},
          {"triangles", triangles},
          {"distorted triangles", distorted(triangles, 0.2)}};
}

constexpr double half_a_percent = 5e-3;

TEST(Rt0ShortSteps, FrontsKeepTheirBoundsOnCellsOfAnyShape) {
  Tensor mirrored;
  mirrored << -1, 0, 0, 1;
  for (const auto& [name, mesh] : cells_of_all_shapes())
    for (const Tensor& map : {Tensor(Tensor::Identity()), turned_by(37), Tensor(turned_by(20) * mirrored)})
      for (const double ratio : {1e-6, 1e-3, 1e-2, 0.03, 0.1, 0.3, 1.0}) {
        const Front found = front(mesh, map, ratio * size * size, 30, "automatic");
        EXPECT_LT(found.undershoot, half_a_percent) << name << " " << ratio;
        EXPECT_LT(found.opposed, half_a_percent) << name << " " << ratio;
        EXPECT_LT(found.overshoot, 1e-12) << name << " " << ratio;
        // The front is thinner than a cell until t = 0.3 size^2.
        if (ratio >= 0.03) {
          EXPECT_LT(found.error, 0.09) << name << " " << ratio;
        }
      }
}

/// What the bounds of the test above are for: the exact mass matrix alone opposes the flux of a cell by a quarter of
/// it.
TEST(Rt0ShortSteps, TheExactMassMatrixLeavesTheBounds) {
  for (const auto& [name, mesh] : cells_of_all_shapes()) {
    if (name == "halves of squares") continue;  // in this direction they keep them
    const Front found = front(mesh, Tensor::Identity(), 1e-2 * size * size, 30, "exact");
    EXPECT_GT(found.undershoot, 0.01) << name;
    EXPECT_GT(found.opposed, 0.1) << name;
  }
}

/// A wave cos(pi x) decays in a closed box: after n steps of backward Euler by (1 + pi^2 dt)^-n, exactly in time. The
/// relative error of the pressure after that.
double error_of_a_wave(const std::string& mesh, double step, int steps, const std::string& flux_mass) {
  SceneRun run = SceneRun::from_text(fmt::format(
      "{{geometry: {{box: {{x: [0 m, 1 m], y: [0 m, 1 m]}}}}, mesh: {}, components: {{pore: {{type: matrix_flow/rt0, "
      "permeability: 1 m^2, viscosity: 1 Pa*s, storage: 1 1/Pa, initial_pressure: cos(pi*x) Pa, flux_mass: {}}}}}, "
      "schedule: [{{solve: pore}}], time: {{end: {:.17g} s, step: {:.17g} s}}}}",
      mesh, flux_mass, steps * step, step));
  run.run();
  EXPECT_EQ(run.steps(), steps);
  const double left = std::pow(1 + pi * pi * step, -steps);
  Vector exact(run.mesh().cell_count());
  for (int c = 0; c < exact.size(); ++c) exact[c] = left * std::cos(pi * run.mesh().cell_center[c][0]);
  const Vector areas = Eigen::Map<const Vector>(run.mesh().cell_measure.data(), exact.size());
  return relative_error(areas, run.field("pore.pressure"), exact);
}

TEST(Rt0ShortSteps, AreOfSecondOrderAndLongOnesAsWithTheExactMassMatrix) {
  const auto meshes = [](int cells) {
    return std::vector<std::string>{
        fmt::format("{{kind: structured, shape: quadrilaterals, cells: [{0}, {0}]}}", cells),
        fmt::format("{{kind: structured, cells: [{0}, {0}]}}", cells), fmt::format("{{size: {} m}}", 1.0 / cells)};
  };
  for (int k = 0; k < 3; ++k) {
    for (const double ratio : {1.0 / 72, 1.0 / 18}) {  // of the step to the diffusion time of a cell
      const double coarse = error_of_a_wave(meshes(12)[k], ratio / 144, 100, "automatic");
      const double fine = error_of_a_wave(meshes(24)[k], ratio / 576, 400, "automatic");
      EXPECT_GT(std::log2(coarse / fine), 1.9) << meshes(12)[k] << " " << coarse << " " << fine;
      EXPECT_LT(coarse, 0.02) << meshes(12)[k];
    }
    const double exact = error_of_a_wave(meshes(12)[k], 0.5 / 144, 10, "exact");
    EXPECT_EQ(error_of_a_wave(meshes(12)[k], 0.5 / 144, 10, "automatic"), exact) << meshes(12)[k];
  }
}

/// Terzaghi's column, whose rock alone stores fluid if the fluid is incompressible: overshoots of the pressure, which
/// rises to 2/(2 S + 1) Pa, beside each rock.
TEST(Rt0ShortSteps, OfAColumnOvershootByHalfAPercentAtMost) {
  for (const std::string rock : {"mpsa", "fem first", "fem second"})
    for (const std::string shape : {"triangles", "quadrilaterals"})
      for (const double storage : {0.5, 0.0})
        for (const double ratio : {1e-6, 1e-4, 1e-2, 1.0}) {  // of the step to the diffusion time of a layer
          const std::string dt = fmt::format("{:.17g} s", ratio / 1600);
          std::vector<Override> overrides = {
              {"components.pore.type", "matrix_flow/rt0"},
              {"components.pore.storage", fmt::format("{} 1/Pa", storage)},
              {"mesh.shape", shape},
              {"time", fmt::format("{{end: {:.17g} s, step: {}}}", 10 * ratio / 1600, dt)}};
          if (rock != "mpsa") {
            overrides.push_back({"components.rock.type", "poromechanics/fem"});
            overrides.push_back({"components.rock.order", rock.substr(4)});
          }
          SceneRun run("verification/terzaghi.yaml", overrides);
          const double at_first = 2 / (2 * storage + 1);
          for (int step = 0; step < 10; ++step) {
            run.step();
            const Vector& p = run.field("pore.pressure");
            EXPECT_LT(p.maxCoeff() / at_first - 1, half_a_percent)
                << rock << " " << shape << " " << storage << " " << ratio;
            EXPECT_GT(p.minCoeff() / at_first, -half_a_percent)
                << rock << " " << shape << " " << storage << " " << ratio;
          }
        }
}

}  // namespace
}  // namespace sprekk::testing
