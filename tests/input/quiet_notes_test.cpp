// Notes that must be there, and notes that must not, of wells, of heat, and of runs in which nothing moves.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "tests/input/notes.hpp"

namespace sprekk::testing {
namespace {

using ::testing::HasSubstr;

/// The notes of run.json of a scene that runs to its end, by topic and text.
std::string notes_of(const std::string& scene) {
  const Folder folder;
  std::ofstream(folder / "scene.yaml") << scene;
  const Outcome outcome = sprekk_command({"run", "scene.yaml", "-q", "-o", "out"}, folder.path());
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  const Json record = Json::parse(text_of(folder / "out/run.json"));
  std::string all;
  for (const Json& note : record["notes"])
    all += note["topic"].get<std::string>() + ": " + note["text"].get<std::string>() + "\n";
  return all;
}

/// A well that takes more than steady flow can bring it: at 0.1 m its pressure is far below zero, where that of no cell
/// is. From 100 MPa on nothing is.
std::string pumped(const std::string& initial, const std::string& rate, const std::string& more = "") {
  return fmt::format(R"(
geometry: {{box: {{x: [0 m, 300 m], y: [0 m, 300 m]}}}}
mesh: {{kind: structured, cells: [15, 15], shape: quadrilaterals}}
materials: {{viscosity: 1 mPa*s, permeability: 1e-14 m^2}}
components:
  pore: {{type: matrix_flow/tpfa, storage: 0 1/Pa, initial_pressure: {0}, boundary: {{left: {{pressure: {0}}}, right: {{pressure: {0}}}}}}}
  wells: {{type: wells/limited, wells: {{a: {{at: [150 m, 150 m], {1}}}}}}}
couplers: [{{type: well_exchange, between: [wells, pore]}}]
schedule: [{{solve: [pore, wells]}}]
time: {{end: 1e6 s, step: 5e5 s}}
output: {{fields: false}}
{2})",
                     initial, rate, more);
}

TEST(QuietNotes, APressureBelowZeroInAWellIsTold) {
  EXPECT_THAT(notes_of(pumped("10 MPa", "rate: -1e-4 m^2/s")),
              HasSubstr("the pressure in well 'a' falls to -2.31e+06 Pa (around it it began at 1e+07 Pa"));
  EXPECT_THAT(notes_of(pumped("10 MPa", "pressure: -1 MPa")), HasSubstr("wells.a below zero"));
  EXPECT_EQ(notes_of(pumped("10 MPa", "rate: -1e-4 m^2/s, lowest_pressure: 0 Pa")), "");
  EXPECT_EQ(notes_of(pumped("100 MPa", "rate: -1e-4 m^2/s")), "");
  // Pressures that begin at zero are differences.
  EXPECT_EQ(notes_of(pumped("0 Pa", "rate: -1e-4 m^2/s")), "");
}

/// Heat that a well injects into rock.
std::string warmed(const std::string& initial, const std::string& side, const std::string& injected) {
  return fmt::format(R"(
geometry: {{box: {{x: [0 m, 100 m], y: [0 m, 100 m]}}}}
mesh: {{kind: structured, cells: [5, 5], shape: quadrilaterals}}
materials: {{viscosity: 1 mPa*s, permeability: 1e-14 m^2, conductivity: 2.5 W/(m*K), heat_capacity: 2.5e6 J/(m^3*K), fluid_heat_capacity: 4.2e6 J/(m^3*K)}}
components:
  pore: {{type: matrix_flow/tpfa, storage: 1e-10 1/Pa, initial_pressure: 10 MPa, boundary: {{left: {{pressure: 10 MPa}}}}, wells: {{w: {{at: [50 m, 50 m], rate: 1e-6 m^2/s}}}}}}
  heat: {{type: matrix_heat/tpfa{}{}}}
couplers: [{{type: heat_advection, between: [pore, heat], injected: {{w: {{temperature: {}}}}}}}]
schedule: [{{solve: pore}}, {{solve: heat}}]
time: {{end: 10 day, step: 10 day}}
output: {{fields: false, splitting_error: false}}
)",
                     initial.empty() ? "" : ", initial_temperature: " + initial,
                     side.empty() ? "" : ", boundary: {left: {temperature: " + side + "}}", injected);
}

