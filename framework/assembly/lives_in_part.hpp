// Components that live in a part of the mesh.
#pragma once

#include <vector>

namespace sprekk {

/// A component that lives in some of the cells, or of the fracture cells. Values of its fields elsewhere have no
/// meaning, and files and probes do not show them.
class LivesInPart {
 public:
  virtual ~LivesInPart() = default;
  /// One flag a cell, or fracture cell: whether the component lives there; empty where it lives everywhere.
  virtual const std::vector<char>& inhabited_cells() const = 0;
  virtual bool lives_on_fractures() const { return false; }
};

}  // namespace sprekk
