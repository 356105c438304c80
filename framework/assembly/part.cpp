#include "framework/assembly/part.hpp"

#include "framework/field/ownership.hpp"
#include "framework/invariants.hpp"
#include "framework/parallel/parallel.hpp"

namespace sprekk {

// Defaults of functions that most parts do not need.
Part::~Part() = default;
std::vector<Dependence> Part::dependences() const { return {}; }
std::vector<double> Part::switch_times() const { return {}; }

void begin_step(const std::vector<Part*>& parts, const StepTime& step) {
  for (Part* part : parts) part->evaluate_data(step);
  for (Part* part : parts) part->begin_step(step);
}

void add_totals(Balance& balance, const Mesh& mesh, const Field& cumulative) {
  const int components = cumulative.spec().components;
  SPREKK_EXPECT(components == 2 || components == 3, cumulative.name(), components);
  Vector totals = Vector::Zero(4);
  if (parallel::is_root()) totals << balance.stored, balance.injected, balance.outflow, balance.throughput;
  for (int i = 0; i < cumulative.entities(); ++i) {
    if (!is_owned(mesh, cumulative.spec().location, i)) continue;
    const auto of_entity = cumulative.now().segment(components * i, components);
    totals[0] += of_entity[0];
    if (components == 3) totals[1] += of_entity[1];
    totals[2] += of_entity[components - 1];
    totals[3] += of_entity.lpNorm<1>();
  }
  parallel::sum(totals);
  balance.stored = totals[0];
  balance.injected = totals[1];
  balance.outflow = totals[2];
  balance.throughput = totals[3];
}

}  // namespace sprekk
