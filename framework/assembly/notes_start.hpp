// The interface of a part whose initial values may be out of balance.
#pragma once

#include "framework/assembly/notes.hpp"

namespace sprekk {

/// A part that tells before the first step by how much its initial values are out of balance.
class NotesStart {
 public:
  virtual ~NotesStart() = default;
  /// Adds notes. Called where the run begins with initial values of this part, which are not settled.
  virtual void note_start(Notes& notes) const = 0;
};

}  // namespace sprekk
