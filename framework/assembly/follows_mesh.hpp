// Parts that have something to do when the mesh changes.
#pragma once

#include "framework/assembly/part.hpp"
#include "framework/field/known_within_cells.hpp"

namespace sprekk {

struct MeshChange;

/// Capability: a part that takes more than the values of its fields from one mesh to the next.
class FollowsMesh {
 public:
  virtual ~FollowsMesh() = default;
  /// Adds what the part knows of the accepted values of a field within cells, beside their means. New cells take it
  /// over when the mesh changes (transferred_cells).
  virtual void add_known_within_cells(const Field& /*field*/, KnownWithinCells& /*known*/) const {}
  /// Called on a part that has been built on a changed mesh, after its fields have received their values. Copies the
  /// state outside of fields from `before`, the same part on the old mesh, and gives new entities their initial state.
  virtual void carry_over(const Part& /*before*/, const MeshChange& /*change*/) {}
  /// Called when the equilibrium on the new mesh has been found, before it is accepted.
  virtual void settled(const MeshChange& /*change*/) {}
};

}  // namespace sprekk
