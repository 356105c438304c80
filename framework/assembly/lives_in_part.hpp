// Components that live in a part of the mesh.
#pragma once

#include <vector>

namespace sprekk {

/// A component whose fields mean something in some of the cells, or of the fracture cells, only. The others have values
/// without a meaning, which files and probes do not show.
class LivesInPart {
 public:
  virtual ~LivesInPart() = default;
  /// One flag a cell, or fracture cell; none where it lives everywhere.
  virtual const std::vector<char>& inhabited_cells() const = 0;
  virtual bool lives_on_fractures() const { return false; }
};

}  // namespace sprekk
