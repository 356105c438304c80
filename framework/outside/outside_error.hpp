// Failures of other programs.
#pragma once

#include <stdexcept>

namespace sprekk {

/// A program that takes part in a run has ended, does not answer or answers nonsense: no shorter step helps. The run
/// ends, with a checkpoint.
class OutsideError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace sprekk
