#include "components/fine_fracture/quarter_point/elasticity/auxiliary_field.hpp"

#include <cmath>
#include <complex>
#include <numbers>

namespace sprekk::fine_fracture {
namespace {

using Complex = std::complex<double>;

/// Muskhelishvili's Phi and Psi (derivatives of his potentials) with their derivatives:
/// s11 + s22 = 4 Re Phi, s22 - s11 + 2i s12 = 2 (conj(z) Phi' + Psi), 2G d(u1 + i u2)/dx1 = kappa Phi - conj(Phi +
/// conj(z) Phi' + Psi).
struct Potentials {
  Complex Phi, dPhi, ddPhi, Psi, dPsi;
};

/// The potentials from 1/z and z^-1/2, with Psi such that Phi + conj(Phi) + z Phi' + Psi, the traction, vanishes on
/// both walls.
Potentials potentials(Auxiliary field, const Complex& w, const Complex& root) {
  if (field == Auxiliary::force) {
    const double b = -1 / (4 * std::numbers::pi);
    return {b * w, -b * w * w, 2 * b * w * w * w, -b * w, b * w * w};
  }
  // Ahead of the tip s22 + i s12 = (K_I + i K_II) / sqrt(2 pi r).
  const Complex K(field == Auxiliary::opening ? 1 : 0, field == Auxiliary::sliding ? 1 : 0);
  const Complex a = std::conj(K) / (2 * std::sqrt(2 * std::numbers::pi));
  const Complex b = std::conj(a) - 0.5 * a;
  return {a * root, -0.5 * a * root * w, 0.75 * a * root * w * w, b * root, -0.5 * b * root * w};
}

/// The stress from s11 + s22 (sum) and s22 - s11 + 2i s12 (deviator).
Tensor stress_of(double sum, const Complex& deviator) {
  Tensor s;
  s << 0.5 * (sum - deviator.real()), 0.5 * deviator.imag(), 0.5 * deviator.imag(), 0.5 * (sum + deviator.real());
  return s;
}

AuxiliaryPoint point_of(const Potentials& f, const Elasticity& rock, const Complex& z_conj) {
  const Complex along = (rock.kolosov() * f.Phi - std::conj(f.Phi + z_conj * f.dPhi + f.Psi)) / (2 * rock.shear);
  const Tensor stress = stress_of(4 * f.Phi.real(), 2.0 * (z_conj * f.dPhi + f.Psi));
  const Tensor stress_along = stress_of(4 * f.dPhi.real(), 2.0 * (f.dPhi + z_conj * f.ddPhi + f.dPsi));
  return {stress, Point(along.real(), along.imag()), rock.strain(stress_along)};
}

}  // namespace

AuxiliaryPoint auxiliary_point(Auxiliary field, const Elasticity& rock, double r, double theta) {
  const Complex w = std::polar(1 / r, -theta), root = std::polar(1 / std::sqrt(r), -0.5 * theta);
  return point_of(potentials(field, w, root), rock, std::polar(r, -theta));
}

std::array<AuxiliaryPoint, 3> auxiliary_points(const Elasticity& rock, const Point& x) {
  // Sine and cosine of the half angle without trigonometric functions. One of r + x1 and r - x1 has cancellation; it
  // follows from the other, since their product is x2^2.
  const double r = x.norm(), sum = r + std::abs(x.x());
  const double larger = std::sqrt(0.5 * sum) / r, smaller = 0.5 * std::abs(x.y()) / (r * std::sqrt(0.5 * sum));
  const double cosine = x.x() >= 0 ? larger : smaller, sine = x.x() >= 0 ? smaller : larger;
  const Complex root(cosine, x.y() >= 0 ? -sine : sine), z_conj(x.x(), -x.y()), w = z_conj / (r * r);
  const auto at = [&](Auxiliary field) { return point_of(potentials(field, w, root), rock, z_conj); };
  return {at(Auxiliary::opening), at(Auxiliary::sliding), at(Auxiliary::force)};
}

}  // namespace sprekk::fine_fracture
