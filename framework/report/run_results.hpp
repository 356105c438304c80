// A folder of results, as far as it can be read.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "framework/results/csv_table.hpp"
#include "framework/results/grid.hpp"

namespace sprekk {

struct RunResults {
  struct Written {
    double time;  ///< s
    Grid matrix, fractures;
  };

  std::filesystem::path folder;
  std::string record;  ///< run.json
  CsvTable history, coupling;
  std::vector<Written> written;       ///< at most `most_times` of the written times
  std::size_t written_count = 0;      ///< all of them
  std::vector<std::string> problems;  ///< files that could not be read
  static constexpr std::size_t most_times = 12;
};

/// Throws InputError when the folder holds no run.json; anything else may be missing.
RunResults read_results(const std::filesystem::path& folder);

}  // namespace sprekk
