// The comparison of the runs of a study: sweep.csv, sweep.json and sweep.svg.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "framework/study/run_state.hpp"
#include "framework/study/study.hpp"

namespace sprekk {

/// Writes the table, the record and the picture of a study.
class Comparison {
 public:
  /// Looks the columns up in the models of the runs, before any run has begun. Throws InputError for a column that no
  /// run has.
  explicit Comparison(const Study& study);

  /// Writes sweep.json without figures, so that a sweep that is interrupted can go on.
  void write_record(const std::filesystem::path& folder, const std::vector<RunState>& states) const;
  /// Writes all three files. Figures are those of runs that are done; curves are those of all runs with results.
  void write(const std::filesystem::path& folder, const std::vector<RunState>& states) const;
  /// The figures as a table for the terminal.
  std::string text(const std::filesystem::path& folder, const std::vector<RunState>& states) const;

 private:
  /// The figures of one run.
  struct Row {
    std::vector<double> figures, deviations;  ///< NaN where there is none
  };
  std::vector<Row> rows(const std::filesystem::path& folder, const std::vector<RunState>& states) const;
  std::string csv(const std::vector<Row>& rows, const std::vector<RunState>& states) const;
  std::string record(const std::vector<Row>& rows, const std::vector<RunState>& states) const;
  std::string picture(const std::filesystem::path& folder, const std::vector<RunState>& states) const;

  const Study& study_;
  ColumnNames plot_;
  std::vector<Figure> figures_;
};

}  // namespace sprekk