TEST(QuietNotes, TemperaturesNearZeroAreTold) {
  const std::string topic = "temperatures near 0 K: ";
  EXPECT_EQ(notes_of(warmed("400 K", "", "300 K")), "");
  EXPECT_THAT(notes_of(warmed("400 K", "", "30 K")),
              HasSubstr(topic + "'heat_advection' has temperatures down to 30 K"));
  EXPECT_THAT(notes_of(warmed("120 K", "", "30 K")), HasSubstr("down to 30 K at the start"));  // degrees Celsius
  EXPECT_THAT(notes_of(warmed("", "", "300 K")), HasSubstr("down to 0 K at the start"));       // the start is missing
  EXPECT_THAT(notes_of(warmed("400 K", "20 K", "300 K")), HasSubstr(topic + "'heat' has temperatures down to 20 K"));
  // Differences from the start.
  EXPECT_EQ(notes_of(warmed("", "", "1 K")), "");
  EXPECT_EQ(notes_of(warmed("0 K", "2 K", "-1 K")), "");
}

/// Fluid and heat that rest: nothing is moved, so nothing is lost, and no cell is warmer than all around it.
TEST(QuietNotes, WhatRestsHasNone) {
  const std::string heat = R"(
  heat: {type: matrix_heat/mpfa, conductivity: 2.5 W/(m*K), heat_capacity: 2.5e6 J/(m^3*K), initial_temperature: 400 K, boundary: {top: {temperature: 400 K}}}
couplers: [{type: heat_advection, between: [pore, heat], fluid_heat_capacity: 4.2e6 J/(m^3*K)}]
schedule: [{solve: pore}, {solve: heat}])";
  const std::string at_rest = "initial_pressure: 20 MPa";
  const std::string under_weight = "initial_pressure: \"(2e7 - 9810*y) Pa\", gravity: [0, -9.81 m/s^2]";
  for (const auto& [pressure, more] : {std::pair(at_rest, heat),
                                       {at_rest, "\nschedule: [{solve: pore}]"},
                                       {under_weight, "\nschedule: [{solve: pore}]"}})
    for (const char* type : {"tpfa", "mpfa"})
      EXPECT_EQ(notes_of(fmt::format(R"(
geometry: {{box: {{x: [0 m, 100 m], y: [-1000 m, 0 m]}}}}
mesh: {{size: 50 m}}
components:
  pore: {{type: matrix_flow/{}, permeability: 1e-15 m^2, viscosity: 1 mPa*s, storage: 1e-10 1/Pa, {}, boundary: {{top: {{pressure: 20 MPa}}}}}}{}
time: {{end: 10 year, step: 1 year}}
output: {{fields: false}}
)",
                                     type, pressure, more)),
                "");
}

/// A well with two places that injects, rests and produces: what it does while it rests is round-off.
TEST(QuietNotes, AWellThatRestsHasNone) {
  EXPECT_EQ(notes_of(R"(
geometry: {box: {x: [0 m, 200 m], y: [0 m, 200 m]}}
mesh: {size: 15 m}
materials: {viscosity: 1 mPa*s, permeability: 1e-13 m^2, conductivity: 2.5 W/(m*K), heat_capacity: 2.5e6 J/(m^3*K), fluid_heat_capacity: 4.2e6 J/(m^3*K)}
components:
  pore: {type: matrix_flow/mpfa, storage: 1e-10 1/Pa, initial_pressure: 10 MPa, boundary: {left: {pressure: 10 MPa}, right: {pressure: 10 MPa}}}
  wells:
    type: wells/limited
    wells: {w: {rate: [{value: 2e-4 m^2/s, to: 400 day}, {value: -1e-4 m^2/s, from: 600 day}], highest_pressure: 14 MPa, lowest_pressure: 7 MPa, places: {up: {at: [100 m, 150 m]}, down: {at: [100 m, 60 m]}}}}
  heat: {type: matrix_heat/mpfa, initial_temperature: 400 K}
couplers:
  - {type: well_exchange, between: [wells, pore]}
  - {type: heat_advection, between: [wells, pore, heat], injected: {w: {temperature: 300 K}}}
schedule: [{solve: [pore, wells]}, {solve: heat}]
time: {end: 1200 day, step: 10 day}
output: {fields: false}
)"),
            "");
}

}  // namespace
}  // namespace sprekk::testing
