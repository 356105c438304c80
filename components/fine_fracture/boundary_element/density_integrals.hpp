// Integrals of Cauchy's kernel over a straight element, with densities that are polynomials or vanish like a root.
#pragma once

#include <array>
#include <complex>

#include "framework/types.hpp"

namespace sprekk::fine_fracture {

using Complex = std::complex<double>;
inline constexpr Complex imaginary_unit{0, 1};
inline Complex number(const Point& x) { return {x[0], x[1]}; }  ///< x + i y

constexpr int element_nodes = 5;  ///< of an element of a crack: jumps are polynomials of degree 4 along it

/// The functions that span the jump along an element from t = 0 to 1.
enum class Density {
  polynomial,  ///< 1, t, … t^4
  root,        ///< sqrt(t) times these: a tip at t = 0
  corner       ///< 1, t, t^2, sqrt(t), sqrt(t) t: a kink at t = 0, where jumps go with powers of t from 1/2 to 1
};

/// For each node j of an element the integral over t of N_j(t)/(w − t), and its first two derivatives by w. N_j is 1 at
/// node j, 0 at the others, and a sum of the functions of the density.
struct DensityIntegrals {
  std::array<Complex, element_nodes> value, slope, curvature;
};

/// The nodes of an element, 0 < t < 1: Gauss-Legendre points.
const std::array<double, element_nodes>& element_places();

/// `w`: any place outside of the element. In closed form near the element, with Gauss points farther away, where the
/// closed form loses digits.
DensityIntegrals density_integrals(Density density, Complex w);
/// At a place of the element, 0 < t < 1: the mean of both sides, so Cauchy's principal value and Hadamard's finite part
/// (Kaya and Erdogan, Quart. Appl. Math. 45 (1987) 105).
DensityIntegrals density_integrals_on(Density density, double t);

/// The coefficient of sqrt(t) in N_j at a tip: N_j(t) = result[j]·sqrt(t) + … for the density `root`. With `fewer`, N_j
/// interpolates at all nodes but the last one; the difference estimates the error.
std::array<double, element_nodes> rise_at_tip(bool fewer = false);
/// The first derivative (by w) of the integrals at the tip of an element, as the limit of density_integrals_on.
std::array<double, element_nodes> slopes_at_tip();

/// The values N_j(t) of an element.
std::array<double, element_nodes> densities_at(Density density, double t);

}  // namespace sprekk::fine_fracture
