#include "framework/run/splitting_error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "framework/assembly/assemble_all.hpp"
#include "framework/config/data.hpp"
#include "framework/invariants.hpp"
#include "framework/output/activity.hpp"
#include "framework/schedule/gaps.hpp"
#include "framework/schedule/residual_check.hpp"

namespace sprekk {

namespace {

constexpr double of_largest = 1e-2;     // a field that has faded below this share of its past is measured by the past
constexpr double least_share = 1e-5;    // of the largest value of the unit: a field below it is as good as zero
constexpr double worth_telling = 1e-3;  // of a field
constexpr double middle_factor = -0.5;  // of a pass, between 0 and -1: the middle of those of stable drained splits
constexpr double middle_excess = std::numbers::sqrt2;  // of the distance over the error, between 1 and 2
const std::string key = "splitting_error.";

double largest_of(const Vector& values) { return values.size() > 0 ? values.lpNorm<Eigen::Infinity>() : 0; }

bool solves_in_turn(const Model& model) {
  return std::ranges::any_of(sampled_steps(model.scene().time),
                             [&](const StepTime& step) { return model.schedule().systems_in_turn(step) > 1; });
}

}  // namespace

SplittingError::SplittingError(const Model& model)
    : is_wanted_(model.scene().output.splitting_error && solves_in_turn(model)) {}

void SplittingError::begin_anew() {
  former_ = errors_;
  second_.clear();
}

void SplittingError::observe(long mesh_changes) {
  if (mesh_changes != mesh_changes_) begin_anew();
  mesh_changes_ = mesh_changes;
}

void SplittingError::before_acceptance(const Model& model, const StepTime& step) {
  if (!is_wanted_) return;
  coupled_residual_ = 0;
  bool is_split = false;
  if (model.schedule().systems_in_turn(step) > 1) {
    const std::vector<const Field*> unknowns = model.schedule().unknowns();
    Assembly assembly(unknowns, Assembly::Request::residual);
    assemble_all(assembly, model.parts(), step);
    const ResidualCheck check =
        check_residual(assembly, BlockSystem(model.mesh(), unknowns), model.scene().newton.residual);
    coupled_residual_ = check.largest;
    is_split = !check.converged;
  }
  before_.clear();
  for (const auto& field : model.fields().all()) {
    before_.push_back(field->accepted());
    if (!field->is_solved()) continue;
    double& largest = largest_[field->name()];  // also of steps that are not split
    largest = std::max({largest, largest_of(field->accepted()), largest_of(field->now())});
  }
  if (is_split && second_.empty()) second_ = before_;
}

namespace {

/// The fields that the first system of a step finds from the step before: those that are solved later, and what is kept
/// of their solution.
std::vector<std::size_t> waiting_fields(const Model& model, const StepTime& step) {
  const std::vector<const Field*> first = model.schedule().solved_first(step), all = model.schedule().unknowns();
  std::vector<std::size_t> waiting;
  const auto& fields = model.fields().all();
  const auto waits = [&](const Field* field) {
    return std::ranges::count(all, field) > 0 && std::ranges::count(first, field) == 0;
  };
  const auto waits_by_name = [&](const std::string& name) {
    return std::ranges::any_of(fields, [&](const auto& field) { return field->name() == name && waits(field.get()); });
  };
  for (std::size_t i = 0; i < fields.size(); ++i)
    if (waits(fields[i].get()) || waits_by_name(fields[i]->spec().accepted_with)) waiting.push_back(i);
  return waiting;
}

/// Whether equations may have discrete states that depend on the path to them: only equations on fractures have.
bool may_keep_states(const Model& model) { return model.mesh().fracture_cell_count() > 0; }

}  // namespace

/// The values of waiting fields with which the second solution begins.
SplittingError::Values SplittingError::waiting(const Model& model, const StepTime& step, const Values& accepted) const {
  Values values = accepted;
  if (!may_keep_states(model)) return values;
  for (const std::size_t i : waiting_fields(model, step))
    values[i] += middle_factor / (1 - middle_factor) * (accepted[i] - before_[i]);
  return values;
}

void SplittingError::after_acceptance(Model& model, const StepTime& step) {
  SPREKK_EXPECT(is_due());
  const auto& fields = model.fields().all();
  SPREKK_ASSERT(second_.size() == fields.size(), second_.size(), fields.size());
  SPREKK_ASSERT(before_.size() == fields.size(), before_.size(), fields.size());
  Values accepted;
  for (const auto& field : fields) accepted.push_back(field->accepted());
  const Values begin = waiting(model, step, accepted);
  for (std::size_t i = 0; i < fields.size(); ++i) {
    fields[i]->set(accepted[i] == before_[i] ? second_[i] : begin[i]);  // the step may not have solved for it
    fields[i]->set_accepted(second_[i]);
  }
  for (GrowStep* grow : model.growing()) grow->rest(true);
  now_doing("estimating the splitting error");
  bool is_found = false;
  try {
    is_found = model.attempt(step).converged;
  } catch (const DataError&) {  // the second solution has left what data are given for, and the step has not
  }
  for (GrowStep* grow : model.growing()) grow->rest(false);
  if (is_found) {
    compare(model, accepted);
    for (std::size_t i = 0; i < fields.size(); ++i) second_[i] = fields[i]->now();
  } else {
    ++failures_;
    begin_anew();
  }
  for (std::size_t i = 0; i < fields.size(); ++i) fields[i]->set_both(accepted[i]);
  model.rewind();
}

void SplittingError::compare(const Model& model, const std::vector<Vector>& accepted) {
  const auto& fields = model.fields().all();
  std::map<std::string, double> of_unit;
  for (std::size_t i = 0; i < fields.size(); ++i) {
    if (!fields[i]->is_solved()) continue;
    double& largest = largest_[fields[i]->name()];
    largest = std::max({largest, largest_of(accepted[i]), largest_of(fields[i]->now())});
    double& shared = of_unit[fields[i]->spec().unit];
    shared = std::max(shared, largest);
  }
  const double excess = may_keep_states(model) ? 1 : middle_excess;
  error_ = 0;
  for (std::size_t i = 0; i < fields.size(); ++i) {
    if (!fields[i]->is_solved()) continue;
    const std::string name = fields[i]->name();
    const double scale = std::max({largest_of(accepted[i]), largest_of(fields[i]->now()), of_largest * largest_[name],
                                   least_share * of_unit[fields[i]->spec().unit]});
    const double distance = largest_of(fields[i]->now() - accepted[i]) / excess;
    const auto former = former_.find(name);
    double& error = errors_[name];
    error = (former == former_.end() ? 0 : former->second) + (scale > 0 ? distance / scale : 0);
    if (error <= error_) continue;
    error_ = error;
    worst_field_ = name;
  }
}

void SplittingError::note_step(Notes& notes) const {
  if (error_ > worth_telling)
    notes.add("splitting error",
              fmt::format("solving in turn without iterating has an error that is estimated at {:.2g} of the largest "
                          "value of {} (the systems of a step do not agree: a residual is {:.2g} of its terms) put the "
                          "solves into an 'iterate', or take smaller steps",
                          error_, worst_field_, coupled_residual_),
              error_);
  if (failures_ > 0)
    notes.add("splitting error not found",
              fmt::format("the error of solving in turn could not be estimated in {} steps (a further pass did not "
                          "converge) put the solves into an 'iterate'",
                          failures_),
              failures_);
}

std::vector<Quantity> SplittingError::quantities() const {
  if (!is_wanted_) return {};
  return {{"splitting_error", "1", error_}, {"coupled_residual", "1", coupled_residual_}};
}

namespace {

void save_numbers(const std::string& what, const std::map<std::string, double>& numbers,
                  std::map<std::string, Vector>& state) {
  for (const auto& [name, number] : numbers) state[key + what + name] = Vector::Constant(1, number);
}

void restore_numbers(const std::string& what, const std::map<std::string, Vector>& state,
                     std::map<std::string, double>& numbers) {
  for (const auto& [name, value] : state)
    if (name.starts_with(key + what) && value.size() == 1) numbers[name.substr((key + what).size())] = value[0];
}

const std::string of_largest_value = "largest.", of_former = "former.", of_error = "error.", of_field = "second.",
                  of_count = "failures";

}  // namespace

void SplittingError::save(const Model& model, std::map<std::string, Vector>& state) const {
  if (!is_wanted_) return;
  save_numbers(of_largest_value, largest_, state);
  save_numbers(of_former, former_, state);
  save_numbers(of_error, errors_, state);
  state[key + of_count] = Vector::Constant(1, failures_);
  const auto& fields = model.fields().all();
  for (std::size_t i = 0; i < second_.size(); ++i) state[key + of_field + fields[i]->name()] = second_[i];
}

void SplittingError::restore(const Model& model, const std::map<std::string, Vector>& state) {
  restore_numbers(of_largest_value, state, largest_);
  restore_numbers(of_former, state, former_);
  restore_numbers(of_error, state, errors_);
  if (const auto count = state.find(key + of_count); count != state.end() && count->second.size() == 1)
    failures_ = static_cast<int>(count->second[0]);
  Values second;
  for (const auto& field : model.fields().all()) {
    const auto value = state.find(key + of_field + field->name());
    if (value == state.end() || value->second.size() != field->size()) return;
    second.push_back(value->second);
  }
  second_ = std::move(second);
}

}  // namespace sprekk
