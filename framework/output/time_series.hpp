// The index file (.pvd) that tells ParaView which file belongs to which time.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace sprekk {

/// Writes an index file, entry by entry.
class TimeSeries {
 public:
  /// A written file and its time.
  struct Entry {
    double time;       ///< s
    std::string file;  ///< relative to the index file
  };

  /// A new series; the file appears with the first entry.
  explicit TimeSeries(std::filesystem::path pvd) : pvd_(std::move(pvd)) {}

  /// Continues the series in `pvd` after `time`: its entries up to then are kept; a missing file is an empty series.
  /// Throws InputError if the file is not an index that this class wrote.
  static TimeSeries continued(std::filesystem::path pvd, double time);

  /// Appends an entry and rewrites the index, which is valid XML at any moment. Entries of the same time or later are
  /// replaced.
  void add(double time, const std::string& file);

  const std::vector<Entry>& entries() const { return entries_; }

 private:
  std::filesystem::path pvd_;
  std::vector<Entry> entries_;
};

}  // namespace sprekk
