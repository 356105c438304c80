// What is injected is stored or flows out, however well the rock conducts.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "tests/verification/scene_run.hpp"

namespace sprekk::testing {
namespace {

/// The largest error of the books after any step, over the largest figure in them.
double error_of_books(SceneRun& run) {
  double error = 0, turnover = 0;
  run.run_until(run.model().scene().time.end, [&] {
    error = std::max(error, std::abs(run.quantity("fluid_balance_error")));
    for (const char* figure : {"fluid_stored", "fluid_injected", "fluid_outflow"})
      turnover = std::max(turnover, std::abs(run.quantity(figure)));
  });
  EXPECT_GT(turnover, 0);
  return error / turnover;
}

/// The tutorial's scene, all of whose sides are closed or not: rock, fluid, friction and a fracture that opens.
std::vector<Override> scene(const std::string& permeability, bool is_open) {
  return {{"materials.permeability", permeability},
          {"mesh.size", "1.5 m"},
          {"mesh.fracture_size", "0.4 m"},
          {"time.end", "4 h"},
          {"components.pore.boundary", is_open ? "{left: {pressure: 5 MPa}}" : "{}"}};
}

// With sides that are closed the level of the pressure is held by what rock and fluid store, as little as 1e-15 of what
// the rock conducts in a step; with one that is open a multiple of what is injected flows past.
TEST(Books, CloseForEveryPermeability) {
  for (const char* permeability : {"1e-24 m^2", "1e-17 m^2", "1e-10 m^2", "1e-6 m^2", "1e-3 m^2"})
    for (const bool is_open : {false, true}) {
      SCOPED_TRACE(std::string(permeability) + (is_open ? ", open" : ", closed"));
      SceneRun run("tutorial/first_scene.yaml", scene(permeability, is_open));
      EXPECT_LT(error_of_books(run), 1e-7);
    }
}

TEST(Books, CloseForEveryStorageOfTheFluid) {
  for (const char* compressibility : {"0 1/Pa", "1e-14 1/Pa", "1e-6 1/Pa"}) {
    SCOPED_TRACE(compressibility);
    std::vector<Override> changes = scene("1e-6 m^2", false);
    changes.push_back({"materials.fluid_compressibility", compressibility});
    SceneRun run("tutorial/first_scene.yaml", changes);
    EXPECT_LT(error_of_books(run), 1e-7);
  }
}

// Flow and rock in turn: the same test ends the iteration.
TEST(Books, CloseWhereASchemeIterates) {
  for (const char* permeability : {"1e-17 m^2", "1e-10 m^2"}) {
    SCOPED_TRACE(permeability);
    std::vector<Override> changes = scene(permeability, true);
    changes.push_back({"schedule",
                       "[{iterate: {steps: [{solve: [pore, conduit], stabilize: fixed_stress}, "
                       "{solve: [rock, contact]}]}}]"});
    SceneRun run("tutorial/first_scene.yaml", changes);
    EXPECT_LT(error_of_books(run), 1e-5);
  }
}

}  // namespace
}  // namespace sprekk::testing
