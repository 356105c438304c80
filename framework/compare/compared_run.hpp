// A folder of results, as far as it is compared with others.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "framework/results/csv_table.hpp"
#include "framework/results/grid.hpp"

namespace sprekk {

/// What a run has cost, from its record; a run that has not ended has no costs there.
struct RunCost {
  long steps = 0, rejected = 0, iterations = 0, factorizations = 0, cells = 0, fracture_cells = 0;
  double processor = 0, seconds = 0;  ///< s: processor time and wall time
};

/// The results of a run.
struct ComparedRun {
  std::string name;    ///< its folder, as the user gave it
  std::string record;  ///< run.json
  CsvTable history;
  std::vector<Snapshot> matrix, fractures, paths;  ///< files of fields at written times
  bool is_done = false;
  std::string ending;  ///< "done", or why the run has no end
  RunCost cost;
};

/// Reads the results of a run. Throws InputError when the folder holds none.
ComparedRun read_compared_run(const std::filesystem::path& folder);

}  // namespace sprekk
