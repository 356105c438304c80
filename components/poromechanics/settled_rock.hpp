// The state that rock has been settled into at the start, from which its displacements are counted.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "framework/types.hpp"

namespace sprekk::poromechanics {

/// The state in which u = 0. Its stress stays as it is, whatever the stiffness becomes later.
struct SettledRock {
  Vector forces;         ///< total forces on faces, N/m, (x, y); or those of the stress of each cell (FemRock)
  Vector stress;         ///< total stress of each cell, Pa, (xx, yy, xy)
  Vector displacements;  ///< prescribed ones, m, from the state before
  Vector jumps;          ///< m, (normal, tangential) of each fracture cell

  /// Named values of the component `name`, for checkpoints.
  void save(const std::string& name, std::map<std::string, Vector>& state) const;
  /// None where the values are not there.
  static std::optional<SettledRock> restored(const std::string& name, const std::map<std::string, Vector>& state);
};

}  // namespace sprekk::poromechanics
