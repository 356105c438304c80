// The fallback of an iteration whose passes fail: it solves for all of its unknowns together.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "framework/schedule/newton.hpp"
#include "framework/schedule/schedule_context.hpp"

namespace sprekk {

/// Solves for all unknowns of an iteration at once by Newton's method, after passes have not converged. The answer is
/// that of converged passes. A note says why and in how many steps, and coupling.csv has the iterations under
/// "fallback".
class FallbackSolve {
 public:
  FallbackSolve(std::vector<Field*> unknowns, const NewtonOptions& newton, const LinearOptions& linear,
                const ScheduleContext& context);

  /// To be called when the iteration begins a time step. Forgets earlier attempts at this step and later ones.
  void begin(const StepTime& step);
  /// Solves, from the values that the unknowns had at begin(). `failed`: the status with which the passes have ended;
  /// the result counts their iterations, too.
  StepStatus solve(const StepTime& step, const StepStatus& failed);
  void note_step(Notes& notes, const StepTime& step) const;
  void add_counts(LinearCounts& counts) const;

 private:
  std::vector<Field*> unknowns_;
  NewtonOptions newton_;
  LinearOptions linear_;
  const Mesh& mesh_;
  std::vector<Part*> parts_;
  IterationLog log_;
  std::unique_ptr<Newton> together_;  ///< made when it is needed: it holds a factorization of all equations
  std::vector<Vector> start_;
  std::optional<StepTime> used_in_;  ///< the last step that it has solved
  std::string why_;
};

}  // namespace sprekk
