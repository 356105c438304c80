#include "components/fine_fracture/boundary_element/density_integrals.hpp"

#include <Eigen/LU>
#include <cmath>
#include <vector>

#include "components/fine_fracture/fine_level/quadrature.hpp"
#include "framework/invariants.hpp"

namespace sprekk::fine_fracture {
namespace {

using Powers = std::array<Complex, element_nodes>;
using Square = Eigen::Matrix<double, element_nodes, element_nodes>;

/// The exponents of t.
const std::array<double, element_nodes>& exponents(Density density) {
  static constexpr std::array<double, element_nodes> whole{0, 1, 2, 3, 4}, half{0.5, 1.5, 2.5, 3.5, 4.5},
      both{0, 1, 2, 0.5, 1.5};
  return density == Density::polynomial ? whole : density == Density::root ? half : both;
}

/// The coefficients of the functions (rows) in N_j (columns), through `count` nodes.
Square coefficients(Density density, int count) {
  Square values = Square::Identity();
  for (int j = 0; j < count; ++j)
    for (int k = 0; k < element_nodes; ++k)
      values(j, k) = k < count ? std::pow(element_places()[j], exponents(density)[k]) : 0;
  return values.inverse();
}

const Square& coefficients(Density density) {
  static const Square polynomial = coefficients(Density::polynomial, element_nodes),
                      root = coefficients(Density::root, element_nodes),
                      corner = coefficients(Density::corner, element_nodes);
  return density == Density::polynomial ? polynomial : density == Density::root ? root : corner;
}

/// Integrals with powers of t.
struct Integrals {
  Powers value, slope, curvature;
};

/// Higher powers follow from the first one, whose exponent is `first`, by t^(k + 1)/(w − t) = w t^k/(w − t) − t^k.
void continue_from(double first, Complex w, Integrals& integrals) {
  auto& [value, slope, curvature] = integrals;
  for (int k = 0; k + 1 < element_nodes; ++k) {
    value[k + 1] = w * value[k] - 1 / (first + k + 1);
    slope[k + 1] = value[k] + w * slope[k];
    curvature[k + 1] = 2.0 * slope[k] + w * curvature[k];
  }
}

/// `is_on`: w is a place of the element; logarithms have the mean of both sides, which is real.
DensityIntegrals closed_form(Density density, Complex w, bool is_on) {
  const auto log = [is_on](Complex x) { return is_on ? Complex(std::log(std::abs(x))) : std::log(x); };
  const Complex rest = 1.0 / (w - 1.0);
  Integrals whole{}, half{};
  if (density != Density::root) {
    whole.value[0] = log(w * rest);
    whole.slope[0] = 1.0 / w - rest;
    whole.curvature[0] = rest * rest - 1.0 / (w * w);
    continue_from(0, w, whole);
  }
  if (density != Density::polynomial) {
    const Complex s = std::sqrt(w), logarithm = log((s + 1.0) / (s - 1.0));
    half.value[0] = s * logarithm - 2.0;
    half.slope[0] = logarithm / (2.0 * s) - rest;
    half.curvature[0] = rest * rest - rest / (2.0 * w) - logarithm / (4.0 * w * s);
    continue_from(0.5, w, half);
  }
  const Square& matrix = coefficients(density);
  DensityIntegrals result{};
  for (int k = 0; k < element_nodes; ++k) {
    const double exponent = exponents(density)[k];
    const int power = static_cast<int>(exponent);
    const Integrals& family = exponent == power ? whole : half;
    for (int j = 0; j < element_nodes; ++j) {
      result.value[j] += matrix(k, j) * family.value[power];
      result.slope[j] += matrix(k, j) * family.slope[power];
      result.curvature[j] += matrix(k, j) * family.curvature[power];
    }
  }
  return result;
}

/// Densities times weights at Gauss points. Where the density has roots, the points are those of sqrt(t).
struct Rule {
  struct Place {
    double t;
    std::array<double, element_nodes> weights;
  };
  std::vector<Place> places;
  explicit Rule(Density density) {
    constexpr int points = 12;
    for (const LinePoint& p : line_rule(points)) {
      const double t = density == Density::polynomial ? p.t : p.t * p.t;
      const double weight = density == Density::polynomial ? p.weight : 2 * p.t * p.weight;
      Place place{t, densities_at(density, t)};
      for (double& value : place.weights) value *= weight;
      places.push_back(place);
    }
  }
};

DensityIntegrals by_quadrature(Density density, Complex w) {
  static const Rule polynomial(Density::polynomial), root(Density::root), corner(Density::corner);
  const Rule& rule = density == Density::polynomial ? polynomial : density == Density::root ? root : corner;
  DensityIntegrals result{};
  for (const Rule::Place& place : rule.places) {
    // Written out: the operators of std::complex also test for infinities.
    const double x = w.real() - place.t, y = w.imag(), norm = 1 / (x * x + y * y);
    const Complex kernel(x * norm, -y * norm),
        square(y * y * norm * norm - x * x * norm * norm, 2 * x * y * norm * norm),
        cube(-2 * (square.real() * kernel.real() - square.imag() * kernel.imag()),
             -2 * (square.real() * kernel.imag() + square.imag() * kernel.real()));
    for (int j = 0; j < element_nodes; ++j) {
      result.value[j] += place.weights[j] * kernel;
      result.slope[j] += place.weights[j] * square;
      result.curvature[j] += place.weights[j] * cube;
    }
  }
  return result;
}

}  // namespace

const std::array<double, element_nodes>& element_places() {
  static const std::array<double, element_nodes> places = [] {
    std::array<double, element_nodes> found;
    for (int j = 0; j < element_nodes; ++j) found[j] = line_rule(element_nodes)[j].t;
    return found;
  }();
  return places;
}

DensityIntegrals density_integrals(Density density, Complex w) {
  constexpr double near = 2;  // lengths from the middle: from there on 12 points have all digits
  return std::abs(w - 0.5) < near ? closed_form(density, w, false) : by_quadrature(density, w);
}

DensityIntegrals density_integrals_on(Density density, double t) {
  SPREKK_EXPECT(t > 0 && t < 1, t);
  return closed_form(density, t, true);
}

std::array<double, element_nodes> rise_at_tip(bool fewer) {
  const Square matrix = fewer ? coefficients(Density::root, element_nodes - 1) : coefficients(Density::root);
  std::array<double, element_nodes> rise{};
  for (int j = 0; j < (fewer ? element_nodes - 1 : element_nodes); ++j) rise[j] = matrix(0, j);
  return rise;
}

std::array<double, element_nodes> slopes_at_tip() {
  // The finite part of the integral of t^(k + 1/2)/t^2 from 0 to 1 is 1/(k − 1/2), and the slope its negative.
  const Square& matrix = coefficients(Density::root);
  std::array<double, element_nodes> slopes{};
  for (int j = 0; j < element_nodes; ++j)
    for (int k = 0; k < element_nodes; ++k) slopes[j] -= matrix(k, j) / (k - 0.5);
  return slopes;
}

std::array<double, element_nodes> densities_at(Density density, double t) {
  const Square& matrix = coefficients(density);
  std::array<double, element_nodes> values{};
  for (int k = 0; k < element_nodes; ++k) {
    const double power = std::pow(t, exponents(density)[k]);
    for (int j = 0; j < element_nodes; ++j) values[j] += matrix(k, j) * power;
  }
  return values;
}

}  // namespace sprekk::fine_fracture
