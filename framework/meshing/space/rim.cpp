#include "framework/meshing/space/rim.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "framework/round_off.hpp"

namespace sprekk {
namespace {

constexpr int samples_of_rim = 192;  // of a function along a rim, between which it has one minimum at most

}  // namespace

Rim::Rim(const Ellipse& ellipse)
    : center_(ellipse.center), one_axis_(ellipse.one_axis), other_axis_(ellipse.other_axis) {
  if (one_axis_.norm() < other_axis_.norm()) {
    std::swap(one_axis_, other_axis_);
    one_axis_ = -one_axis_;  // the rim runs the same way
  }
  longer_ = one_axis_.norm(), shorter_ = other_axis_.norm();
  normal_ = one_axis_.cross(other_axis_).normalized();
}

Point Rim::at(double angle) const { return center_ + std::cos(angle) * one_axis_ + std::sin(angle) * other_axis_; }

/// The nearest point of the ellipse x = longer^2 u/(t + longer^2), y = shorter^2 v/(t + shorter^2) of a place (u, v)
/// has the root t of a function that falls: Eberly, "Distance from a point to an ellipse" (Geometric Tools, 2013).
double Rim::outside(const Point& x) const {
  const double u = std::abs((x - center_).dot(one_axis_)) / longer_,
               v = std::abs((x - center_).dot(other_axis_)) / shorter_;
  const double a = longer_, b = shorter_;
  const double sign = u * u / (a * a) + v * v / (b * b) < 1 ? -1 : 1;
  if (a == b) return std::hypot(u, v) - a;
  if (v == 0 && u * a < a * a - b * b) {  // between the centres of curvature, on the longer axis
    const double cosine = a * u / (a * a - b * b);
    return sign * std::hypot(a * cosine - u, b * std::sqrt(1 - cosine * cosine));
  }
  double low = -b * b + b * v, high = -b * b + std::hypot(a * u, b * v);
  const auto excess = [&](double t) { return std::pow(a * u / (t + a * a), 2) + std::pow(b * v / (t + b * b), 2) - 1; };
  for (double middle = (low + high) / 2; low < middle && middle < high; middle = (low + high) / 2)
    (excess(middle) > 0 ? low : high) = middle;
  return sign * std::hypot(a * a * u / (high + a * a) - u, (v == 0 ? 0 : b * b * v / (high + b * b)) - v);
}

double Rim::distance(const Point& x) const {
  const double above = height(x);
  return std::hypot(outside(x - above * normal_), above);
}

double Rim::distance_to_disc(const Point& x) const {
  const double above = height(x);
  return std::hypot(std::max(outside(x - above * normal_), 0.0), above);
}

std::array<Point, 2> Rim::farthest_from(const Point& normal) const {
  const double angle = std::atan2(normal.dot(other_axis_), normal.dot(one_axis_));
  return {at(angle), at(angle + std::numbers::pi)};
}

void Rim::for_each_minimum(double reach, const std::function<double(const Point&)>& function,
                           const std::function<void(const Point& at, double value)>& use) const {
  const double step = 2 * std::numbers::pi / samples_of_rim;
  std::array<double, samples_of_rim> values;
  for (int k = 0; k < samples_of_rim; ++k) values[k] = function(at(step * k));
  for (int k = 0; k < samples_of_rim; ++k) {
    const double before = values[(k + samples_of_rim - 1) % samples_of_rim], after = values[(k + 1) % samples_of_rim];
    if (values[k] > std::min(before, after) || values[k] > reach + step * longer_) continue;
    // Kiefer's golden section (Proc. Am. Math. Soc. 4 (1953) 502).
    const double part = std::numbers::phi - 1;
    double low = step * (k - 1), high = step * (k + 1);
    double left = high - part * (high - low), right = low + part * (high - low);
    double at_left = function(at(left)), at_right = function(at(right));
    while (high - low > rounding::of_terms) {
      if (at_left < at_right) {
        high = right, right = left, at_right = at_left;
        at_left = function(at(left = high - part * (high - low)));
      } else {
        low = left, left = right, at_left = at_right;
        at_right = function(at(right = low + part * (high - low)));
      }
    }
    use(at((low + high) / 2), std::min(at_left, at_right));
  }
}

}  // namespace sprekk
