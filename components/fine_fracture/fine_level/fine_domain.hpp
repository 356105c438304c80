// The part of the coarse level around a tip, as the fine level needs it (sec. 3.1 and Fig. 2 of the paper).
#pragma once

#include <optional>
#include <vector>

#include "components/fine_fracture/fine_level/geometry.hpp"
#include "components/fine_fracture/growth/grow_tips.hpp"
#include "framework/mesh/mesh.hpp"

namespace sprekk::fine_fracture {

/// An end of a fracture that lies in the rock.
struct TipEnd {
  int fracture;
  bool at_end;  ///< the last point of the polyline, else the first
};

/// A fracture with the paths that its ends have added in the fine level. Arc lengths count from the first point in the
/// coarse level: added paths are below 0 and above `length`.
struct FracturePath {
  std::vector<Point> points;  ///< straight pieces are one segment, except for points where fractures meet or turn
  std::vector<double> arc;    ///< m, of each point
  double length;              ///< m, of the coarse level
  bool first_is_tip, last_is_tip;
};
/// The cell at an end of a fracture, where growth has laid it.
struct LastSegment {
  /// Whether it turns from trial to trial. Then its ends are points of the path, however small the bend there is.
  bool turns = false;
  std::optional<Point> corner = {};  ///< m, of two pieces in its place; along it at place_of_corner from its anchor
};
FracturePath fracture_path(const Mesh& mesh, int fracture, const TipPath& added_first, const TipPath& added_last,
                           const LastSegment& at_first = {}, const LastSegment& at_last = {});

/// The geometry of a fine level, and how it relates to the fractures of the coarse level.
struct FineDomain {
  FineGeometry geometry;
  /// For a crack of the geometry: its fracture, and the arc length of each of its points.
  struct Source {
    int fracture;
    std::vector<double> arc;
  };
  std::vector<Source> sources;
  std::vector<Source> beyond;  ///< of the paths of geometry.beyond
  int crack = none;            ///< index of the crack that the tip belongs to
  bool is_last = true;         ///< whether the tip is the last point of that crack; else it is the first one
};

constexpr double largest_enlargement = 2;  ///< of the side of a fine level's square, to keep away from fractures

/// The domain of a fine level: a square of side `size` (m) around `center`, clipped by the bounding box of the rock,
/// with all paths in it. Where the rock is no such box, and has slanted sides or a hole in the square, the square is as
/// much smaller as it has to be; throws std::invalid_argument where none fits. The outline keeps the distance `gap` (m)
/// from tips, junctions and segments along a side. From a bend of the coarse level's paths it keeps 8 |sin| times that,
/// but no less than 0.25 and no more than 4 times. If necessary the square is larger, by less than
/// `largest_enlargement` times; where no such square keeps the distances, the one that comes nearest to it is taken.
/// `outline`: if given, the one of an earlier domain, which is kept. `coarse_walls`: how the walls of the coarse level
/// are loaded; walls of added paths have tractions.
FineDomain fine_domain(const Mesh& mesh, const std::vector<FracturePath>& paths, const TipEnd& tip, const Point& center,
                       double size, double gap, CrackPath::Walls coarse_walls,
                       const std::vector<Point>* outline = nullptr);

/// How far an outline that fine_domain has made reaches beyond its center, m: to those of its sides that are not on the
/// bounding box of the rock.
double reach_in_rock(const Mesh& mesh, const std::vector<Point>& outline, const Point& center);

/// Adds the parts of paths outside of the outline, as far away from it as it is wide, to `beyond`. A path that ends on
/// the outline, where the rock ends, goes straight on with the jump of its end.
void add_beyond(FineDomain& domain, const std::vector<FracturePath>& paths);

}  // namespace sprekk::fine_fracture
