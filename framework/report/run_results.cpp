#include "framework/report/run_results.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "framework/config/input_error.hpp"
#include "framework/config/other_dimension.hpp"
#include "framework/config/text_file.hpp"
#include "framework/report/drawn_grid.hpp"
#include "framework/results/results_dimension.hpp"
#include "framework/types.hpp"

namespace sprekk {
namespace fs = std::filesystem;
namespace {

std::vector<Snapshot> index(RunResults& results, const char* file) {
  try {
    return read_index(results.folder / file);
  } catch (const InputError& error) {
    results.problems.emplace_back(error.what());
    return {};
  }
}

Grid grid(RunResults& results, const fs::path& file) {
  try {
    return drawn_grid(file);
  } catch (const std::runtime_error& error) {
    results.problems.emplace_back(error.what());
    return {};
  }
}

}  // namespace

RunResults read_results(const fs::path& folder) {
  RunResults results;
  results.folder = folder;
  const fs::path record = folder / "run.json";
  if (!fs::is_regular_file(record))
    throw InputError({folder.string()}, "this is no folder of results", "it has no run.json",
                     "give the folder that 'sprekk run' has named");
  if (const int wanted = dimension_of_results(folder); wanted != dimension) throw OtherDimension{wanted};
  results.record = read_text_file(record.string(), record.string());
  if (!nlohmann::json::parse(results.record, nullptr, false).is_object())
    throw InputError({record.string()}, "this is not the record of a run", "it is damaged, or another file");
  results.history = CsvTable::read(folder / "history.csv");
  results.coupling = CsvTable::read(folder / "coupling.csv");
  results.events = CsvTable::read(folder / "events.csv");
  const std::vector<Snapshot> matrix = index(results, "matrix.pvd"), fractures = index(results, "fractures.pvd"),
                              paths = index(results, "paths.pvd");
  results.written_count = matrix.size();
  fs::path last;
  for (const Snapshot& snapshot : evenly_chosen(matrix, RunResults::most_times)) {
    RunResults::Written written{snapshot.time, grid(results, snapshot.file), {}};
    const auto of_this_time = [&](const std::vector<Snapshot>& all) {
      const auto found = std::ranges::find(all, snapshot.time, &Snapshot::time);
      return found != all.end() ? grid(results, found->file) : Grid{};
    };
    written.fractures = of_this_time(fractures);
    written.paths = of_this_time(paths);
    if (written.matrix.cell_count() == 0) continue;
    results.written.push_back(std::move(written));
    last = snapshot.file;
  }
  if (!last.empty()) results.edges = drawn_edges(last);
  return results;
}

}  // namespace sprekk
