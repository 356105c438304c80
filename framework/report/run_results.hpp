// A folder of results, as far as it can be read.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "framework/report/drawn_grid.hpp"
#include "framework/results/csv_table.hpp"
#include "framework/results/grid.hpp"

namespace sprekk {

/// The record, tables and fields of a run.
struct RunResults {
  /// The fields at a written time.
  struct Written {
    double time;  ///< s
    Grid matrix, fractures;
    Grid paths = {};  ///< by which fractures have grown further than the mesh knows
  };

  std::filesystem::path folder;
  std::string record;  ///< run.json
  CsvTable history, coupling, events;
  std::vector<Written> written;       ///< at most `most_times` of the written times
  std::size_t written_count = 0;      ///< the number of all written times
  std::vector<DrawnEdge> edges;       ///< of the box around the body, at the last of these times
  std::vector<std::string> problems;  ///< files that could not be read
  static constexpr std::size_t most_times = 12;
};

/// Reads a folder of results. Throws InputError when it holds no run.json; all other files may be missing. Throws
/// OtherDimension for results of another dimension than that of this program.
RunResults read_results(const std::filesystem::path& folder);

}  // namespace sprekk
