// Whether a run has lost or made what it should conserve.
#pragma once

#include <map>
#include <string>

#include "framework/scene/model.hpp"

namespace sprekk {

/// Compares the error of each balance with the largest throughput that it has had so far.
class Books {
 public:
  /// To be called on all processes with the state that is about to be accepted.
  void note_step(const Model& model, Notes& notes);

  /// What it keeps, for checkpoints.
  void save(std::map<std::string, Vector>& state) const;
  void restore(const std::map<std::string, Vector>& state);

 private:
  std::map<std::string, double> throughput_;
};

}  // namespace sprekk
