// A crack on the x axis from -a to a in an infinite plate: the exact field (Muskhelishvili 1953).
#pragma once

#include <cmath>
#include <complex>
#include <numbers>

#include "components/fine_fracture/fine_level/elasticity.hpp"

namespace sprekk::test {

/// Far away the stress is (xx, yy, xy) = (along, normal, shear); the walls are free. With `on_walls` the far field is
/// zero instead and the walls carry the tractions: a pressure `normal`, a shear stress -`shear`.
struct Griffith {
  using Complex = std::complex<double>;

  double a = 1;
  double normal = 1, shear = 0, along = 0;
  fine_fracture::Elasticity rock{1, 1};
  bool on_walls = false;

  Point K() const { return std::sqrt(std::numbers::pi * a) * Point(normal, shear); }

  /// u and du_i/dx_j. On the crack, `inside` tells the side.
  Point displacement(const Point& x, const Point& inside) const {
    const Potentials f = potentials(place(x, inside));
    const Complex z = place(x, inside);
    const Complex u = rock.kolosov() * f.phi - z * std::conj(f.Phi) - std::conj(f.psi);
    return Point(u.real(), u.imag()) / (2 * rock.shear);
  }
  Tensor stress(const Point& x) const {
    const Complex z = place(x, x);
    const Potentials f = potentials(z);
    const double sum = 4 * f.Phi.real();
    const Complex deviator = 2.0 * (std::conj(z) * f.dPhi + f.Psi);
    Tensor s;
    s << 0.5 * (sum - deviator.real()), 0.5 * deviator.imag(), 0.5 * deviator.imag(), 0.5 * (sum + deviator.real());
    return s;
  }
  /// u(lower) - u(upper) at (x, 0): with a path along +x this is u(minus) - u(plus).
  Point jump(double x) const {
    const double root = a * a > x * x ? std::sqrt(a * a - x * x) : 0;
    return -(4 / rock.plane_modulus()) * root * Point(shear, normal);
  }
  /// sigma_11 - sigma_22 at the tips.
  double T() const { return along - normal; }

 private:
  struct Potentials {
    Complex phi, Phi, dPhi, psi, Psi;
  };

  Complex place(const Point& x, const Point& inside) const {
    const bool is_on_crack = std::abs(x.y()) < 1e-12 * a;
    return {x.x(), is_on_crack ? std::copysign(0.0, inside.y()) : x.y()};
  }

  Potentials potentials(const Complex& z) const {
    const Complex A = 0.5 * Complex(normal, -shear);
    // Built by hand: z - a must keep the sign of a zero imaginary part.
    const Complex root = std::sqrt(Complex(z.real() - a, z.imag())) * std::sqrt(Complex(z.real() + a, z.imag()));
    // The uniform part: far stress of the crack problem is (normal, normal, shear) for free walls.
    const double uniform = 0.25 * (along - normal);
    Potentials f;
    f.phi = A * root + uniform * z;
    f.Phi = A * z / root + uniform;
    f.dPhi = -A * a * a / (root * root * root);
    f.psi = std::conj(A) * root - A * z * z / root - 2 * uniform * z;
    f.Psi = -(A - std::conj(A)) * z / root - z * f.dPhi - 2 * uniform;
    if (on_walls) {
      // Minus the uniform far field (along, normal, shear): Phi = (along + normal)/4, Psi = (normal - along)/2 + i
      // shear.
      const double sum = 0.25 * (along + normal);
      const Complex deviator(0.5 * (normal - along), shear);
      f.phi -= sum * z, f.Phi -= sum, f.psi -= deviator * z, f.Psi -= deviator;
    }
    return f;
  }
};

}  // namespace sprekk::test
