#include "framework/compare/compared_run.hpp"

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
  return run;
}

}  // namespace sprekk
