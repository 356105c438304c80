// How far two runs are apart.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "framework/compare/compared_run.hpp"
#include "framework/compare/field_difference.hpp"
#include "framework/compare/history_difference.hpp"
#include "framework/compare/path_difference.hpp"

namespace sprekk {

/// All differences of a run from another one.
struct RunDifference {
  const ComparedRun* run = nullptr;
  const ComparedRun* other = nullptr;
  CommonTime time{};  ///< of the histories, s
  std::vector<HistoryDifference> histories;
  std::optional<double> written;            ///< s: the last time at which both have written fields
  GridDifference matrix, fractures;         ///< at that time
  std::vector<PathDifference> paths;        ///< at that time
  std::vector<std::string> fracture_names;  ///< by number
  std::vector<std::string> remarks;         ///< what has not been compared, and why

  std::size_t compared() const {
    return histories.size() + matrix.fields.size() + fractures.fields.size() + paths.size();
  }
};

/// Compares two runs. `only`: the quantities to compare ("slip.t", also "paths"), all if there are none. Throws
/// InputError when they have nothing in common that could be compared.
RunDifference run_difference(const ComparedRun& run, const ComparedRun& other, const std::vector<std::string>& only);

/// The lines of the fractures of a run at a written time, by their number.
std::vector<Polyline> polylines_at(const ComparedRun& run, double time);

/// A difference as a share of the scale of its quantity.
struct Deviation {
  std::string quantity;  ///< "slip.t", "rock.displacement as a field", "path of crack"
  double share = 0;
};
/// All differences, the largest first. That of a field is where it is largest.
std::vector<Deviation> deviations(const RunDifference& difference);

}  // namespace sprekk
