// A closed box of anisotropic rock with a fracture across the edge of a region, and nothing that drives a flow but the
// pressures that are there at the start.
#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/verification/scene_run.hpp"

namespace sprekk::testing {
namespace {

/// The energy that the fluid has stored, sum of c_p p^2 times the volume of fluid, m^2/Pa Pa^2.
double energy(const SceneRun& run) {
  constexpr double compressibility = 5e-10, porosity = 0.15, aperture = 0.5e-3;
  const Mesh& mesh = run.mesh();
  double sum = 0;
  for (int c = 0; c < mesh.cell_count(); ++c)
    sum += compressibility * porosity * mesh.cell_measure[c] * std::pow(run.field("pore.pressure")[c], 2);
  for (int i = 0; i < mesh.fracture_cell_count(); ++i)
    sum += compressibility * aperture * mesh.fracture_cells[i].measure * std::pow(run.field("conduit.pressure")[i], 2);
  return sum;
}

TEST(ClosedBox, NeverGainsEnergy) {
  struct Rock {
    double ratio, angle, slope, step;
  };
  for (const Rock& rock :
       {Rock{10, 128, 3, 36}, Rock{100, 20, 3, 3600}, Rock{100, 20, -31, 36}, Rock{1e4, 77, 52, 86400}})
    for (const auto& [type, shape] : {std::pair("mpfa", "triangles"), std::pair("mpfa", "quadrilaterals"),
                                      std::pair("rt0", "triangles"), std::pair("rt0", "quadrilaterals")}) {
      SceneRun run = SceneRun::from_text(fmt::format(
          R"(
geometry:
  box: {{x: [0 m, 2 m], y: [0 m, 2 m]}}
  fractures: {{f: {{center: [1.36 m, 1 m], length: 0.13 m, angle: {} deg}}}}
  regions: {{layer: {{polygon: [[0 m, 0 m], [2 m, 0 m], [2 m, 1 m], [0 m, 1 m]]}}}}
mesh: {{size: 0.4 m, fracture_size: 0.065 m, shape: {}}}
materials:
  porosity: 0.15
  fluid_compressibility: 5e-10 1/Pa
  permeability: {{along: 7e-20 m^2, across: {} m^2, angle: {} deg}}
  viscosity: 1 mPa*s
components:
  pore: {{type: matrix_flow/{}, initial_pressure: (1e6*x) Pa}}
  conduit: {{type: fracture_flow/tpfa, initial_aperture: 0.5 mm, initial_pressure: 1e6 Pa}}
couplers: [{{type: wall_exchange, between: [pore, conduit]}}]
schedule: [{{solve: [pore, conduit]}}]
time: {{end: {} s, step: {} s}}
)",
          rock.slope, shape, 7e-20 / rock.ratio, rock.angle, type, 20 * rock.step, rock.step));
      double before = energy(run);
      run.run_until(20 * rock.step, [&] {
        const double now = energy(run);
        EXPECT_LE(now, before * (1 + 1e-9)) << type << " " << shape << " " << rock.ratio << ":1 at " << rock.angle;
        before = now;
      });
      EXPECT_NEAR(run.quantity("fluid_balance_error"), 0, 1e-12);
    }
}

}  // namespace
}  // namespace sprekk::testing
