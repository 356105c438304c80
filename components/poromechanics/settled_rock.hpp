// The equilibrium at the start (start: settle), from which displacements are counted.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "framework/types.hpp"

namespace sprekk::poromechanics {

/// The state in which u = 0. Its stress stays as it is, whatever the stiffness becomes later.
struct SettledRock {
  Vector forces;         ///< total forces on faces, N/m; or those of the stress of each cell (FemRock)
  Vector stress;         ///< total stress of each cell, Pa
  Vector displacements;  ///< m, prescribed displacements, counted from the state before

  /// The state as named values of the component `name`, for checkpoints.
  void save(const std::string& name, std::map<std::string, Vector>& state) const;
  /// Nothing where a checkpoint does not have these values.
  static std::optional<SettledRock> restored(const std::string& name, const std::map<std::string, Vector>& state);
};

/// The name in checkpoints of the jumps that walls have while u = 0.
inline std::string key_of_young(const std::string& name) { return name + ".initial_young_modulus"; }
inline std::string key_of_jumps(const std::string& name) { return name + ".jumps_at_rest"; }

}  // namespace sprekk::poromechanics
