// What a study says about its runs together: sweep.csv, sweep.json and sweep.svg.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "framework/study/run_state.hpp"
#include "framework/study/study.hpp"

namespace sprekk {

class Comparison {
 public:
  /// Looks columns up in the models of the runs, before any has been run. Throws InputError for one that no run has.
  explicit Comparison(const Study& study);

  /// sweep.json without figures, so that a sweep that is cut short can go on.
  void write_record(const std::filesystem::path& folder, const std::vector<RunState>& states) const;
  /// All three files. Figures are of runs that are done; curves are of all that there is.
  void write(const std::filesystem::path& folder, const std::vector<RunState>& states) const;
  /// The figures as a table for the terminal.
  std::string text(const std::filesystem::path& folder, const std::vector<RunState>& states) const;

 private:
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
