#include "couplers/advection/flow_course.hpp"

#include <algorithm>
#include <utility>

#include "framework/invariants.hpp"
#include "framework/round_off.hpp"

namespace sprekk::couplers {
namespace {

/// Adds `factor` times the rates at each named place.
void add_to(std::vector<FluidSource>& sums, const std::vector<FluidSource>& sources, double factor) {
  for (const FluidSource& source : sources) {
    auto sum = std::ranges::find(sums, source.name, &FluidSource::name);
    if (sum == sums.end()) sum = sums.insert(sums.end(), FluidSource{source.name, {}, source.is_shared});
    for (std::size_t i = 0; i < source.rates.size(); ++i) {
      const auto& [cell, rate] = source.rates[i];
      const bool is_next = i < sum->rates.size() && sum->rates[i].first == cell;  // as a rule
      const auto place = is_next ? sum->rates.begin() + static_cast<std::ptrdiff_t>(i)
                                 : std::ranges::find(sum->rates, cell, &std::pair<int, double>::first);
      if (place == sum->rates.end())
        sum->rates.emplace_back(cell, factor * rate);
      else
        place->second += factor * rate;
    }
  }
}

}  // namespace

double FlowCourse::shared(const Part& part, const StepTime& step) {
  const double length = std::min(part.to, step.end) - std::max(part.from, step.start);
  return length > rounding::far_above * std::min(part.to - part.from, step.dt) ? length : 0;
}

void FlowCourse::add(const StepTime& part, FluidRates rates) {
  SPREKK_EXPECT(part.end > part.start, part.start, part.end);
  std::erase_if(parts_, [&](const Part& known) { return shared(known, part) > 0; });
  parts_.push_back({part.start, part.end, std::move(rates)});
  mean_over_ = {};
}

void FlowCourse::clear() {
  parts_.clear();
  mean_over_ = {};
}

const FluidRates* FlowCourse::over(const StepTime& step) const {
  if (mean_over_.dt > 0 && mean_over_.start == step.start && mean_over_.end == step.end) return &mean_;
  const Part* only = nullptr;
  double length = 0;
  int count = 0;
  for (const Part& part : parts_)
    if (const double time = shared(part, step); time > 0) {
      only = &part;
      length += time;
      ++count;
    }
  if (count < 2) return only ? &only->rates : nullptr;
  mean_ = {Vector::Zero(only->rates.values.size())};
  for (const Part& part : parts_)
    if (const double time = shared(part, step); time > 0) {
      mean_.values += time / length * part.rates.values;
      add_to(mean_.sources, part.rates.sources, time / length);
    }
  mean_over_ = step;
  return &mean_;
}

}  // namespace sprekk::couplers
