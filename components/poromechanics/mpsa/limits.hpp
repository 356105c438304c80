// Numbers on which the discretization of the stress depends.
#pragma once

#include "framework/discretization/zone_limits.hpp"

namespace sprekk::poromechanics {

/// Only tests take other values, to see how much answers depend on them (docs/numerics/tolerances.md).
struct MpsaLimits {
  /// Smallest pivot, of a row, of a local problem that is solvable: less is round-off.
  double singular = 1e-12;
  /// The strength of the coupling between rotations of neighbours, relative to their shear modulus. Between an eighth
  /// and a half errors change little (docs/numerics/poromechanics.md); far below, rotations are hardly coupled.
  double rotation_strength = 0.25;
  /// How well the conditions on the two faces of a single subcell determine a component of its gradient, as the sine of
  /// an angle: below `vague` they are not used for it, above `certain` nothing else is. In space the same for rotations
  /// of few subcells, by the part of the arms of their faces that prescribed displacements hold.
  double vague = 0.1, certain = 0.5;
  /// A spring on a face of a single subcell (FaceConditions::spring) of more than so many shear moduli holds the face
  /// as a prescribed displacement does: the rock moves it by 3 % of what it would move a free face.
  double holds = 30;
  /// Where the smallest pivot, relative to its row, is below `turns_freely`, a stiff subcell turns freely among very
  /// soft ones (media that differ by 1e6), which hardly resist. It is then coupled to their rotation with
  /// `held_by_soft` times the strength between equal subcells.
  double turns_freely = 1e-6, held_by_soft = 0.1;
  /// The factor of the smaller A/M in VolumeExchange where subcells have two inner subfaces: with more, volume could
  /// overshoot where subcells are equal.
  double exchange = 0.25;
  /// In space: centres that lie in one plane, or on one line, to this part of their distances do not determine how
  /// displacements change across it.
  double flat = 0.05;
  /// Least ratio of the smallest singular value of the fit of a tip's field to the largest; below, the modes are too
  /// similar to linear displacements.
  double well_posed = 1e-3;
  /// Largest difference of the stiffness of a cell from that at a tip, relative: the tip's field is that in even rock.
  double alike = 0.2;
  ZoneLimits zones = {};
};

}  // namespace sprekk::poromechanics
