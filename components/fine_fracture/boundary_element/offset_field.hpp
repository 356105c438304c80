// The elastic field that pore pressure and initial stress make without cracks and without a far field.
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <vector>

#include "components/fine_fracture/boundary_element/crack_elements.hpp"

namespace sprekk::fine_fracture {

/// A particular solution of div (C eps(u) + s) = 0 for a stress offset s that is linear plus isotropic: the linear part
/// by squares of the coordinates, the rest by dual reciprocity (Partridge, Brebbia and Wrobel 1992). It is a sum of
/// distances r from given places; laplace phi = −r/(lambda + 2G) has phi = −r^3/(9 (lambda + 2G)), and u = grad phi
/// (Goodier, Philos. Mag. 23 (1937) 1017).
class OffsetField {
 public:
  /// `places`: where the offset is known, m, no two of them the same.
  OffsetField(const std::vector<Point>& places, const Elasticity& rock);
  const std::vector<Point>& places() const { return places_; }

  /// A solution for values of the offset.
  class Solution {
   public:
    Point displacement(const Point& x) const;  ///< m
    /// Pa, total: C eps(u) + s.
    Tensor stress(const Point& x) const;
    /// Pa, the largest part of the offset that is neither linear nor isotropic, at the places.
    double remainder() const { return remainder_; }

   private:
    friend class OffsetField;
    const OffsetField* field_;
    Eigen::Matrix3d linear_;  ///< Pa: (xx, yy, xy) as rows; constant, by x, by y over the size of the places
    Vector weights_;          ///< Pa/m
    double remainder_ = 0;
    Tensor linear_part(const Point& x) const;
  };
  /// `offsets`: (xx, yy, xy), Pa, a column for each place. The solution must not outlive this object.
  Solution solution(const Eigen::Matrix3Xd& offsets) const;

 private:
  std::vector<Point> places_;
  Elasticity rock_;
  Point center_;
  double size_;
  Eigen::MatrixX3d linear_;
  Eigen::PartialPivLU<Eigen::MatrixXd> distances_;
};

}  // namespace sprekk::fine_fracture
