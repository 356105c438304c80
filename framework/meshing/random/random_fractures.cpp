#include "framework/meshing/random/random_fractures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "framework/mesh/plane/planar.hpp"
#include "framework/meshing/distinct_text.hpp"
#include "framework/meshing/random/random_laws.hpp"

namespace sprekk {
namespace {

/// How often a place is drawn for one fracture: beyond, hardly a 10,000th of the region is free for it.
constexpr int most_tries = 10000;

void require_inside(const Box& region, const Box& box) {
  if ((region.low - box.low).minCoeff() >= 0 && (box.high - region.high).minCoeff() >= 0) return;
  throw InputError(region.origin, "the region of a random set leaves the box",
                   fmt::format("it reaches from {} to {}, and the box from {} to {}",
                               distinct_text(region.low, box.low), distinct_text(region.high, box.high),
                               distinct_text(box.low, region.low), distinct_text(box.high, region.high)),
                   "move it into the box, or leave it out");
}

double area_of(const Box& box) { return box.size().prod(); }

/// The grid on which coordinates lie: the power of ten below 1e-6 times the longer side.
class DecimalGrid {
 public:
  explicit DecimalGrid(const Box& box)
      : exponent_(static_cast<int>(std::floor(std::log10(box.size().maxCoeff()))) - digits) {
    for (int i = 0; i < std::abs(exponent_); ++i) power_ *= 10;
  }
  /// The nearest number of the grid, which is the nearest double to a decimal number of few digits.
  double rounded(double x) const {
    return exponent_ < 0 ? std::round(x * power_) / power_ : std::round(x / power_) * power_;
  }
  Point rounded(const Point& x) const { return {rounded(x.x()), rounded(x.y())}; }

