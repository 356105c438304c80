// Wells that feed fractures, alone and in a network beside others, and what must not matter for them.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/verification/balance_error.hpp"

namespace sprekk::testing {
namespace {

/// Reference: a well that crosses a fracture of finite conductivity, which drains into rock on both sides. As long as
/// the flow in both is linear (bilinear flow, Cinco-Ley and Samaniego 1981, after Bodvarsson), its pressure is
///   p = Q/(2 sqrt(2)) t^(1/4)/(Gamma(5/4) sqrt(T_f) (T S)^(1/4)),
/// with the transmissivity T_f of the fracture, and T = k/mu and S of the rock.
TEST(WellsInFractures, ThatCrossesAFractureSeesBilinearFlow) {
  double coarser = 0;
  for (const int cells : {20, 40, 80}) {
    SceneRun run = SceneRun::from_text(fmt::format(R"(
geometry:
  box: {{x: [-200 m, 200 m], y: [-2.5 m, 2.5 m]}}
  fractures: {{f: {{points: [[-200 m, 0 m], [200 m, 0 m]]}}}}
mesh: {{kind: structured, cells: [{}, {}], shape: quadrilaterals}}
materials: {{viscosity: 1 mPa*s, fluid_compressibility: 4e-14 1/Pa}}
components:
  pore: {{type: matrix_flow/mpfa, permeability: 1e-16 m^2, storage: 1e-9 1/Pa, initial_pressure: 2 MPa}}
  conduit: {{type: fracture_flow/tpfa, initial_aperture: 0.2 mm, initial_pressure: 2 MPa}}
  wells: {{type: wells/limited, wells: {{w: {{at: [0 m, 0 m], fracture: f, rate: 1e-6 m^2/s}}}}}}
couplers:
  - {{type: wall_exchange, between: [pore, conduit]}}
  - {{type: well_exchange, between: [wells, pore, conduit]}}
schedule: [{{solve: [pore, conduit, wells]}}]
time: {{end: 4000 s, step: {} s}}
)",
                                                   cells + 1, cells, 4000.0 / cells));
    run.run();
    const double conductance = std::pow(2e-4, 3) / 12e-3;
    const double exact = 1e-6 / (2 * std::sqrt(2.0)) * std::pow(4000, 0.25) /
                         (std::tgamma(1.25) * std::sqrt(conductance) * std::pow(1e-13 * 1e-9, 0.25));
    const double error = std::abs((run.quantity("wells.w.pressure") - 2e6) / exact - 1);
    std::printf("%d cells: rise %.3e Pa, exact %.3e Pa, error %.2e, order %.2f\n", cells,
                run.quantity("wells.w.pressure") - 2e6, exact, error, std::log2(coarser / error));
    EXPECT_LT(error, 2.0 / cells);
    EXPECT_LT(balance_error(run), 1e-9);
    coarser = error;
  }
}

/// Reference: flow along a fracture without end with tight walls from a well in its middle, p = Q sqrt(t/(pi T s)),
/// T = a^3/(12 mu), s = a c_f.
TEST(WellsInFractures, FeedBothSides) {
  double coarser = 0;
  for (const int cells : {101, 201, 401}) {
    const double dt = 0.04 * 101 / cells;
    SceneRun run = SceneRun::from_text(fmt::format(R"(
geometry:
  box: {{x: [-101 m, 101 m], y: [-2 m, 2 m]}}
  fractures: {{f: {{points: [[-101 m, 0 m], [101 m, 0 m]]}}}}
mesh: {{kind: structured, cells: [{}, 2], shape: quadrilaterals}}
materials: {{viscosity: 1 mPa*s, fluid_compressibility: 4e-10 1/Pa}}
components:
  conduit: {{type: fracture_flow/tpfa, initial_aperture: 0.02 mm, initial_pressure: 2 MPa}}
  wells: {{type: wells/limited, wells: {{w: {{at: [0 m, 0 m], fracture: f, rate: 1e-9 m^2/s}}}}}}
couplers: [{{type: well_exchange, between: [wells, conduit]}}]
schedule: [{{solve: [conduit, wells]}}]
time: {{end: 4 s, step: {} s}}
)",
                                                   cells, dt));
    run.run();
    const double transmissivity = std::pow(2e-5, 3) / 12e-3, storage = 2e-5 * 4e-10;
    const double exact = 1e-9 * std::sqrt(4 / (std::numbers::pi * transmissivity * storage));
    const double error = std::abs((run.quantity("wells.w.pressure") - 2e6) / exact - 1);
    std::printf("%d cells: error %.2e, order %.2f\n", cells, error, std::log2(coarser / error));
    EXPECT_LT(error, 0.02 * 101 / cells);
    EXPECT_LT(balance_error(run), 1e-9);
    coarser = error;
  }
}

