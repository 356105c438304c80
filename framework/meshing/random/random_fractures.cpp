#include "framework/meshing/random/random_fractures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "framework/meshing/distinct_text.hpp"
#include "framework/meshing/random/placing.hpp"

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
  Point rounded(const Point& x) const {
    return x.unaryExpr([this](double coordinate) { return rounded(coordinate); });
  }

 private:
  static constexpr int digits = 6;  // below the box: far below a cell
  int exponent_;
  double power_ = 1;
};

struct Drawn {
  double length;
  std::vector<Point> points;  ///< m, from its middle
};

/// `room`: the area, or in space the volume, for their middles.
std::vector<Drawn> draw_shapes(const RandomFractures& set, double room) {
  const auto refused = [&](const std::string& what, const std::string& advice) {
    return InputError(
        set.origin, fmt::format("the random set '{}' {}", set.name, what),
        fmt::format("the {} for its middles is {:.4g} m^{}", dimension == 2 ? "area" : "volume", room, dimension),
        advice);
  };
  RandomNumbers lengths(set.seed, set.name + " length"), angles(set.seed, set.name + " angle");
  const double wanted = set.intensity ? *set.intensity * room : 0;
  const double count = set.number ? *set.number : set.density ? std::round(*set.density * room) : 0;
  std::vector<Drawn> drawn;
  double sum = 0;
  const auto is_complete = [&](double next) {
    return set.intensity ? sum + 0.5 * next > wanted : static_cast<double>(drawn.size()) >= count;
  };
  for (;;) {
    const double length = set.length.draw(lengths.uniform());
    const double measure = dimension == 2 ? length : length * length;
    if (is_complete(measure)) break;
    if (drawn.size() == most_random_fractures)
      throw refused(fmt::format("has more than {} fractures", most_random_fractures),
                    "lower its density or intensity, or its region");
    drawn.push_back({length, points_around_middle(set, length, angles)});
    sum += measure;
  }
  if (drawn.empty()) throw refused("has no fracture", "raise its number, density or intensity");
  std::stable_sort(drawn.begin(), drawn.end(), [](const Drawn& a, const Drawn& b) { return a.length > b.length; });
  return drawn;
}

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
  const auto place = placer(geometry, set);
  RandomNumbers places(set.seed, set.name + " place");
  const std::vector<Drawn> drawn = draw_shapes(set, region.size().prod());
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    const double length = drawn[i].length;
    bool is_placed = false;
    for (int k = 0; k < most_tries && !is_placed; ++k) {
      Point share;
      for (double& value : share) value = places.uniform();
      const Point middle = region.low + region.size().cwiseProduct(share);
      std::vector<Point> points;
      // In space rounded points would leave their plane.
      for (const Point& point : drawn[i].points)
        points.push_back(dimension == 2 ? grid.rounded(middle + point) : Point(middle + point));
      is_placed = place(points);
      if (is_placed)
        geometry.fractures.push_back({fmt::format("{}_{}", set.name, i + 1), points, std::nullopt, set.origin});
    }
    if (!is_placed)
      throw InputError(
          set.origin,
          fmt::format("there is no place for fracture {} of {} of the random set '{}'", i + 1, drawn.size(), set.name),
          fmt::format("it is {:.4g} m long, and must lie in the box, {:.3g} m or more from {} of others, "
                      "sides and crossings, and cross others at {:.3g} degrees or more",
                      length, set.least_gap, dimension == 2 ? "ends" : "rims",
                      set.least_angle * 180 / std::numbers::pi),
          "ask for fewer or shorter fractures, or lower 'gap' or 'angle'");
  }
}

}  // namespace sprekk
