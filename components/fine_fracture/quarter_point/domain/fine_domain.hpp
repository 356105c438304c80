// The part of the coarse level around a tip, as the fine level needs it (sec. 3.1 of the paper, Fig. 2).
#pragma once

#include <vector>

#include "components/fine_fracture/growth/grow_tips.hpp"
#include "components/fine_fracture/quarter_point/domain/geometry.hpp"
#include "framework/mesh/mesh.hpp"

namespace sprekk::fine_fracture {

/// An end of a fracture that lies in the rock.
struct TipEnd {
  int fracture;
  bool at_end;  ///< the last point of the polyline, else the first
};

/// A fracture with what its ends have added on the fine level. Arc lengths are those of the coarse level, from its
/// first point: below 0 and above `length` lies what has been added.
struct FracturePath {
  std::vector<Point> points;  ///< straight pieces are one segment, but for points where fractures meet
  std::vector<double> arc;    ///< m, of each point
  double length;              ///< m, of the coarse level
  bool first_is_tip, last_is_tip;
};
FracturePath fracture_path(const Mesh& mesh, int fracture, const TipPath& added_first, const TipPath& added_last);

struct FineDomain {
  FineGeometry geometry;
  /// Of each crack of the geometry: its fracture, and the arc length of each of its points.
  struct Source {
    int fracture;
    std::vector<double> arc;
  };
  std::vector<Source> sources;
  int crack = none;     ///< that has the tip
  bool is_last = true;  ///< the tip is its last point, else the first
};

/// A square of side `size` (m) around `center`, clipped by the box that the rock fills, with all paths in it. A tip,
/// a kink, a junction or a segment along a side that the outline would be nearer to than `gap` (m) is avoided by a
/// slightly larger square, less than 1.5 times as large; where none is that far away, by the one that is farthest.
/// `coarse_walls` is how the walls of the coarse level are held; what has been added feels tractions.
FineDomain fine_domain(const Mesh& mesh, const std::vector<FracturePath>& paths, const TipEnd& tip, const Point& center,
                       double size, double gap, CrackPath::Walls coarse_walls);

}  // namespace sprekk::fine_fracture
