// Principal values and directions of stress, for output.
#pragma once

#include <string>
#include <vector>

#include "framework/field/output_field.hpp"

namespace sprekk::poromechanics {

/// The principal values of a stress (tension positive) and the direction of its largest compression.
struct PrincipalStress {
  double most_compressive, least_compressive;  ///< Pa, the smallest and the largest eigenvalue
  /// The unit vector along the most compressive stress. Its largest component is positive (the first one if several are
  /// equal), so that its sign does not depend on round-off where it lies along an axis. Zero where there is no such
  /// direction, because another one is compressed as much.
  Point direction;
};

/// The principal stress of a tensor with these components.
PrincipalStress principal_stress(const SymmetricTensor& stress);

/// Appends OWNER.stress, its principal values OWNER.principal_stress.most_compressive and .least_compressive, and
/// OWNER.most_compressive_direction. `stress`: of each cell, Pa.
void output_stress(const std::string& owner, Vector stress, std::vector<OutputField>& fields);

}  // namespace sprekk::poromechanics
