// The loads on the domain of a fine level. Functions that are empty stand for zero.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "components/capabilities/fracture_tips.hpp"
#include "framework/types.hpp"

namespace sprekk::fine_fracture {

/// The loads on a fine level. Stresses are in Pa, tension positive; displacements in m. All functions are called during
/// FineModel::solve only.
struct FineLoads {
  /// On outline edges of kind displacement. `inside` is a point slightly inside the element at the edge: it tells the
  /// side of a crack that ends on the outline.
  std::function<Point(const Point& x, const Point& inside)> boundary_displacement = {};
  /// On outline edges of kind traction: total stress times outward normal.
  std::function<Point(const Point& x, const Point& normal)> boundary_traction = {};
  /// Total stress times normal n on the plus wall, in global components, n from plus to minus; the minus wall has the
  /// opposite traction. So a fluid pressure p is -p n. s runs from 0 to 1 along the segment.
  std::function<Point(int crack, int segment, double s)> wall_traction = {};
  /// Walls of kind traction that slide, see TipSurroundings::sliding: the traction is found with the displacement. An
  /// edge of the mesh slides where its middle does.
  std::function<std::optional<TipSurroundings::Sliding>(int crack, int segment, double s)> sliding = {};
  /// u(minus) - u(plus), in global components. Not called at tips, where the walls meet.
  std::function<Point(int crack, int segment, double s)> wall_jump = {};
  /// u(minus) - u(plus) on the paths beyond the outline, s along the segment as above.
  std::function<Point(int path, int segment, double s)> jump_beyond = {};
  /// (xx, yy, xy), a column a place, of the part of the total stress that is not elastic: total = C eps(u) + offset.
  /// For example -alpha (p - p0) I + initial stress. Only values are used, so it may jump. A model asks for its
  /// `offset_places` in each solve.
  std::function<Eigen::Matrix3Xd(const std::vector<Point>& places)> stress_offset = {};
  /// (x, y), N/m^3, a column a place: the force on the rock, its weight for example. It may be discontinuous. The
  /// columns belong to `body_force_places` of the model, or to its `offset_places` where it has no such places.
  std::function<Eigen::Matrix2Xd(const std::vector<Point>& places)> body_force = {};
};

/// A stress offset from a function of one place.
inline auto at_each_place(std::function<Eigen::Vector3d(const Point& x)> offset) {
  return [offset = std::move(offset)](const std::vector<Point>& places) {
    Eigen::Matrix3Xd offsets(3, places.size());
    for (std::size_t i = 0; i < places.size(); ++i) offsets.col(i) = offset(places[i]);
    return offsets;
  };
}

}  // namespace sprekk::fine_fracture
