#include "framework/schedule/fallback_solve.hpp"

#include <fmt/format.h>

#include <utility>

#include "framework/invariants.hpp"

namespace sprekk {

FallbackSolve::FallbackSolve(std::vector<Field*> unknowns, const NewtonOptions& newton, const LinearOptions& linear,
                             const ScheduleContext& context)
    : unknowns_(std::move(unknowns)),
      newton_(newton),
      linear_(linear),
      mesh_(context.mesh),
      parts_(context.parts),
      log_(context.log) {}

void FallbackSolve::begin(const StepTime& step) {
  start_.clear();
  for (const Field* field : unknowns_) start_.push_back(field->now());
  if (used_in_ && used_in_->start >= step.start) used_in_.reset();
}

StepStatus FallbackSolve::solve(const StepTime& step, const StepStatus& failed) {
  SPREKK_EXPECT(start_.size() == unknowns_.size(), start_.size(), unknowns_.size());
  if (!together_) together_ = std::make_unique<Newton>(mesh_, unknowns_, parts_, linear_, newton_, "fallback", log_);
  for (std::size_t u = 0; u < unknowns_.size(); ++u) unknowns_[u]->set(start_[u]);
  begin_step(parts_, step);
  StepStatus status = together_->solve(step);
  status.of_newton = status.iterations;
  status.iterations += failed.iterations;
  if (!status.converged) {
    status.reason = failed.reason + "; then all at once: " + status.reason;
    return status;
  }
  used_in_ = step;
  why_ = failed.reason;
  return status;
}

void FallbackSolve::note_step(Notes& notes, const StepTime& step) const {
  if (!used_in_ || used_in_->start < step.start) return;
  together_->note_step(notes, step);
  std::string names;
  for (const Field* field : unknowns_)
    if (names.find(field->spec().owner) == std::string::npos)
      names += (names.empty() ? "" : ", ") + field->spec().owner;
  notes.add("steps solved together",
            fmt::format("passes of the 'iterate' of {} did not converge, and 'fallback: monolithic' has solved for all "
                        "of them at once, which has the answer that passes converge to (the first time since {}) solve "
                        "them in one 'solve', or help the passes; 'fallback: none' refuses such steps",
                        names, why_.substr(0, why_.find(" ("))));
}

void FallbackSolve::add_counts(LinearCounts& counts) const {
  if (together_) counts += together_->counts();
}

}  // namespace sprekk
