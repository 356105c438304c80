// One row of the table that shows where the time of a run went.
#pragma once

#include <string>

namespace sprekk {

/// One piece of work.
struct ProfileEntry {
  std::string name;        ///< of the object: "pore: discretization", "rock+pore: factorization"
  long calls = 0;          ///< how often it did its work
  long reuses = 0;         ///< how often a kept result was used instead
  long skips = 0;          ///< how often nothing was needed at all
  double seconds = 0;      ///< own time, without that of work timed inside, so that all entries add up
  bool is_solver = false;  ///< a factorization (with its ordering) or back-solves of a linear system
};

}  // namespace sprekk
