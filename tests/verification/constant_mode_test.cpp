// The constant mode of pressures that storage alone determines, where rock conducts many orders of magnitude more in a
// step than rock and fluid store.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/verification/scene_run.hpp"

namespace sprekk::testing {
namespace {

constexpr double first_pressure = 20e6, rise = 1e6, end = 1e7;

std::string in_unit(double value, const char* unit) {
  char text[60];
  std::snprintf(text, sizeof text, "%.17g %s", value, unit);
  return text;
}

double length_of_fractures(const Mesh& mesh) {
  double length = 0;
  for (const FractureCell& cell : mesh.fracture_cells) length += cell.measure;
  return length;
}

/// After `rise` all pressures are the first one plus that. Newton's method may leave 1e-10 of it.
void expect_rise(SceneRun& run) {
  int cells = 0;
  for (const char* name : {"pore.pressure", "conduit.pressure"}) {
    const Vector& pressure = run.field(name);
    cells += static_cast<int>(pressure.size());
    EXPECT_NEAR(pressure.minCoeff(), first_pressure + rise, 1e-9 * rise) << name;
    EXPECT_NEAR(pressure.maxCoeff(), first_pressure + rise, 1e-9 * rise) << name;
  }
  EXPECT_GT(cells, 50);
  EXPECT_EQ(run.steps(), 4);
  EXPECT_LE(std::abs(run.quantity("fluid_balance_error")), 1e-9 * run.quantity("fluid_stored"));
}

// What the fluid in the fracture stores is 4e-10 to 4e-28 of what the rock conducts in a step.
TEST(ConstantMode, IsTheStoredFluidOverTheCapacity) {
  for (const double permeability : {1e-15, 1e-9, 1e-3, 1e3})
    for (const char* type : {"matrix_flow/mpfa", "matrix_flow/tpfa"})
      for (const char* solver : {"umfpack", "mumps", "{type: umfpack, condense: false}"}) {
        SCOPED_TRACE(in_unit(permeability, type) + solver);
        SceneRun run("verification/closed_box.yaml", {{"components.pore.permeability", in_unit(permeability, "m^2")},
                                                      {"components.pore.type", type},
                                                      {solver[0] == '{' ? "solver" : "solver.type", solver}});
        run.run();
        expect_rise(run);
      }
}

// The rock stores as much as the fracture, in each cell: the sum has an entry for every cell, and the bulk alone has a
// constant mode.
TEST(ConstantMode, IsThatOfRockAndFracture) {
  for (const double permeability : {1e-15, 1e-9, 1e-3})
    for (const char* condense : {"true", "false"}) {
      SCOPED_TRACE(in_unit(permeability, "m^2, condense: ") + condense);
      const double of_rock = 2e-15 * std::hypot(0.4, 0.25);
      SceneRun run("verification/closed_box.yaml",
                   {{"components.pore.permeability", in_unit(permeability, "m^2")},
                    {"components.pore.storage", in_unit(of_rock, "1/Pa")},
                    {"components.conduit.injection.well.rate", in_unit(2 * of_rock * rise / end, "m^2/s")},
                    {"solver.condense", condense}});
      ASSERT_NEAR(length_of_fractures(run.mesh()), std::hypot(0.4, 0.25), 1e-12);
      run.run();
      expect_rise(run);
    }
}

// What a well in the rock injects is 1e-10 of the round-off of the balances there: only their sum contains it.
TEST(ConstantMode, HasAWellThatRoundOffHides) {
  SceneRun run("verification/closed_box.yaml",
               {{"components.pore.permeability", "1e-3 m^2"},
                {"components.conduit.injection.well.rate", "0 m^2/s"},
                {"components.pore.wells.well", "{at: [0.8 m, 0.2 m], rate: 9.433981132056604e-17 m^2/s}"}});
  run.run();
  expect_rise(run);
}

// A side with a given pressure determines the constant.
TEST(ConstantMode, IsGivenByASide) {
  SceneRun run("verification/closed_box.yaml", {{"components.pore.boundary.left", "{pressure: 21 MPa}"}});
  run.run();
  EXPECT_NEAR(run.field("pore.pressure").minCoeff(), first_pressure + rise, 1e-9 * rise);
  EXPECT_NEAR(run.field("conduit.pressure").maxCoeff(), first_pressure + rise, 1e-9 * rise);
}

}  // namespace
}  // namespace sprekk::testing
