// The comparison of the runs of a study: sweep.csv, sweep.json, sweep.svg and sweep.html, and quantiles.csv of samples.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "framework/picture/line_plot.hpp"
#include "framework/study/quantiles.hpp"
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
  /// Writes all files. Figures are those of runs that are done; curves are those of all runs with results.
  void write(const std::filesystem::path& folder, const std::vector<RunState>& states) const;
  /// The figures as a table for the terminal, or their quantiles where there are samples.
  std::string text(const std::filesystem::path& folder, const std::vector<RunState>& states) const;

 private:
  /// The figures of one run.
  struct Row {
    std::vector<double> figures, deviations;  ///< NaN where there is none
  };
  std::vector<Row> rows(const std::filesystem::path& folder, const std::vector<RunState>& states) const;
  std::string csv(const std::vector<Row>& rows, const std::vector<RunState>& states) const;
  std::string record(const std::vector<Row>& rows, const std::vector<RunState>& states) const;
  /// How a figure of the samples of one combination of the other values is distributed.
  struct Spread {
    std::string samples_of;
    std::size_t figure;
    Distribution distribution;
  };
  std::vector<Spread> spreads(const std::vector<Row>& rows) const;
  std::string quantiles(const std::vector<Spread>& spreads) const;
  using Table = std::vector<std::vector<std::string>>;
  Table figure_table(const std::vector<Row>& rows, const std::vector<RunState>& states) const;
  Table spread_table(const std::vector<Spread>& spreads) const;
  std::vector<Panel> panels(const std::filesystem::path& folder, const std::vector<RunState>& states) const;
  std::string page(const std::filesystem::path& folder, const std::vector<Row>& rows,
                   const std::vector<RunState>& states) const;
  std::string picture(const std::filesystem::path& folder, const std::vector<RunState>& states) const;

  const Study& study_;
  ColumnNames plot_;
  std::vector<Figure> figures_;
};

}  // namespace sprekk
