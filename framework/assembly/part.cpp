#include "framework/assembly/part.hpp"

namespace sprekk {

// Defaults of functions that most parts do not need.
Part::~Part() = default;
std::vector<Dependence> Part::dependences() const { return {}; }
std::vector<double> Part::switch_times() const { return {}; }

void begin_step(const std::vector<Part*>& parts, const StepTime& step) {
  for (Part* part : parts) part->evaluate_data(step);
  for (Part* part : parts) part->begin_step(step);
}

}  // namespace sprekk
