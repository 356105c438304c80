// Components that live in a part of the mesh.
#pragma once

#include <vector>

namespace sprekk {

/// A component whose fields mean something in some of the cells only. The others keep initial values, which files and
/// probes do not show.
class LivesInPart {
 public:
  virtual ~LivesInPart() = default;
  /// One flag a cell; none where it lives everywhere.
  virtual const std::vector<char>& inhabited_cells() const = 0;
};

}  // namespace sprekk
