// What the formulas of a part remember of the state, at fixed places.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "framework/assembly/history/history_options.hpp"
#include "framework/field/field_store.hpp"
#include "framework/field/output_field.hpp"

namespace sprekk {

/// Whether a formula sees what has been remembered, or is evaluated as if the run began now.
enum class Memory { kept, none };

/// A step in time, as memory has it: s.
struct StepToRemember {
  double start = 0, dt = 0, end = 0;
};

/// The variables that remember, at the places of one location. A value at the end of a step follows from the state
/// there and from the accepted value h_old: with the expression e,
///   largest: max(h_old, e),  smallest: min(h_old, e),  sum: h_old + e dt, or h_old + e (rate dt),
/// so that formulas which name it are implicit, and have derivatives by the state alone. Accepted values are in
/// derived fields, which rewinds, substeps, checkpoints and changes of the mesh treat as all others.
class History {
 public:
  /// Writes the state at a place, in the order of `followed`.
  using StateAt = std::function<void(int place, std::span<double> state)>;

  /// nullptr where the scene wants nothing to be remembered. `inhabited`: places that count, empty for all.
  static std::unique_ptr<History> find(const HistoryOptions& options, const StateVariables& followed,
                                       const std::vector<Place>& places, const std::vector<char>& inhabited = {});
  /// Adds the fields. Throws InputError where the component has a field of this name.
  void add_fields(FieldStore& fields, const Mesh& mesh, Location location, const std::string& owner,
                  const std::string& accepted_with);
  const StateVariables& followed() const { return *followed_; }  ///< by the expressions
  const StateVariables& variables() const { return variables_; }
  const Remembered& remembered(std::size_t k) const { return remembered_[k]; }
  /// Whether the k-th variable changes with the j-th of those followed.
  bool follows(std::size_t k, std::size_t j) const;
  /// Throws InputError for a variable without a bit in `named`, those that formulas name. `parameters`: which may.
  void require_named(std::uint32_t named, const std::string& parameters) const;

  /// Where nothing has been remembered yet, fields show the present values; not while a start is settled or the mesh
  /// changes.
  void show(const StepToRemember& step, const StateAt& state_at);
  void begin_step(const StepToRemember& step, const StateAt& state_at);
  /// Keeps what the state at the end of the step makes of the values.
  void remember(const StateAt& state_at);
  /// While the state is found again on another mesh no time passes and extremes stay; what moves is summed.
  void hold(bool is_held);
  /// Changes when values do that are remembered from before the step.
  std::uint64_t version() const { return version_; }
  void output(std::vector<OutputField>& fields) const;

  /// The value of the k-th variable where the state is `state`; `by`: its derivatives.
  double value(std::size_t k, int place, std::span<const double> state, std::span<double> by, Memory memory) const;

 private:
  History(const std::vector<Remembered>& remembered, const StateVariables& followed, const std::vector<Place>& places,
          const std::vector<char>& inhabited);
  bool counts(int place) const { return inhabited_.empty() || inhabited_[static_cast<std::size_t>(place)]; }
  std::vector<Remembered> remembered_;
  const StateVariables* followed_;
  StateVariables variables_;
  std::vector<char> inhabited_;
  std::vector<Place> places_;
  std::vector<std::uint32_t> followed_by_;  ///< of each variable, a bit for each of those followed
  std::vector<Field*> fields_;
  std::vector<Vector> before_;  ///< the step; empty before the first one
  std::uint64_t version_ = 0;
  double time_ = 0, length_ = 0;  ///< s: of the step for sums over time, and for rates
  bool is_held_ = false;
};

/// How a formula with variables of its own takes those of a history: their values and derivatives by its variables.
class TakesHistory {
 public:
  TakesHistory() = default;
  /// `named`: a bit for each variable of the formula and, behind them, of the history. Throws InputError where one that
  /// is named follows what the formula does not know.
  TakesHistory(const History& history, const StateVariables& variables, std::uint32_t named);
  bool is_needed() const { return !taken_.empty(); }
  std::uint32_t taken() const;                          ///< a bit for each variable of the history
  std::uint32_t followed() const { return followed_; }  ///< a bit for each variable of the formula
  double at(const Data& data, const Place& at, int place, std::span<const double> values, std::span<double> by,
            Memory memory) const;
  std::uint64_t version() const { return is_needed() ? history_->version() : 0; }

 private:
  const History* history_ = nullptr;
  const StateVariables* all_ = nullptr;  ///< of the formula, and of the history
  std::size_t own_ = 0;                  ///< how many are those of the formula
  std::vector<std::size_t> taken_;       ///< of the history
  std::vector<int> place_;               ///< of each variable that is followed, among those of the formula; -1: unknown
  std::uint32_t followed_ = 0;
};

}  // namespace sprekk
