#include "framework/run/effort.hpp"

#include "framework/assembly/counts_work.hpp"

namespace sprekk {

void Effort::retire(const Model& model) {
  model.schedule().add_counts(linear_);
  for (const auto* part : parts_with<CountsWork>(model.parts())) {
    for (const auto& [name, count] : part->counts()) counts_[name] += count;
    for (const Profile::Entry& effort : part->efforts()) {
      Profile::Entry& entry = efforts_.at(effort.name);
      entry.calls += effort.calls;
      entry.reuses += effort.reuses;
      entry.skips += effort.skips;
      entry.seconds += effort.seconds;
      entry.is_solver = effort.is_solver;
    }
  }
}

void Effort::retired(const Model& model, const Model* settled) {
  retire(model);
  if (!settled) return;
  LinearCounts settling;
  settled->schedule().add_counts(settling);
  settling_seconds_ += settling.seconds();
}

void Effort::finish(const Model& last, RunRecord& record, Profile& profile) {
  retire(last);
  record.counters["steps rejected"] = rejected_;
  record.counters["iterations"] = iterations_;
  record.counters["linear: orderings"] = linear_.orderings;
  record.counters["linear: factorizations"] = linear_.factorizations;
  record.counters["linear: factorizations reused"] = linear_.reused;
  record.counters["linear: solves"] = linear_.solves;
  record.counters["linear: iterations"] = linear_.iterations;
  record.counters["linear: condensed factorizations"] = linear_.condensed;
  record.counters["linear: columns condensed"] = linear_.columns;
  record.counters["assembly: patterns"] = linear_.patterns;
  record.counters["assembly: states"] = linear_.assemblies;
  for (const auto& [name, count] : counts_) record.counters[name] += count;
  split_times(profile);
}

void Effort::split_times(Profile& profile) const {
  Profile::Entry& steps = profile.at("steps");
  const auto move = [&](const Profile::Entry& entry) {
    profile.at(entry.name) = entry;
    steps.seconds -= entry.seconds;
  };
  move({"linear: ordering", linear_.orderings, 0, 0, linear_.seconds_ordering, true});
  move({"linear: factorization", linear_.factorizations, linear_.reused, 0, linear_.seconds_factor, true});
  move({"linear: solve", linear_.solves, 0, 0, linear_.seconds_solve, true});
  steps.seconds += settling_seconds_;
  if (settling_seconds_ > 0) profile.at("change of mesh").seconds -= settling_seconds_;
  for (const Profile::Entry& entry : efforts_.entries()) move(entry);
}

}  // namespace sprekk
