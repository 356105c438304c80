#include "framework/assembly/history/history.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "framework/formula/program.hpp"
#include "framework/invariants.hpp"

namespace sprekk {
namespace {

using OfAll = std::array<double, formula::most_derivatives>;

/// What is remembered where nothing has been yet.
double nothing(Recall recall) {
  if (recall == Recall::sum) return 0;
  return recall == Recall::largest ? std::numeric_limits<double>::lowest() : std::numeric_limits<double>::max();
}

}  // namespace

std::unique_ptr<History> History::find(const HistoryOptions& options, const StateVariables& followed,
                                       const std::vector<Place>& places, const std::vector<char>& inhabited) {
  if (options.all().empty()) return nullptr;
  return std::unique_ptr<History>(new History(options.all(), followed, places, inhabited));
}

History::History(const std::vector<Remembered>& remembered, const StateVariables& followed,
                 const std::vector<Place>& places, const std::vector<char>& inhabited)
    : remembered_(remembered), followed_(&followed), inhabited_(inhabited), places_(places) {
  for (const Remembered& each : remembered_) {
    variables_.push_back(each.variable);
    followed_by_.push_back(each.expression.is_constant() ? 0 : variables_named(each.expression, {}, followed));
  }
}

void History::add_fields(FieldStore& fields, const Mesh& mesh, Location location, const std::string& owner,
                         const std::string& accepted_with) {
  for (const Remembered& each : remembered_) {
    const std::string& name = each.variable.name;
    if (fields.has(owner + "." + name))
      throw InputError(each.origin, quoted(name) + " cannot be a variable of 'history'",
                       "'" + owner + "' has a field of this name", "take another one");
    // Both stages of a step begin with the same extreme and the same path; sums over time are those of the stages.
    const bool is_over_time = each.recall == Recall::sum && each.rate < 0;
    Field& field = fields.add(mesh, {.owner = owner,
                                     .name = name,
                                     .location = location,
                                     .role = Role::derived(),
                                     .unit = each.variable.unit,
                                     .doc = "Remembered: " + each.variable.doc,
                                     .accepted_with = accepted_with,
                                     .is_path_dependent = !is_over_time});
    field.set_both(Vector::Constant(field.size(), each.start.value_or(nothing(each.recall))));
    fields_.push_back(&field);
  }
}

bool History::follows(std::size_t k, std::size_t j) const {
  return (followed_by_[k] >> j & 1U) != 0 || remembered_[k].rate == static_cast<int>(j);
}

void History::require_named(std::uint32_t named, const std::string& parameters) const {
  for (std::size_t k = 0; k < remembered_.size(); ++k)
    if ((named >> k & 1U) == 0)
      throw InputError(remembered_[k].origin, quoted(variables_[k].name) + " of 'history' has no effect",
                       "no formula names it, and laws that are no formulas have no memory",
                       "name it in a formula of " + parameters + ", or remove it");
}

void History::show(const StepToRemember& step, const StateAt& state_at) {
  if (is_held_ || step.end == step.start) return;  // the state is still to be found
  for (Place& at : places_) at.t = step.start;
  OfAll state{};
  const std::span<double> followed(state.data(), followed_->size());
  for (std::size_t k = 0; k < fields_.size(); ++k) {
    const double none_yet = nothing(remembered_[k].recall);
    if (remembered_[k].recall == Recall::sum || (fields_[k]->accepted().array() != none_yet).all()) continue;
    Vector now = fields_[k]->now();
    for (int i = 0; i < now.size(); ++i) {
      if (fields_[k]->accepted()[i] != none_yet) continue;
      now[i] = 0;
      if (!counts(i)) continue;
      state_at(i, followed);
      now[i] = value(k, i, followed, {}, Memory::none);
    }
    fields_[k]->set(std::move(now));
  }
}

void History::begin_step(const StepToRemember& step, const StateAt& state_at) {
  for (Place& at : places_) at.t = step.start;
  // No time passes while the state at the start is found. Nor does that state depend on how it is found.
  const bool is_at_start = step.end == step.start;
  OfAll state{};
  const std::span<double> followed(state.data(), followed_->size());
  std::vector<Vector> before;
  for (std::size_t k = 0; k < fields_.size(); ++k) {
    Vector values = fields_[k]->accepted();
    const double none_yet = nothing(remembered_[k].recall);
    for (int i = 0; !is_at_start && remembered_[k].recall != Recall::sum && i < values.size(); ++i) {
      if (values[i] != none_yet || !counts(i)) continue;
      state_at(i, followed);
      values[i] = value(k, i, followed, {}, Memory::none);
    }
    if (!is_at_start && !is_held_ && values != fields_[k]->accepted()) fields_[k]->set_accepted(values);
    before.push_back(std::move(values));
  }
  for (Place& at : places_) at.t = step.end;
  const double time = is_held_ || is_at_start ? 0 : step.dt, length = step.dt;
  if (before == before_ && time == time_ && length == length_) return;
  before_ = std::move(before);
  time_ = time;
  length_ = length;
  ++version_;
}

void History::hold(bool is_held) {
  is_held_ = is_held;
  if (is_held) {
    time_ = length_ = 0;
    for (Field* field : fields_) field->set(field->accepted());  // show() has seen a state that is still to be found
  }
  ++version_;
}

void History::remember(const StateAt& state_at) {
  SPREKK_EXPECT(before_.size() == fields_.size(), before_.size(), fields_.size());
  OfAll state{};
  const std::span<double> followed(state.data(), followed_->size());
  for (std::size_t k = 0; k < fields_.size(); ++k) {
    if (is_held_ && remembered_[k].rate < 0) continue;
    Vector values(before_[k].size());
    for (int i = 0; i < values.size(); ++i) {
      values[i] = 0;
      if (!counts(i)) continue;
      state_at(i, followed);
      values[i] = value(k, i, followed, {}, Memory::kept);
    }
    fields_[k]->set(std::move(values));
  }
}

void History::output(std::vector<OutputField>& fields) const {
  for (const Field* field : fields_)
    fields.push_back({field->name(), field->spec().unit, field->spec().location, 1, field->now()});
}

double History::value(std::size_t k, int place, std::span<const double> state, std::span<double> by,
                      Memory memory) const {
  const Remembered& remembered = remembered_[k];
  const bool is_kept = memory == Memory::kept && !before_.empty();
  const double first = remembered.start.value_or(nothing(remembered.recall)),
               before = is_kept ? before_[k][place] : first;
  const double now =
      value_at_state(remembered.expression, places_[static_cast<std::size_t>(place)], *followed_, state, by);
  if (remembered.recall != Recall::sum) {
    // Where both are equal the state is taken to go on as it came.
    const bool is_reached = remembered.recall == Recall::largest ? now >= before : now <= before;
    if (!is_reached) std::ranges::fill(by, 0);
    return is_reached ? now : before;
  }
  const bool is_over_time = remembered.rate < 0;
  const double length = !is_kept ? 0 : is_over_time ? time_ : length_;
  const double step = is_over_time ? length : length * state[static_cast<std::size_t>(remembered.rate)];
  for (double& each : by) each *= step;
  if (!is_over_time && !by.empty()) by[static_cast<std::size_t>(remembered.rate)] += length * now;
  return before + step * now;
}

TakesHistory::TakesHistory(const History& history, const StateVariables& variables, std::uint32_t named)
    : history_(&history), all_(&joined(variables, history.variables())), own_(variables.size()) {
  SPREKK_EXPECT(all_->size() <= formula::most_derivatives, all_->size());
  std::vector<std::string> known;
  for (const StateVariable& variable : variables) known.push_back(variable.name);
  for (const StateVariable& variable : history.followed()) {
    const auto found = std::ranges::find(known, variable.name);
    place_.push_back(found == known.end() ? -1 : static_cast<int>(found - known.begin()));
  }
  for (std::size_t k = 0; k < history.variables().size(); ++k) {
    if ((named >> (own_ + k) & 1U) == 0) continue;
    taken_.push_back(k);
    for (std::size_t j = 0; j < place_.size(); ++j) {
      if (!history.follows(k, j)) continue;
      if (place_[j] < 0)
        throw InputError(history.remembered(k).origin,
                         "a formula names " + quoted(history.variables()[k].name) + ", which follows " +
                             quoted(history.followed()[j].name),
                         "the formula may follow " + listed(known) + " alone",
                         "remember an expression of these, or name it in another formula");
      followed_ |= 1U << static_cast<std::uint32_t>(place_[j]);
    }
  }
}

std::uint32_t TakesHistory::taken() const {
  std::uint32_t bits = 0;
  for (const std::size_t k : taken_) bits |= 1U << k;
  return bits;
}

double TakesHistory::at(const Data& data, const Place& at, int place, std::span<const double> values,
                        std::span<double> by, Memory memory) const {
  const std::size_t followed = place_.size();
  OfAll state{}, all{}, by_all{};
  std::array<OfAll, formula::most_derivatives> by_state{};
  std::ranges::copy(values.first(own_), all.begin());
  for (std::size_t j = 0; j < followed; ++j)
    if (place_[j] >= 0) state[j] = values[static_cast<std::size_t>(place_[j])];
  for (const std::size_t k : taken_)
    all[own_ + k] = history_->value(k, place, std::span<const double>(state.data(), followed),
                                    std::span<double>(by_state[k].data(), by.empty() ? 0 : followed), memory);
  const std::size_t count = all_->size();
  const double value = value_at_state(data, at, *all_, std::span<const double>(all.data(), count),
                                      std::span<double>(by_all.data(), by.empty() ? 0 : count));
  std::copy_n(by_all.begin(), std::min(by.size(), own_), by.begin());
  for (const std::size_t k : taken_)
    for (std::size_t j = 0; j < followed && !by.empty(); ++j)
      if (place_[j] >= 0) by[static_cast<std::size_t>(place_[j])] += by_all[own_ + k] * by_state[k][j];
  return value;
}

}  // namespace sprekk
