// `time: {stop_when_steady}` ends a run when nothing would change any more, and not before.
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/input/program.hpp"

namespace sprekk::testing {
namespace {

/// A square of diffusivity 1 m^2/s, with a pressure of 1 Pa at the left and a well; what it forgets falls by e every
/// 0.4 s.
nlohmann::json results_of(const std::string& rate, const std::vector<std::string>& settings, const Folder& folder) {
  std::ofstream(folder / "scene.yaml")
      << "geometry: {box: {x: [0 m, 1 m], y: [0 m, 1 m]}}\nmesh: {kind: structured, cells: [4, 4]}\n"
         "components: {pore: {type: matrix_flow/mpfa, permeability: 1 m^2, viscosity: 1 Pa*s, storage: 1 1/Pa, "
         "boundary: "
         "{left: {pressure: 1 Pa}}, wells: {well: {at: [0.5 m, 0.5 m], rate: "
      << rate
      << "}}}}\nschedule: [{solve: pore}]\ntime: {end: 100 s, step: 0.5 s}\noutput: {fields: false, probes: {p: {of: "
         "pore.pressure, at: [1 m, 1 m]}}}\n";
  std::vector<std::string> arguments = {"run", "-q", "scene.yaml", "-o", "out"};
  for (const std::string& setting : settings) arguments.insert(arguments.end(), {"--set", setting});
  const Outcome run = sprekk_command(arguments, folder.path());
  EXPECT_EQ(run.code, 0) << run.err;
  return nlohmann::json::parse(text_of(folder / "out/run.json"));
}

TEST(Steady, RunEndsEarlyWithTheValuesOfItsEnd) {
  const Folder short_folder, whole_folder;
  const auto until_steady = results_of("1 m^2/s", {"time.stop_when_steady=1e-6"}, short_folder);
  const auto whole = results_of("1 m^2/s", {}, whole_folder);
  EXPECT_EQ(whole["counters"]["steps accepted"], 200);
  EXPECT_LT(until_steady["counters"]["steps accepted"], 50);
  EXPECT_EQ(until_steady["exit"]["reason"], "done");
  const double p = whole["results"]["p[Pa]"];
  EXPECT_NEAR(until_steady["results"]["p[Pa]"], p, 1e-6 * p);
}

TEST(Steady, WaitsForTheLastJumpOfTheData) {
  const Folder folder;
  const auto run = results_of("{value: 1 m^2/s, from: 60 s, to: 70 s}", {"time.stop_when_steady=1e-3"}, folder);
  EXPECT_GE(run["results"]["steady_since[s]"], 70);
  EXPECT_LT(run["counters"]["steps accepted"], 200);
  EXPECT_NEAR(run["results"]["fluid_injected[m^2]"], 10, 1e-9);
}

}  // namespace
}  // namespace sprekk::testing
