#include "framework/assembly/part.hpp"

namespace sprekk {

// Defaults of functions that most parts do not need.
Part::~Part() = default;
std::vector<std::string> Part::stabilizations() const { return {}; }
std::vector<Dependence> Part::dependences() const { return {}; }
std::vector<double> Part::switch_times() const { return {}; }
std::map<std::string, long> Part::counts() const { return {}; }
std::vector<ProfileEntry> Part::efforts() const { return {}; }

void begin_step(const std::vector<Part*>& parts, const StepTime& step) {
  for (Part* part : parts) part->evaluate_data(step);
  for (Part* part : parts) part->begin_step(step);
}

}  // namespace sprekk