/// Reference: a closed fracture in tight rock, in which the pressure has long been the same everywhere: it rises by
/// what the well has brought over what the fluid stores, Q t/(a c L), up to the limit of the well. Its fluid alone,
/// 1e-16 of what the fracture conducts in a step, holds the pressure while the rate is given.
TEST(WellsInFractures, RaiseThePressureOfAClosedOne) {
  for (const char* solver : {"umfpack", "mumps", "{type: umfpack, condense: false}"})
    for (const char* well : {"", ", index: 1e-4 m^2/(Pa*s)"})
      for (const bool is_limited : {false, true}) {
        SCOPED_TRACE(fmt::format("{}{}{}", solver, well, is_limited ? ", limited" : ""));
        const double length = std::hypot(40, 30), rise = 8e6;
        const double rate = 1e-3 * 4e-10 * length * rise / 4e13;
        SceneRun run =
            SceneRun::from_text(fmt::format(R"(
geometry:
  box: {{x: [-50 m, 50 m], y: [-40 m, 40 m]}}
  fractures: {{f: {{points: [[-20 m, -15 m], [20 m, 15 m]]}}}}
mesh: {{size: 20 m, fracture_size: 5 m}}
materials: {{viscosity: 1 mPa*s, fluid_compressibility: 4e-10 1/Pa}}
components:
  conduit: {{type: fracture_flow/tpfa, initial_aperture: 1 mm, initial_pressure: 2 MPa}}
  wells: {{type: wells/limited, wells: {{w: {{at: [4 m, 3 m], fracture: f, rate: {:.17g} m^2/s{}{}}}}}}}
couplers: [{{type: well_exchange, between: [wells, conduit]}}]
schedule: [{{solve: [conduit, wells]}}]
solver: {}
time: {{end: 4e13 s, step: 1e13 s}}
)",
                                            rate, is_limited ? ", highest_pressure: 7 MPa" : "", well,
                                            solver[0] == '{' ? solver : fmt::format("{{type: {}}}", solver)));
        run.run();
        EXPECT_EQ(run.steps(), 4);
        const double expected = is_limited ? 5e6 : rise;
        const Vector& pressure = run.field("conduit.pressure");
        EXPECT_NEAR(pressure.minCoeff() - 2e6, expected, 1e-9 * expected);
        EXPECT_NEAR(pressure.maxCoeff() - 2e6, expected, 1e-9 * expected);
        EXPECT_LT(balance_error(run), 1e-9);
      }
}

/// A map of the plane by whole right angles and mirrors, and the side that it takes the left one to.
struct Twin {
  double xx, xy, yx, yy;
  std::string left;
  std::string operator()(double x, double y) const {
    return fmt::format("[{} m, {} m]", xx * x + xy * y, yx * x + yy * y);
  }
};
const Twin same{1, 0, 0, 1, "left"}, turned{0, -1, 1, 0, "bottom"}, mirrored{-1, 0, 0, 1, "right"};

/// A network of two fractures in rock with three wells: one in the rock, one in a fracture, and one that is open to
/// both fractures and the rock and reaches its limit.
std::string network(const Twin& at, const std::string& schedule = "[{solve: [pore, conduit, wells]}]",
                    double rate = 1e-5) {
  return fmt::format(R"(
geometry:
  box: {{x: [-20 m, 20 m], y: [-20 m, 20 m]}}
  fractures: {{a: {{points: [{}, {}]}}, b: {{points: [{}, {}]}}}}
mesh: {{kind: structured, cells: [40, 40], shape: quadrilaterals}}
materials: {{viscosity: 1 mPa*s, fluid_compressibility: 4e-10 1/Pa}}
components:
  pore:
    type: matrix_flow/tpfa
    permeability: 1e-14 m^2
    porosity: 0.1
    initial_pressure: 10 MPa
    boundary: {{{}: {{pressure: 10 MPa}}}}
  conduit: {{type: fracture_flow/tpfa, initial_aperture: 0.2 mm, initial_pressure: 10 MPa}}
  wells:
    type: wells/limited
    wells:
      feed: {{rate: {} m^2/s, highest_pressure: 10.125 MPa, places: {{one: {{at: {}, fracture: a}}, two: {{at: {}, fracture: b}}, rock: {{at: {}}}}}}}
      outlet: {{at: {}, rate: -5e-6 m^2/s, lowest_pressure: 9.5 MPa, radius: 0.05 m, skin: 1}}
      drain: {{at: {}, fracture: b, pressure: 10 MPa, index: 1e-10 m^2/(Pa*s)}}
couplers:
  - {{type: wall_exchange, between: [pore, conduit]}}
  - {{type: well_exchange, between: [wells, pore, conduit]}}
schedule: {}
time: {{end: 2 h, step: 10 min}}
)",
                     at(-15, 3), at(5, 3), at(8, -12), at(8, 14), at.left, rate, at(-10.5, 3), at(8, 10.5),
                     at(-5.5, -10.5), at(-12.5, 12.5), at(8, -8.5), schedule);
}

std::vector<double> solution(const std::string& scene) {
  SceneRun run = SceneRun::from_text(scene);
  std::vector<double> values;
  run.run_until(7200, [&] {
    for (const char* well : {"feed", "outlet", "drain"}) {
      values.push_back(run.quantity(fmt::format("wells.{}.pressure", well)) / 1e7);
      values.push_back(run.quantity(fmt::format("wells.{}.rate", well)) / 1e-5);
      values.push_back(run.quantity(fmt::format("wells.{}.binds_0_rate_1_pressure_2_shut", well)));
    }
    for (const char* place : {"one", "two", "rock"})
      values.push_back(run.quantity(fmt::format("wells.feed.{}.rate", place)) / 1e-5);
  });
  EXPECT_LT(balance_error(run), 1e-9);
  return values;
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  EXPECT_EQ(a.size(), b.size());
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

/// Reference: symmetry, and that small changes of the data change the answer by little.
TEST(WellsInFractures, TwinsAgree) {
  const std::vector<double> here = solution(network(same));
  EXPECT_EQ(here[2], 0);                 // the feed begins with its rate
  EXPECT_EQ(here[here.size() - 10], 1);  // and ends at its limit
  EXPECT_LT(largest_difference(solution(network(turned)), here), 1e-8);
  EXPECT_LT(largest_difference(solution(network(mirrored)), here), 1e-8);
  EXPECT_LT(largest_difference(solution(network(same, "[{solve: [pore, conduit, wells]}]", 1e-5 * (1 + 1e-9))), here),
            1e-8);
}

}  // namespace
}  // namespace sprekk::testing
