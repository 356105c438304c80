// What is prescribed on a face, and in which directions.
#pragma once

#include <array>

#include "framework/mesh/geometry.hpp"

namespace sprekk::poromechanics {

/// What is prescribed in one direction of a face. Walls are `traction`; `load` applies to both directions of a face
/// with two cells.
enum class MechanicalCondition { none, displacement, traction, load };

/// The directions of the conditions on a face: those of the coordinates, or those of the face itself, its normal out of
/// the rock and its tangents (see axes_of).
enum class ConditionAxes { of_space, of_face };

/// What is prescribed in each direction of a face.
struct FaceConditions {
  std::array<MechanicalCondition, dimension> along{};
  ConditionAxes axes = ConditionAxes::of_space;
  /// What a displacement of an outer face adds to the force on it, with the opposite sign: N/m per m (N/m in space), in
  /// the coordinates. Beside tractions; the force on the face is then the prescribed one less spring · displacement.
  Tensor spring = Tensor::Zero();

  MechanicalCondition& operator[](int direction) { return along[direction]; }
  MechanicalCondition operator[](int direction) const { return along[direction]; }
  bool has_spring() const { return !spring.isZero(0); }
  bool operator==(const FaceConditions&) const = default;
};

/// The unit vectors of the directions, a column each. Those of a face are its normal and its tangents, as in the frame
/// of a fracture cell: in a plane (-n_y, n_x), which has the rock on its left.
inline Tensor axes_of(ConditionAxes axes, const Point& normal) {
  if (axes == ConditionAxes::of_space) return Tensor::Identity();
  return (Tensor() << normal, tangents_of(normal)).finished();
}

}  // namespace sprekk::poromechanics
