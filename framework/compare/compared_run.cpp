#include "framework/compare/compared_run.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "framework/config/input_error.hpp"
#include "framework/config/text_file.hpp"

namespace sprekk {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

json part(const json& whole, const char* key) {
  return whole.contains(key) && whole[key].is_object() ? whole[key] : json::object();
}

RunCost cost_of(const json& record) {
  const json counters = part(record, "counters"), timings = part(record, "timings");
  RunCost cost;
  cost.steps = counters.value("steps accepted", 0L);
  cost.rejected = counters.value("steps rejected", 0L);
  cost.iterations = counters.value("iterations", 0L);
  cost.factorizations = counters.value("linear: factorizations", 0L);
  cost.cells = counters.value("mesh: cells", 0L);
  cost.fracture_cells = counters.value("mesh: fracture cells", 0L);
  cost.processor = timings.value("processor: set-up", 0.0) + timings.value("processor: steps and output", 0.0);
  cost.seconds = record.value("seconds", 0.0);
  return cost;
}

/// A history that has lost rows, or was changed by hand, would be compared as far as it can be read.
void require_sound(const CsvTable& history, long steps, const fs::path& file) {
  const std::vector<double> times = history.numbers("time");
  const auto refuse = [&](const std::string& why) {
    throw InputError({file.string()}, "this is not the history of its run", why, "run the scene again");
  };
  if (times.empty() && steps > 0) refuse("it has no row, and run.json has accepted steps");
  for (std::size_t row = 0; row < times.size(); ++row)
    if (!std::isfinite(times[row]) || (row > 0 && times[row] < times[row - 1]))
      refuse(fmt::format("the time in its row {} is no number, or goes back", row + 1));
}

}  // namespace

ComparedRun read_compared_run(const fs::path& folder) {
  const std::string name = (folder / "").parent_path().string();
  if (!fs::is_directory(folder))
    throw InputError({name}, "this is no folder of results", fs::exists(folder) ? "it is a file" : "it does not exist",
                     "give the folders that 'sprekk run' has named");
  const fs::path file = folder / "run.json";
  if (!fs::is_regular_file(file))
    throw InputError({name}, "this is no folder of results", "it has no run.json",
                     fs::is_regular_file(folder / "sweep.json") ? "give the folders of single runs in it"
                                                                : "give the folders that 'sprekk run' has named");
  ComparedRun run;
  run.name = name;
  run.record = read_text_file(file.string(), file.string());
  const json record = json::parse(run.record, nullptr, false);
  if (!record.is_object())
    throw InputError({file.string()}, "this is not the record of a run", "it is damaged, or another file");
  run.history = CsvTable::read(folder / "history.csv");
  run.matrix = read_index(folder / "matrix.pvd");
  run.fractures = read_index(folder / "fractures.pvd");
  run.paths = read_index(folder / "paths.pvd");
  const json end = part(record, "exit");
  const int code = end.value("code", -1);
  run.is_done = code == 0;
  run.ending = code == -1 ? "still running, or ended without a word" : end.value("reason", "");
  run.cost = cost_of(record);
  require_sound(run.history, run.cost.steps, folder / "history.csv");
  return run;
}

}  // namespace sprekk