 private:
  static constexpr int digits = 6;
  int exponent_;
  double power_ = 1;
};

struct Drawn {
  double length, angle;
};

std::vector<Drawn> draw_lengths_and_angles(const RandomFractures& set, double area) {
  const auto refused = [&](const std::string& what, const std::string& advice) {
    return InputError(set.origin, fmt::format("the random set '{}' {}", set.name, what),
                      fmt::format("the area for its middles is {:.4g} m^2", area), advice);
  };
  RandomNumbers lengths(set.seed, set.name + " length"), angles(set.seed, set.name + " angle");
  const double wanted = set.intensity ? *set.intensity * area : 0;
  const double count = set.number ? *set.number : set.density ? std::round(*set.density * area) : 0;
  std::vector<Drawn> drawn;
  double sum = 0;
  const auto is_complete = [&](double next) {
    return set.intensity ? sum + 0.5 * next > wanted : static_cast<double>(drawn.size()) >= count;
  };
  for (;;) {
    const double length = set.length.draw(lengths.uniform());
    if (is_complete(length)) break;
    if (drawn.size() == most_random_fractures)
      throw refused(fmt::format("has more than {} fractures", most_random_fractures),
                    "lower its density or intensity, or its region");
    drawn.push_back({length, set.mean_angle + von_mises(angles, set.concentration)});
    sum += length;
  }
  if (drawn.empty()) throw refused("has no fracture", "raise its number, density or intensity");
  std::stable_sort(drawn.begin(), drawn.end(), [](const Drawn& a, const Drawn& b) { return a.length > b.length; });
  return drawn;
}

void append_segments(const std::vector<Point>& points, bool closed, std::vector<Segment>& segments) {
  for (std::size_t i = 0; i + 1 < points.size(); ++i) segments.push_back({points[i], points[i + 1]});
  if (closed) segments.push_back({points.back(), points.front()});
}

/// The acute angle between two lines, rad.
double angle_between(const Segment& a, const Segment& b) {
  const Point u = a.to - a.from, v = b.to - b.from;
  return std::atan2(std::abs(cross(u, v)), std::abs(u.dot(v)));
}

/// The lines that new fractures must keep away from, and where they cross.
class Obstacles {
 public:
  Obstacles(const Geometry& geometry, const RandomFractures& set) : box_(geometry.box), set_(set) {
    for (const FractureGeometry& fracture : geometry.fractures) append_segments(fracture.points, false, lines_);
    for (const RegionGeometry& region : geometry.regions)
      if (!region.polygon.empty()) append_segments(region.polygon, true, lines_);
    Point crossing;
    for (std::size_t i = 0; i < lines_.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        if (cross_inside(lines_[i], lines_[j], crossing)) crossings_.push_back(crossing);
  }

  /// Adds the fracture if it keeps away from all others.
  bool add(const Segment& fracture) {
    for (const Point& end : {fracture.from, fracture.to}) {
      const double depth = std::min((end - box_.low).minCoeff(), (box_.high - end).minCoeff());
      if (depth < set_.least_gap || depth <= 0) return false;
    }
    std::vector<Point> crossings;
    for (const Segment& line : lines_)
      if (!keeps_away(fracture, line, crossings)) return false;
    lines_.push_back(fracture);
    crossings_.insert(crossings_.end(), crossings.begin(), crossings.end());
    return true;
  }

 private:
  bool keeps_away(const Segment& fracture, const Segment& line, std::vector<Point>& crossings) const {
    const double nearest = std::min({distance(fracture.from, line), distance(fracture.to, line),
                                     distance(line.from, fracture), distance(line.to, fracture)});
    if (nearest < set_.least_gap || nearest < point_tolerance(box_)) return false;
    Point crossing;
    if (!cross_inside(fracture, line, crossing)) return true;
    if (angle_between(fracture, line) < set_.least_angle) return false;
    const auto is_near = [&](const Point& other) { return (other - crossing).norm() < set_.least_gap; };
    if (std::ranges::any_of(crossings_, is_near) || std::ranges::any_of(crossings, is_near)) return false;
    crossings.push_back(crossing);
    return true;
  }

  const Box box_;
  const RandomFractures& set_;
  std::vector<Segment> lines_;
  std::vector<Point> crossings_;
};

}  // namespace

double LengthLaw::draw(double u) const {
  switch (kind) {
    case Kind::constant:
      return value;
    case Kind::power:
      return power_law(u, exponent, shortest, longest);
    case Kind::lognormal:
      return lognormal(u, median, deviation, shortest, longest);
  }
  return value;
}

void draw_fractures(const RandomFractures& set, Geometry& geometry) {
  const Box region = set.region.value_or(geometry.box);
  require_inside(region, geometry.box);
  const DecimalGrid grid(geometry.box);
  Obstacles obstacles(geometry, set);
  RandomNumbers places(set.seed, set.name + " place");
  const std::vector<Drawn> drawn = draw_lengths_and_angles(set, area_of(region));
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    const auto& [length, angle] = drawn[i];
    const Point half = 0.5 * length * Point(std::cos(angle), std::sin(angle));
    bool is_placed = false;
    for (int k = 0; k < most_tries && !is_placed; ++k) {
      const double u = places.uniform(), v = places.uniform();
      const Point middle = region.low + region.size().cwiseProduct(Point(u, v));
      const Segment fracture{grid.rounded(middle - half), grid.rounded(middle + half)};
      is_placed = obstacles.add(fracture);
      if (is_placed)
        geometry.fractures.push_back(
            {fmt::format("{}_{}", set.name, i + 1), {fracture.from, fracture.to}, std::nullopt, set.origin});
    }
    if (!is_placed)
      throw InputError(
          set.origin,
          fmt::format("there is no place for fracture {} of {} of the random set '{}'", i + 1, drawn.size(), set.name),
          fmt::format("it is {:.4g} m long, and must lie in the box, {:.3g} m or more from ends of others, "
                      "sides and crossings, and cross others at {:.3g} degrees or more",
                      length, set.least_gap, set.least_angle * 180 / std::numbers::pi),
          "ask for fewer or shorter fractures, or lower 'gap' or 'angle'");
  }
}

}  // namespace sprekk
