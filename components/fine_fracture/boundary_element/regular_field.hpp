// The elastic field in a domain without sources, by polynomials.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "components/fine_fracture/boundary_element/crack_elements.hpp"

namespace sprekk::fine_fracture {

/// All displacement fields up to a degree that need no body force in homogeneous isotropic rock: the potentials phi and
/// psi of Muskhelishvili (1953) are polynomials of z. They represent what lies outside of the domain, and converge
/// geometrically where the sources outside keep a distance from the domain.
class RegularField {
 public:
  /// `center`, `radius` (m): of a circle around the domain.
  RegularField(Complex center, double radius, int degree, const Elasticity& rock);
  /// The number of coefficients of a field; each is a displacement, m.
  int count() const { return 4 * degree_ + 2; }

  /// The displacement at z, two rows.
  Eigen::Matrix2Xd displacement(Complex z) const;
  /// (sigma_nn, sigma_tn), Pa, as ElementField::stress.
  Eigen::Matrix2Xd stress(Complex z, Complex along) const;
  /// sigma_xx + sigma_yy, Pa.
  Eigen::RowVectorXd trace(Complex z) const;

 private:
  Complex center_;
  double radius_;
  int degree_;
  Elasticity rock_;
};

}  // namespace sprekk::fine_fracture
