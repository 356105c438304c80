// A network with wells, of which one passes fluid from one fracture to another: what must not matter for its heat.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "tests/verification/balance_error.hpp"

namespace sprekk::testing {
namespace {

/// A map of the plane by whole right angles and mirrors, and the side that it takes the left one to.
struct Twin {
  double xx, xy, yx, yy;
  std::string left, right;
  std::string operator()(double x, double y) const {
    return fmt::format("[{} m, {} m]", xx * x + xy * y, yx * x + yy * y);
  }
};
const Twin same{1, 0, 0, 1, "left", "right"}, turned{0, -1, 1, 0, "bottom", "top"},
    mirrored{-1, 0, 0, 1, "right", "left"};

const std::string in_turn = "[{solve: [pore, conduit, wells]}, {solve: [heat, water]}]";
const std::string together = "[{solve: [pore, conduit, wells, heat, water]}]";

/// `feed` injects into both fractures and the rock until it reaches its limit, `plant` takes the same out of rock, and
/// `idle` is shut and open to both fractures and the rock.
std::string network(const Twin& at, const std::string& schedule, double injected = 330) {
  return fmt::format(R"(
geometry:
  box: {{x: [-20 m, 20 m], y: [-20 m, 20 m]}}
  fractures: {{a: {{points: [{}, {}]}}, b: {{points: [{}, {}]}}, c: {{points: [{}, {}]}}}}
mesh: {{kind: structured, cells: [40, 40], shape: quadrilaterals}}
materials: {{viscosity: 1 mPa*s, fluid_compressibility: 4e-10 1/Pa, fluid_heat_capacity: 4.2e6 J/(m^3*K)}}
components:
  pore:
    type: matrix_flow/tpfa
    permeability: 1e-14 m^2
    porosity: 0.1
    initial_pressure: 10 MPa
    boundary: {{{}: {{pressure: 10.02 MPa}}, {}: {{pressure: 10 MPa}}}}
  conduit: {{type: fracture_flow/tpfa, initial_aperture: 0.2 mm, initial_pressure: 10 MPa}}
  heat:
    type: matrix_heat/tpfa
    conductivity: 2.5 W/(m*K)
    heat_capacity: 2.2e6 J/(m^3*K)
    initial_temperature: 350 K
    boundary: {{{}: {{temperature: {} K}}}}
  water:
    type: fracture_heat/tpfa
    aperture: 0.2 mm
    conductivity: 0.6 W/(m*K)
    heat_capacity: 4.2e6 J/(m^3*K)
    initial_temperature: 350 K
  wells:
    type: wells/limited
    wells:
      feed: {{rate: 1e-5 m^2/s, highest_pressure: 10.125 MPa, places: {{one: {{at: {}, fracture: a}}, two: {{at: {}, fracture: b}}, rock: {{at: {}}}}}}}
      plant: {{at: {}, rate: -5e-6 m^2/s, lowest_pressure: 9.5 MPa, radius: 0.05 m, skin: 1}}
      idle: {{rate: 0 m^2/s, places: {{one: {{at: {}, fracture: b}}, two: {{at: {}, fracture: c}}, rock: {{at: {}}}}}}}
couplers:
  - {{type: wall_exchange, between: [pore, conduit]}}
  - {{type: well_exchange, between: [wells, pore, conduit]}}
  - {{type: heat_advection, between: [wells, pore, conduit, heat, water], injected: {{feed: {{temperature: {} K}}}}}}
  - {{type: heat_exchange, between: [heat, water]}}
schedule: {}
time: {{end: 20 day, step: 2 day}}
newton: {{residual: 1e-12}}
)",
                     at(-15, 3), at(5, 3), at(8, -12), at(8, 14), at(-14, -15), at(3, -15), at.left, at.right, at.left,
                     injected, at(-10.5, 3), at(8, 10.5), at(-5.5, -10.5), at(-12.5, 12.5), at(8, -8.5), at(-9.5, -15),
                     at(-3.5, -5.5), injected, schedule);
}

/// Temperatures of the rock and the fractures, in the order of the places before they were turned, and of the wells.
Vector solution(const std::string& scene, const Twin& at) {
  SceneRun run = SceneRun::from_text(scene);
  std::vector<double> wells;
  run.run_until(20 * 86400.0, [&] {
    for (const char* well : {"feed", "plant", "idle"})
      wells.push_back(run.quantity(fmt::format("heat_advection.{}.temperature", well)));
  });
  EXPECT_LT(balance_error(run, "heat"), 1e-9);
  EXPECT_LT(balance_error(run), 1e-9);
  EXPECT_GT(std::abs(run.quantity("wells.idle.two.rate")), 1e-7);  // it passes fluid on
  const Mesh& mesh = run.mesh();
  const auto before = [&](const Point& x) {
    return std::pair(std::lround(1e3 * (at.xx * x[0] + at.yx * x[1])),
                     std::lround(1e3 * (at.xy * x[0] + at.yy * x[1])));
  };
  std::map<std::pair<long, long>, double> rock, fractures;
  for (int c = 0; c < mesh.cell_count(); ++c) rock[before(mesh.cell_center[c])] = run.field("heat.temperature")[c];
  for (int i = 0; i < mesh.fracture_cell_count(); ++i)
    fractures[before(mesh.fracture_cells[i].center)] = run.field("water.temperature")[i];
  for (const auto& part : {rock, fractures})
    for (const auto& [place, temperature] : part) wells.push_back(temperature);
  return Eigen::Map<const Vector>(wells.data(), static_cast<Eigen::Index>(wells.size()));
}

double largest(const Vector& difference) { return difference.lpNorm<Eigen::Infinity>(); }

/// Reference: symmetry, and that small changes of the data change the answer by little.
TEST(WellsHeat, TwinsHaveTheSameTemperatures) {
  const Vector here = solution(network(same, in_turn), same);
  EXPECT_GT(here.maxCoeff() - here.minCoeff(), 15);
  EXPECT_LT(largest(solution(network(turned, in_turn), turned) - here), 1e-8);
  EXPECT_LT(largest(solution(network(mirrored, in_turn), mirrored) - here), 1e-8);
  EXPECT_LT(largest(solution(network(same, in_turn, 330 * (1 + 1e-9)), same) - here), 2 * 330e-9);
}

/// Reference: temperatures act on nothing here, so a split is exact.
TEST(WellsHeat, InTurnIsMonolithic) {
  EXPECT_LT(largest(solution(network(same, in_turn), same) - solution(network(same, together), same)), 1e-8);
}

/// Reference: the maximum principle, and the balance also where heat is solved before the flow, or in substeps.
TEST(WellsHeat, StaysWithinItsDataInAnySchedule) {
  for (const std::string& schedule :
       {in_turn, together, std::string("[{solve: [heat, water]}, {solve: [pore, conduit, wells]}]"),
        std::string("[{solve: [pore, conduit, wells]}, {subcycle: {count: 4, steps: [{solve: [heat, water]}]}}]"),
        std::string("[{subcycle: {count: 4, steps: [{solve: [pore, conduit, wells]}]}}, {solve: [heat, water]}]")}) {
    const Vector all = solution(network(same, schedule), same);
    EXPECT_GT(all.minCoeff(), 330 - 1e-9) << schedule;
    EXPECT_LT(all.maxCoeff(), 350 + 1e-9) << schedule;
    const Vector uniform = solution(network(same, schedule, 350), same);
    EXPECT_LT(largest(uniform - Vector::Constant(uniform.size(), 350)), 1e-10) << schedule;
  }
}

}  // namespace
}  // namespace sprekk::testing
