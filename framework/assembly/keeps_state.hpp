// What keeps state outside of fields.
#pragma once

#include <map>
#include <string>

#include "framework/types.hpp"

namespace sprekk {

/// Capability of parts, and of steps of the schedule: state that is not in fields. A repeated or restarted step finds
/// what the first attempt found.
class KeepsState {
 public:
  virtual ~KeepsState() = default;
  virtual void accepted() {}  ///< the time step, with all fields, has been accepted
  virtual void rewound() {}   ///< the time step, with all fields, has been taken back
  /// For checkpoints: `save` adds the state as named values, `restore` reads these values.
  virtual void save(std::map<std::string, Vector>& /*state*/) const {}
  virtual void restore(const std::map<std::string, Vector>& /*state*/) {}
};

}  // namespace sprekk
