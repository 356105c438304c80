// How the arms of a junction reach its middle, through what fills the area in which fractures cross.
#pragma once

#include <optional>
#include <vector>

#include "framework/mesh/mesh.hpp"

namespace sprekk {

/// Half of a fracture cell at a junction. Its resistance is resistivity length/width.
struct CrossingArm {
  int fracture;        ///< index into Mesh::fractures
  double length;       ///< of the half cell, m
  double width;        ///< across the fracture, m; 0 for an arm that takes no part in the crossing
  double resistivity;  ///< along the fracture: the inverse of its conductivity; infinite where it conducts nothing
  double across;       ///< resistance of the way from a wall to the middle line, times the length of the wall
};

/// What fills a crossing: one of the fractures (`through`), or a medium with the given resistivity, or else one with
/// the harmonic mean of the conductivities of the fractures that meet.
struct CrossingFill {
  int through = none;  ///< index into Mesh::fractures
  std::optional<double> resistivity = std::nullopt;
  bool is_said() const { return through != none || resistivity; }
};

/// The resistance of an arm up to the middle is kept · (that of its half cell) + added.
struct WayToMiddle {
  double kept = 1, added = 0;
};

/// One for each arm. An arm passes the last part of its half cell, half as long as the widest other fracture is wide,
/// within the crossing: there its resistivity is that of the fill (Flemisch and others, Adv. Water Resour. 111 (2018)
/// 239, sec. 4.3: harmonic means). For strips of one width this length holds at all angles: they cross in a rhombus,
/// whose resistance from one side to the opposite one is that of a square, since its mirror image in a diagonal
/// exchanges both pairs of sides. A fracture that goes through keeps its half cells, and all other arms pass one of its
/// walls.
///
/// Fractures of equal resistivities keep their half cells to the bit, and so do two arms that meet end to end, unless
/// the fill is said: halves in series have no crossing.
std::vector<WayToMiddle> ways_to_middle(const std::vector<CrossingArm>& arms, const CrossingFill& fill);

}  // namespace sprekk
