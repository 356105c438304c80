// A crack in an infinite plate by Muskhelishvili's potentials, opened and sheared at its walls.
#pragma once

#include <cmath>
#include <complex>

#include "tests/components/meshes.hpp"

namespace sprekk::test {

using Complex = std::complex<double>;

inline constexpr double shear = 1, half_length = 1;

/// A crack at the angle to the x axis, under unit pressure and shear at its walls; or all of it mirrored at the y axis.
struct Crack {
  double angle, lambda;  ///< undrained
  bool is_mirrored = false;

  Point seen(const Point& x) const { return {is_mirrored ? -x[0] : x[0], x[1]}; }
  Complex local(const Point& at) const {
    const Point x = seen(at);
    return Complex(x[0], x[1]) * std::polar(1.0, -angle);
  }
  static Complex root(const Complex& z) { return std::sqrt(z - half_length) * std::sqrt(z + half_length); }

  double dilation(const Point& x) const {
    const Complex z = local(x);
    return 2 * (Complex(0.5, -0.5) * (z / root(z) - 1.0)).real() / (lambda + shear);
  }
  /// 2 G (u + iv) = kappa phi - z conj(phi') - conj(psi); psi = phi - z phi' for pressure, -phi - z phi' for shear.
  Point displacement(const Point& x) const {
    const Complex z = local(x), value = root(z) - z, slope = z / root(z) - 1.0;
    const Complex open = 0.5 * value, slip = Complex(0, -0.5) * value, phi = open + slip;
    const Complex of_phi = Complex(0.5, -0.5) * slope, psi = open - slip - z * of_phi;
    const double kappa = 3 - 2 * lambda / (lambda + shear);
    const Complex u = (kappa * phi - z * std::conj(of_phi) - std::conj(psi)) / (2 * shear) * std::polar(1.0, angle);
    return seen({u.real(), u.imag()});
  }
  /// sigma_nn = -1 and sigma_nt = -1 on the line of the crack.
  Point wall_force(const Point& face) const {
    const Complex n = local(face);
    const Complex force = Complex(-n.imag(), -n.real() - n.imag()) * std::polar(1.0, angle);
    return seen({force.real(), force.imag()});
  }
};

/// A crack in the middle of a square of 16 m.
inline Mesh around_crack(double angle, const MeshOptions& options) {
  Geometry geometry = box(16, 16);
  geometry.box.low = Point(-8, -8);
  geometry.box.high = Point(8, 8);
  FractureGeometry crack;
  crack.name = "crack";
  const Point end = half_length * Point(std::cos(angle), std::sin(angle));
  crack.points = {-end, end};
  geometry.fractures = {crack};
  return generate_mesh(geometry, options);
}

/// By Gauss's rule with two points: rock that is nearly incompressible sees what the centre alone is wrong by.
inline Point mean_displacement(const Mesh& mesh, int face, const Crack& crack) {
  const auto& ends = mesh.face_nodes[face];
  const Point arm = (mesh.nodes[ends[1]] - mesh.nodes[ends[0]]) / std::sqrt(12);
  return 0.5 * (crack.displacement(mesh.face_center[face] - arm) + crack.displacement(mesh.face_center[face] + arm));
}

}  // namespace sprekk::test
