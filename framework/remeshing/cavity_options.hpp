// The options of the cavity in which a mesh is made anew around the path of a fracture.
#pragma once

namespace sprekk {

/// How the mesh changes around a new path.
struct CavityOptions {
  /// Cells whose centre is nearer than this to the old tip or the new path are made anew, m (sec. 4.1 of the paper:
  /// five times the length of growth). Cells next to those that the path crosses are always made anew.
  double radius;
  double size;  ///< edge length at the new path, m
  /// By how many m the edge length grows per m of distance from the path, if the rim is far enough away.
  double growth;
  /// Where the outer boundary or another fracture is nearer than gap_edges · size, the edges of the path are as long as
  /// this distance over gap_edges. 0: no refinement in gaps.
  double gap_edges = 0.5;
  /// Whether the topology of new cells must not depend on the last digits of coordinates (fill_rounded_cavity).
  bool rounds = false;
};

}  // namespace sprekk
