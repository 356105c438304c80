// What a scene wants to be remembered of the state, so that formulas may name it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "framework/config/input_error.hpp"
#include "framework/config/spec.hpp"
#include "framework/config/state.hpp"

namespace sprekk {

/// What is remembered of an expression: its largest or smallest value so far, or its sum over time or over a variable
/// that has a rate.
enum class Recall { largest, smallest, sum };

/// One variable that remembers.
struct Remembered {
  Origin origin;
  Recall recall = Recall::largest;
  Data expression;              ///< of the state
  StateVariable variable;       ///< its name, unit and text
  int rate = -1;                ///< of a sum over a variable: the place of its rate among those followed; -1: over time
  std::optional<double> start;  ///< SI; without it, a sum starts from 0, and an extreme from the state at the start
};

/// The section `history` of a component. It is read before the formulas that name it.
class HistoryOptions {
 public:
  /// Declares the section, before all parameters whose formulas may name what it declares. Its expressions name
  /// `followed`, which must outlive this object; so must the spec's targets.
  void declare(Spec& spec, const StateVariables& followed);
  /// In the order of the scene. Throws InputError for expressions and names that are refused.
  const std::vector<Remembered>& all() const;

 private:
  /// An entry as it is written.
  struct Entry {
    std::string name;
    Origin origin;
    std::optional<std::string> largest = {}, smallest = {}, sum = {}, over = {}, start = {};
    std::string path = {};
    void require_one() const;  ///< throws InputError unless it is one of largest, smallest and sum
    Spec spec();
  };
  Remembered understood(const Entry& entry) const;
  void check_name(const Entry& entry) const;

  const StateVariables* followed_ = nullptr;
  std::vector<Entry> entries_;
  mutable std::vector<Remembered> all_;  ///< as far as they have been understood
};

}  // namespace sprekk
