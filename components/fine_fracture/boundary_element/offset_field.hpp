// The elastic field due to pore pressure, initial stress and weight, without cracks and without a far field.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "components/fine_fracture/boundary_element/crack_elements.hpp"
#include "framework/dense/lu.hpp"

namespace sprekk::fine_fracture {

/// A particular solution of div (C eps(u) + s) + b = 0 for a stress offset s that is linear plus isotropic and any body
/// force b: the linear part of s and the mean of b by squares of the coordinates, the rest by dual reciprocity
/// (Partridge, Brebbia and Wrobel 1992). It is a sum of distances r from given places. For s = r I,
/// laplace phi = −r/(lambda + 2G) has phi = −r^3/(9 (lambda + 2G)), and u = grad phi (Goodier, Philos. Mag. 23 (1937)
/// 1017). For b = r e, with Galerkin's vector −r^5/(225 (1 − nu)) e,
///   2G u = −2/9 r^3 e + [r^3 e + 3 r (x·e) x]/(45 (1 − nu)).
class OffsetField {
 public:
  /// `places`: where offset and body force are known, m, no two of them the same.
  OffsetField(const std::vector<Point>& places, const Elasticity& rock);
  const std::vector<Point>& places() const { return places_; }

  /// The particular solution for given values of the offset and of the body force.
  class Solution {
   public:
    Point displacement(const Point& x) const;  ///< m
    /// The total stress C eps(u) + s, Pa.
    Tensor stress(const Point& x) const;
    /// The part of the offset at the places that is neither linear nor isotropic, Pa: its largest value.
    double remainder() const { return remainder_; }

   private:
    friend class OffsetField;
    const OffsetField* field_;
    Eigen::Matrix3d linear_ = Eigen::Matrix3d::Zero();  ///< Pa; rows xx, yy, xy; columns: the constant, and the slopes
                                                        ///< by x and y times the size of the region of the places
    Vector weights_;                                    ///< Pa/m
    Point mean_force_ = Point::Zero();                  ///< N/m^3, of b
    Eigen::Matrix2Xd force_weights_;  ///< N/m^4, of the rest of b; no columns where b is the same everywhere
    double remainder_ = 0;
    Tensor linear_part(const Point& x) const;
    Point force() const;  ///< the mean of b and the divergence of the linear part of s, times the size of the region of
                          ///< the places, Pa
  };
  /// `offsets`: (xx, yy, xy), Pa, a column for each place; `body_forces`: (x, y), N/m^3; no columns for zero. The
  /// solution must not outlive this object.
  Solution solution(const Eigen::Matrix3Xd& offsets, const Eigen::Matrix2Xd& body_forces) const;

 private:
  std::vector<Point> places_;
  Elasticity rock_;
  Point center_;
  double size_;
  double along_;  ///< 1/(45 (1 − nu))
  Eigen::MatrixX3d linear_;
  DenseLu distances_;
};

}  // namespace sprekk::fine_fracture
