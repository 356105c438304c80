#include "components/fine_fracture/boundary_element/regular_field.hpp"
#include <cmath>

namespace sprekk::fine_fracture {
namespace {

/// Calls `add(column, value)` for the coefficients of phi and psi, each with its real and its imaginary part.
/// of_phi(k, c), of_psi(k, c): the contribution of the coefficient c of the power k.
template <class OfPhi, class OfPsi>
Eigen::Matrix2Xd columns(int degree, OfPhi&& of_phi, OfPsi&& of_psi) {
  Eigen::Matrix2Xd matrix(2, 4 * degree + 2);
  int column = 0;
  const auto add = [&](Complex value) { matrix.col(column++) << value.real(), value.imag(); };
  for (int k = 1; k <= degree; ++k)
    for (const Complex c : {Complex(1), imaginary_unit}) add(of_phi(k, c));
  for (int k = 0; k <= degree; ++k)
    for (const Complex c : {Complex(1), imaginary_unit}) add(of_psi(k, c));
  return matrix;
}

/// k z^(k − 1).
Complex slope(Complex z, int k) { return k == 0 ? 0 : double(k) * std::pow(z, k - 1); }
/// k (k − 1) z^(k − 2).
Complex curvature(Complex z, int k) { return k < 2 ? 0 : double(k) * (k - 1) * std::pow(z, k - 2); }

}  // namespace

RegularField::RegularField(Complex center, double radius, int degree, const Elasticity& rock)
    : center_(center), radius_(radius), degree_(degree), rock_(rock) {}

Eigen::Matrix2Xd RegularField::displacement(Complex z) const {
  const Complex x = (z - center_) / radius_;
  return columns(
      degree_, [&](int k, Complex c) { return rock_.kolosov() * c * std::pow(x, k) - x * std::conj(c * slope(x, k)); },
      [&](int k, Complex c) { return -std::conj(c * std::pow(x, k)); });
}

Eigen::Matrix2Xd RegularField::stress(Complex z, Complex along) const {
  const Complex x = (z - center_) / radius_;
  return 2 * rock_.shear / radius_ *
         columns(
             degree_,
             [&](int k, Complex c) {
               return 2 * (c * slope(x, k)).real() + along * along * std::conj(x) * c * curvature(x, k);
             },
             [&](int k, Complex c) { return along * along * c * slope(x, k); });
}

Eigen::RowVectorXd RegularField::trace(Complex z) const {
  const Complex x = (z - center_) / radius_;
  return 2 * rock_.shear / radius_ *
         columns(
             degree_, [&](int k, Complex c) { return 4 * (c * slope(x, k)).real(); },
             [](int, Complex) { return Complex(0); })
             .row(0);
}

}  // namespace sprekk::fine_fracture
