// Temperatures beyond all that is given, and the note that tells of them.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "framework/assembly/notes.hpp"
#include "tests/verification/balance_error.hpp"
#include "tests/verification/scene_run.hpp"

namespace sprekk::testing {
namespace {

struct Ended {
  double lowest, highest;
  std::string note;
};

/// Rock of 300 K beside a side that has 400 K in its middle, after some steps.
Ended beside_a_hot_side(const std::string& type, const std::string& conductivity, const std::string& cells) {
  SceneRun run = SceneRun::from_text(fmt::format(R"(
geometry: {{box: {{x: [0 m, 1 m], y: [0 m, 1 m]}}}}
mesh: {{kind: structured, cells: {}, shape: triangles}}
components:
  heat:
    type: {}
    conductivity: {}
    heat_capacity: 2e6 J/(m^3*K)
    initial_temperature: 300 K
    boundary: {{left: {{temperature: (300 + 100*(y > 0.4)*(y < 0.6)) K}}}}
schedule: [{{solve: heat}}]
time: {{end: 4000 s, step: 1000 s}}
)",
                                                 cells, type, conductivity));
  Notes notes;
  Ended ended{300, 300, ""};
  for (const double start : {0, 1000, 2000, 3000}) {
    const StepTime step{start, 1000, start + 1000};
    EXPECT_TRUE(run.model().attempt(step).converged);
    const Vector& values = run.field("heat.temperature");
    ended.lowest = std::min(ended.lowest, values.minCoeff());
    ended.highest = std::max(ended.highest, values.maxCoeff());
    for (const Part* part : run.model().parts()) part->note_step(notes, step);  // compares with the last accepted state
    run.model().accept();
  }
  for (const Notes::Note& note : notes.all()) ended.note += note.text;
  return ended;
}

const std::string along_45_degrees = "{xx: 50.5 W/(m*K), yy: 50.5 W/(m*K), xy: 49.5 W/(m*K)}";  // 100 : 1

TEST(HeatBounds, ThatAreMissedAreNoted) {
  const Ended ended = beside_a_hot_side("matrix_heat/mpfa", along_45_degrees, "[10, 10]");
  std::printf("%.2f to %.2f K: %s\n", ended.lowest, ended.highest, ended.note.c_str());
  EXPECT_LT(ended.lowest, 299);
  EXPECT_THAT(ended.note, ::testing::HasSubstr("heat.temperature is higher or lower than all around it"));
  EXPECT_THAT(ended.note, ::testing::HasSubstr("matrix_heat/tpfa"));
}

TEST(HeatBounds, ThatAreKeptNeedNoNote) {
  for (const char* type : {"matrix_heat/mpfa", "matrix_heat/tpfa"}) {
    const Ended ended = beside_a_hot_side(type, "2 W/(m*K)", "[10, 10]");
    EXPECT_GE(ended.lowest, 300 - 1e-9) << type;
    EXPECT_LE(ended.highest, 400 + 1e-9) << type;
    EXPECT_GT(ended.highest, 301) << type;
    EXPECT_EQ(ended.note, "") << type;
  }
}

/// A column with a well that injects warm fluid at a pressure that the other side does not have at the start: `order`
/// of the solves.
std::string column(const std::string& order, double time) {
  return fmt::format(R"(
geometry: {{box: {{x: [0 m, 4 m], y: [0 m, 1 m]}}}}
mesh: {{kind: structured, cells: [20, 1], shape: quadrilaterals}}
components:
  pore:
    type: matrix_flow/tpfa
    permeability: 1e-12 m^2
    viscosity: 1 mPa*s
    storage: 0 1/Pa
    initial_pressure: 5 MPa
    boundary: {{right: {{pressure: 1 MPa}}}}
    wells: {{feed: {{at: [0.1 m, 0.5 m], rate: 1e-6 m^2/s}}}}
  heat: {{type: matrix_heat/tpfa, conductivity: 2 W/(m*K), heat_capacity: 2e6 J/(m^3*K), initial_temperature: 300 K}}
couplers: [{{type: heat_advection, between: [pore, heat], fluid_heat_capacity: 4e6 J/(m^3*K), injected: {{feed: {{temperature: 350 K}}}}}}]
schedule: {}
time: {{end: {} s, step: 1e5 s}}
)",
                     order, time);
}

/// Reference: flow that is steady from the first step on. Heat that is solved before it is carried by the flow of the
/// step before, and so is one step late, to the bit of the equations. The initial pressure is no flow: it would drain
/// the last cell of eighty times what it holds.
TEST(HeatBounds, AreKeptByHeatThatIsSolvedBeforeTheFlow) {
  SceneRun late = SceneRun::from_text(column("[{solve: heat}, {solve: pore}]", 6e5));
  SceneRun known = SceneRun::from_text(column("[{solve: pore}, {solve: heat}]", 5e5));
  late.run();
  known.run();
  EXPECT_GT(known.field("heat.temperature").maxCoeff(), 320);
  EXPECT_LT((late.field("heat.temperature") - known.field("heat.temperature")).lpNorm<Eigen::Infinity>(), 1e-9);
  EXPECT_LT(balance_error(late, "heat"), 1e-12);
}

}  // namespace
}  // namespace sprekk::testing
