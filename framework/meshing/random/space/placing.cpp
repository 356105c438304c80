#include "framework/meshing/random/placing.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "framework/meshing/random/random_fractures.hpp"
#include "framework/meshing/space/flat_shape.hpp"
#include "framework/meshing/space/region_borders.hpp"
#include "framework/meshing/space/strike_and_dip.hpp"

namespace sprekk {
namespace {

/// The polygons that new fractures must keep away from.
class Obstacles {
 public:
  Obstacles(const Geometry& geometry, const RandomFractures& set) : box_(geometry.box), set_(set) {
    for (const FractureGeometry& fracture : geometry.fractures) shapes_.emplace_back(fracture);
    for (const std::vector<Point>& border : region_borders(geometry)) shapes_.emplace_back(border);
  }

  /// Adds the fracture if it keeps away from all others.
  bool add(const std::vector<Point>& points) {
    for (const Point& point : points) {
      const double depth = std::min((point - box_.low).minCoeff(), (box_.high - point).minCoeff());
      if (depth < set_.least_gap || depth <= 0) return false;
    }
    const FlatShape shape(points);
    if (!std::ranges::all_of(shapes_, [&](const FlatShape& other) { return keep_away(shape, other); })) return false;
    shapes_.push_back(shape);
    return true;
  }

 private:
  bool keep_away(const FlatShape& one, const FlatShape& other) const {
    const double gap = std::max(set_.least_gap, point_tolerance(box_));
    const Point apart = (one.low() - other.high()).cwiseMax(other.low() - one.high());
    if (apart.maxCoeff() > gap) return true;
    bool is_near = false, cross = false;
    for (const auto& [a, b] : {std::pair(&one, &other), std::pair(&other, &one)}) {
      for (const Point& corner : a->corners()) is_near = is_near || b->distance(corner) < gap;
      for (const auto& [from, to] : edges_of(a->corners())) {
        const double at_from = b->height(from), at_to = b->height(to);
        cross = cross ||
                (at_from * at_to < 0 && b->contains(b->in_plane(from + at_from / (at_from - at_to) * (to - from)), 0));
      }
    }
    for (const Line& edge : edges_of(one.corners()))
      for (const Line& across : edges_of(other.corners())) {
        const auto [x, y] = nearest_points(edge, across);
        is_near = is_near || (x - y).norm() < gap;
      }
    const double angle =
        std::atan2(one.normal().cross(other.normal()).norm(), std::abs(one.normal().dot(other.normal())));
    return !is_near && !(cross && angle < set_.least_angle);
  }

  const Box box_;
  const RandomFractures& set_;
  std::vector<FlatShape> shapes_;
};

/// A random unit vector with the density ~ exp(concentration cos(angle to the mean)) (Fisher, Proc. R. Soc. A 217
/// (1953) 295); 0 is uniform.
Point fisher(const Point& mean, double concentration, RandomNumbers& random) {
  const double u = random.uniform(), turn = 2 * std::numbers::pi * random.uniform();
  const double cosine =
      concentration > 0 ? 1 + std::log(u + (1 - u) * std::exp(-2 * concentration)) / concentration : 2 * u - 1;
  const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
  const Point one = mean.unitOrthogonal(), other = mean.cross(one);
  return cosine * mean + sine * (std::cos(turn) * one + std::sin(turn) * other);
}

}  // namespace

std::vector<Point> points_around_middle(const RandomFractures& set, double length, RandomNumbers& directions) {
  const StrikeAndDip mean{set.mean_strike, set.mean_dip};
  Point normal = fisher(mean.along_strike().cross(mean.up_dip()), set.concentration, directions);
  if (normal.z() < 0) normal = -normal;
  // The strike has the horizontal part of the normal to its right.
  const StrikeAndDip plane{std::atan2(-normal.y(), normal.x()),
                           std::atan2(std::hypot(normal.x(), normal.y()), normal.z())};
  return rectangle(Point::Zero(), plane, length, length);
}

std::function<bool(const std::vector<Point>&)> placer(const Geometry& geometry, const RandomFractures& set) {
  const auto obstacles = std::make_shared<Obstacles>(geometry, set);
  return [obstacles](const std::vector<Point>& points) { return obstacles->add(points); };
}

}  // namespace sprekk
