#include "framework/schedule/subcycle_step.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "framework/invariants.hpp"

namespace sprekk {

Spec SubcycleOptions::spec() {
  Spec spec("subcycle", "The steps inside take several smaller time steps; all other fields wait.");
  spec.integer("count", count, {.range = between(1, 1000000), .doc = "Substeps of each step.", .required = true});
  return spec;
}

SubcycleStep::SubcycleStep(const SubcycleOptions& options, std::unique_ptr<ScheduleStep> inside,
                           const ScheduleContext& context)
    : options_(options), inside_(std::move(inside)), parts_(context.parts) {
  for (const Field* field : inside_->unknowns()) fields_.push_back(&context.fields.at(field->name()));
  const std::size_t solved = fields_.size();
  for (const auto& field : context.fields.all())
    for (std::size_t i = 0; i < solved; ++i)
      if (field->spec().accepted_with == fields_[i]->name()) fields_.push_back(field.get());
}

std::string SubcycleStep::describe() const { return fmt::format("subcycle {}", options_.count); }

StepStatus SubcycleStep::run(const StepTime& step) {
  std::vector<Vector> start;
  for (const Field* field : fields_) start.push_back(field->accepted());
  const auto put_back = [&] {
    SPREKK_ASSERT(start.size() == fields_.size(), start.size(), fields_.size());
    for (std::size_t i = 0; i < fields_.size(); ++i) fields_[i]->set_accepted(start[i]);
  };
  StepStatus status;
  try {
    status = take_substeps(step);
  } catch (...) {  // a datum has no value in a substep: fields are put back to the start of the step
    put_back();
    throw;
  }
  put_back();
  begin_step(parts_, step);
  return status;
}

StepStatus SubcycleStep::take_substeps(const StepTime& step) {
  StepStatus status{true, "", 0};
  for (int i = 0; i < options_.count && status.converged; ++i) {
    StepTime substep;
    substep.start = step.start + step.dt * i / options_.count;
    substep.end = i + 1 == options_.count ? step.end : step.start + step.dt * (i + 1) / options_.count;
    substep.dt = step.dt / options_.count;
    SPREKK_ASSERT(substep.end > substep.start && substep.end <= step.end, substep.start, substep.end, step.end);
    begin_step(parts_, substep);
    const StepStatus inner = inside_->run(substep);
    status.iterations = std::max(status.iterations, inner.iterations);
    status.of_newton = std::max(status.of_newton, inner.effort());
    status.converged = inner.converged;
    if (!inner.converged) status.reason = fmt::format("substep {}: {}", i + 1, inner.reason);
    for (Field* field : fields_) field->accept();
  }
  return status;
}

}  // namespace sprekk
