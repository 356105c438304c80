#include "framework/schedule/jacobi_step.hpp"

#include <algorithm>
#include <map>

namespace sprekk {

StepStatus JacobiStep::run(const StepTime& step) {
  std::vector<Vector> begin;
  for (const auto& field : fields_.all()) begin.push_back(field->now());
  std::map<std::size_t, Vector> found;
  StepStatus status{true, "", 0};
  for (const auto& inner : steps()) {
    const StepStatus its = inner->run(step);
    status.iterations = std::max(status.iterations, its.iterations);
    status.of_newton = std::max(status.of_newton, its.effort());
    if (!its.converged) return {false, inner->describe() + ": " + its.reason, status.iterations, its.retry_dt};
    for (std::size_t i = 0; i < begin.size(); ++i) {
      Field& field = *fields_.all()[i];
      if (field.now() == begin[i]) continue;
      found[i] = field.now();
      field.set(begin[i]);
    }
  }
  for (auto& [i, values] : found) fields_.all()[i]->set(std::move(values));
  return status;
}

}  // namespace sprekk
