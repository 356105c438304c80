// The pressure around a line source in space, of one strength in each metre.
#pragma once

#include <vector>

#include "framework/types.hpp"

namespace sprekk::couplers {

/// A plane through which nothing flows.
struct ClosedPlane {
  Point at, normal;
};

/// A source q' for each metre (m^2/s) along a polyline, in rock of one mobility M. Pressures are those times 2 pi m/q',
/// with the mobility m = sqrt(det M) |M^-1/2 d| across its first part, whose direction is d, and rho, the distance from
/// it in the metric rho^2 = m x·M^-1 x: along a line without end −ln rho, and else
///   (asinh(b/rho) − asinh(a/rho))/2,
/// where the line reaches from a to b beside the point. Transforms at s = c decay (c: m over the storage) replace these
/// by K_0(rho sqrt(decay)), and by half of the integral of exp(−rho sqrt(decay) cosh u) from asinh(a/rho) to
/// asinh(b/rho).
class LineField {
 public:
  /// `planes`: none, one (the line has a mirror image behind it), or two parallel ones between which a straight line
  /// stands at right angles: then it has no end. Their normals are principal axes of M. `radius`: of the bore hole, m,
  /// which is an ellipse in the metric; Peaceman (1983) takes the mean of its half-axes.
  LineField(const std::vector<Point>& line, const Tensor& mobility, double radius,
            const std::vector<ClosedPlane>& planes);

  /// The pressure at a point away from the line.
  double pressure(const Point& x) const { return sum(x, 0, 0); }
  double transformed_pressure(const Point& x, double decay) const { return sum(x, decay, 0); }
  /// The mean around the bore hole along a straight piece of the line.
  double pressure_at_bore(const Point& from, const Point& to) const;
  double transformed_pressure_at_bore(const Point& from, const Point& to, double decay) const;
  double bore() const { return bore_; }          ///< m, in the metric
  double mobility() const { return mobility_; }  ///< the mobility across the first part, in units of M

 private:
  struct Part {
    Point from, direction;  ///< in the metric, m; unit
    double length, weight;  ///< m (0: without end); mobility across the first part over that across this one
  };
  void add(const Point& from, const Point& to, const Tensor& mobility);
  double sum(const Point& x, double decay, double least_distance) const;
  double at_bore(const Point& from, const Point& to, double decay) const;

  Tensor metric_;  ///< takes x to where distances are rho
  double mobility_ = 0, bore_ = 0;
  std::vector<Part> parts_;
};

}  // namespace sprekk::couplers
