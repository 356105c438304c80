// The last resort of an iteration: its unknowns are found together.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "framework/schedule/newton.hpp"
#include "framework/schedule/schedule_context.hpp"

namespace sprekk {

/// Solves for all unknowns of an iteration at once, by Newton's method, where passes have not converged. The solution
/// of all equations is what passes would have converged to, so it is no other answer. It stays visible: a note says
/// why and in how many steps, and coupling.csv has the iterations under "fallback".
class FallbackSolve {
 public:
  FallbackSolve(std::vector<Field*> unknowns, const NewtonOptions& newton, const LinearOptions& linear,
                const ScheduleContext& context);

  /// The iteration begins a time step; what is known of this step and of later ones is forgotten.
  void begin(const StepTime& step);
  /// From the values that the unknowns had at begin(). `failed`: how the passes have ended. The status counts their
  /// iterations as well.
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
