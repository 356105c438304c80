#include "couplers/well_exchange/space/line_field.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

#include "couplers/well_exchange/rock_openings.hpp"
#include "framework/discretization/principal_axes.hpp"
#include "framework/invariants.hpp"

namespace sprekk::couplers {
namespace {

constexpr double negligible_exponent = 40;  // exp(−40) = 4e-18
constexpr double beside = 1e-9;             // of a part: points on its axis, beyond its ends, are this far off
constexpr double longest_interval = 0.5;    // of u: four points are exact to 1e-10 there
/// Points and weights of Gauss, on (-1, 1).
constexpr std::array<std::array<double, 2>, 4> gauss = {{{-0.8611363115940526, 0.3478548451374538},
                                                         {-0.3399810435848563, 0.6521451548625461},
                                                         {0.3399810435848563, 0.6521451548625461},
                                                         {0.8611363115940526, 0.3478548451374538}}};

/// The integral of exp(−z cosh u) from a to b.
double integral(double z, double a, double b) {
  if (z > negligible_exponent) return 0;
  const double reach = std::acosh(negligible_exponent / z);
  a = std::max(a, -reach);
  b = std::min(b, reach);
  if (!(a < b)) return 0;
  const int count = 1 + static_cast<int>((b - a) / longest_interval);
  const double half = (b - a) / (2 * count);
  double sum = 0;
  for (int i = 0; i < count; ++i)
    for (const auto& [point, weight] : gauss)
      sum += weight * half * std::exp(-z * std::cosh(a + (2 * i + 1 + point) * half));
  return sum;
}

Tensor root_of_inverse(const Tensor& mobility) {
  const auto [values, axes] = principal_axes(mobility);
  return axes * values.cwiseSqrt().cwiseInverse().asDiagonal() * axes.transpose();
}

/// The mean of the half-axes of the ellipse that a circle around d is in the metric, seen along the bore hole.
double bore_in_metric(const Tensor& metric, const Point& direction, double radius) {
  const Point along = (metric * direction).normalized(), first = direction.unitOrthogonal();
  Eigen::Matrix<double, 3, 2> circle;
  circle << first, direction.cross(first);
  Eigen::Matrix<double, 3, 2> ellipse = metric * circle;
  ellipse -= along * (along.transpose() * ellipse).eval();
  const Eigen::Matrix2d square = ellipse.transpose() * ellipse;
  const double trace = square.trace(), root = std::sqrt(std::max(square.determinant(), 0.0));
  return radius * std::sqrt(trace + 2 * root) / 2;  // a + b, from a^2 + b^2 and a b
}

}  // namespace

LineField::LineField(const std::vector<Point>& line, const Tensor& mobility, double radius,
                     const std::vector<ClosedPlane>& planes) {
  SPREKK_EXPECT(line.size() > 1 && planes.size() < 3, line.size(), planes.size());
  SPREKK_EXPECT(planes.size() < 2 || line.size() == 2, line.size());
  const Point first = (line[1] - line[0]).normalized();
  const Tensor root = root_of_inverse(mobility);
  mobility_ = std::sqrt(mobility.determinant()) * (root * first).norm();
  metric_ = std::sqrt(mobility_) * root;
  bore_ = bore_in_metric(metric_, first, radius);
  for (std::size_t k = 1; k < line.size(); ++k) add(line[k - 1], line[k], mobility);
  if (planes.size() == 2) parts_.front().length = 0;
  if (planes.size() != 1) return;
  const auto mirrored = [&](const Point& x) -> Point {
    const auto& [at, normal] = planes.front();
    return x - 2 * normal.dot(x - at) * normal;
  };
  for (std::size_t k = 1; k < line.size(); ++k) add(mirrored(line[k - 1]), mirrored(line[k]), mobility);
}

void LineField::add(const Point& from, const Point& to, const Tensor& mobility) {
  const Point along = metric_ * (to - from);
  const double across = std::sqrt(mobility.determinant()) * along.norm() / (to - from).norm() / std::sqrt(mobility_);
  parts_.push_back({metric_ * from, along.normalized(), along.norm(), mobility_ / across});
}

double LineField::sum(const Point& x, double decay, double least_distance) const {
  const double root = std::sqrt(decay);
  double sum = 0;
  for (const Part& part : parts_) {
    const Point away = metric_ * x - part.from;
    const double along = away.dot(part.direction);
    const double distance = std::max((away - along * part.direction).norm(), least_distance);
    if (part.length == 0) {
      sum += decay == 0 ? -std::log(distance) : std::cyl_bessel_k(0.0, distance * root);
      continue;
    }
    const double off = std::max(distance, beside * part.length);
    const double a = std::asinh(-along / off), b = std::asinh((part.length - along) / off);
    sum += part.weight / 2 * (decay == 0 ? b - a : integral(off * root, a, b));
  }
  return sum;
}

double LineField::at_bore(const Point& from, const Point& to, double decay) const {
  double mean = 0;
  for (const auto& [point, weight] : gauss)
    mean += weight / 2 * sum(0.5 * (from + to) + point / 2 * (to - from), decay, bore_);
  return mean;
}

double LineField::pressure_at_bore(const Point& from, const Point& to) const { return at_bore(from, to, 0); }

double LineField::transformed_pressure_at_bore(const Point& from, const Point& to, double decay) const {
  const double x = bore_ * std::sqrt(decay);  // the source is on the wall of the bore hole (van Everdingen, Hurst 1949)
  return at_bore(from, to, decay) / (x * std::cyl_bessel_k(1.0, x));
}

double mobility_across(const WellPlace& place, const Tensor& mobility) {
  if (!place.piece) return std::cbrt(mobility.determinant());
  const Point direction = (place.piece->to - place.piece->from).normalized();
  return std::sqrt(mobility.determinant()) * (root_of_inverse(mobility) * direction).norm();
}

double open_length(const WellPlace& place) { return place.piece ? place.piece->length() : 1; }

}  // namespace sprekk::couplers
