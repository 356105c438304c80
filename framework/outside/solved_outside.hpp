// The interface of a component whose equations another program solves.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "framework/assembly/part.hpp"
#include "framework/config/input_error.hpp"

namespace sprekk {

/// Capability: another program solves the equations of the part's unknowns. Their derivatives are unknown, so the part
/// is alone in its `solve`. The program runs only between `join_run` and the end of the part: not while a scene is
/// checked.
class SolvedOutside {
 public:
  virtual ~SolvedOutside() = default;
  virtual const std::string& component() const = 0;
  virtual const Origin& origin() const = 0;  ///< of the component in the scene
  /// Throws InputError where the user has given no command that starts the program.
  virtual void require_command() const = 0;
  /// Lets the program be started when it is needed. `parts`: all of the model.
  virtual void join_run(const std::vector<Part*>& parts) = 0;
};

/// Whether one of the parts is SolvedOutside and owns the field.
inline bool is_solved_outside(const Field& field, const std::vector<Part*>& parts) {
  return std::ranges::any_of(parts, [&](const Part* part) {
    const auto* outside = dynamic_cast<const SolvedOutside*>(part);
    return outside && outside->component() == field.spec().owner;
  });
}

}  // namespace sprekk
