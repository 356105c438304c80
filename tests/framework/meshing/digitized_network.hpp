// A network of traces with the slips of digitizing.
#pragma once

#include <cmath>
#include <random>

#include "framework/mesh/plane/planar.hpp"
#include "tests/framework/mesh/mesh_checks.hpp"

namespace sprekk::test {

/// Polylines in a box of 100 m, some of which end 1e-7 to 1e-3 of a cell of 2 m beside another one, pass a point of
/// another one at such a distance, or are drawn a second time so far beside the first. Others do not come near one
/// another at less than `least_angle` (rad).
inline Geometry digitized_network(int count, unsigned seed, double least_angle = 0) {
  constexpr double cell = 2;
  std::mt19937 random(seed);
  const auto draw = [&](double low, double high) {
    return low + (high - low) * (random() / (std::mt19937::max() + 1.0));
  };
  const auto slip = [&] { return cell * std::pow(10, draw(-7, -3)); };
  Geometry geometry = box(0, 100, 0, 100);
  auto& fractures = geometry.fractures;
  const auto some = [&]() -> const FractureGeometry& { return fractures[random() % fractures.size()]; };
  const auto keeps_off = [&](const FractureGeometry& trace) {
    for (const FractureGeometry& other : fractures)
      for (std::size_t i = 0; i + 1 < trace.points.size(); ++i)
        for (std::size_t k = 0; k + 1 < other.points.size(); ++k) {
          const Segment one{trace.points[i], trace.points[i + 1]}, two{other.points[k], other.points[k + 1]};
          const Point u = one.to - one.from, v = two.to - two.from;
          const double angle = std::atan2(std::abs(cross(u, v)), std::abs(u.dot(v)));
          if (angle < least_angle && distance(one, two) < cell) return false;
        }
    return true;
  };
  while (static_cast<int>(fractures.size()) < count) {
    const int number = static_cast<int>(fractures.size());
    FractureGeometry trace = fracture("k" + std::to_string(number), {}, number + 2);
    double direction = (number % 2 == 0 ? 0.6 : 2.1) + draw(-0.25, 0.25);
    const double length = draw(4, 20);
    const int steps = static_cast<int>(draw(2, 7));
    Point x(draw(10, 90), draw(10, 90));
    for (int i = 0; i <= steps; ++i) {
      trace.points.push_back(x);
      direction += draw(-0.15, 0.15);
      x += length / steps * Point(std::cos(direction), std::sin(direction));
    }
    bool is_copy = false;
    if (number > 5 && number % 3 == 0) {
      const FractureGeometry& other = some();
      const Point from = other.points[0], along = other.points[1] - from;
      const Point end = from + draw(0.1, 0.9) * along +
                        (number % 2 == 0 ? 1 : -1) * slip() * Point(-along.y(), along.x()).normalized();
      const Point shift = end - trace.points.back();
      for (Point& point : trace.points) point += shift;
    } else if (number > 5 && number % 7 == 0) {
      const Point shift = slip() * Point(draw(0, 1), draw(0, 1));
      trace.points = some().points;
      for (Point& point : trace.points) point += shift;
      is_copy = true;
    } else if (number > 5 && number % 11 == 0) {
      const Point at = some().points[1], half = 5 * Point(std::cos(length), std::sin(length));
      trace.points = {at - half + slip() * Point(1, 0), at + half + slip() * Point(0, 1)};
    }
    const auto is_inside = [](const Point& point) { return point.minCoeff() > 1 && point.maxCoeff() < 99; };
    if (std::ranges::all_of(trace.points, is_inside) && (is_copy || keeps_off(trace)))
      fractures.push_back(std::move(trace));
  }
  return geometry;
}

}  // namespace sprekk::test
