#include "framework/meshing/size_field.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "framework/meshing/narrow_gaps.hpp"

namespace sprekk {
namespace {

/// A steeper grading gives small angles beside the small edges of a gap.
constexpr double most_growth_from_gaps = 0.5;

}  // namespace

SizeField::SizeField(const Geometry& geometry, const MeshOptions& options)
    : box_(geometry.box), far_size_(far_size(geometry, options)), growth_(options.growth) {
  const double tolerance = point_tolerance(geometry.box);
  const auto is_on_boundary = [&](const Point& x) {
    return (x - geometry.box.low).minCoeff() < tolerance || (geometry.box.high - x).minCoeff() < tolerance;
  };
  const auto is_on_another = [&](const Point& x, const FractureGeometry& own) {
    for (const FractureGeometry& other : geometry.fractures) {
      if (&other == &own) continue;
      for (std::size_t i = 0; i + 1 < other.points.size(); ++i)
        if (distance(x, {other.points[i], other.points[i + 1]}) < tolerance) return true;
    }
    return false;
  };
  for (const FractureGeometry& fracture : geometry.fractures) {
    const double size = fracture.size.value_or(options.fracture_size.value_or(far_size_));
    for (std::size_t i = 0; i + 1 < fracture.points.size(); ++i) {
      add_source({fracture.points[i], fracture.points[i + 1]}, size, growth_);
    }
    for (const Point& end : {fracture.points.front(), fracture.points.back()}) {
      if (!is_on_boundary(end) && !is_on_another(end, fracture))
        add_source({end, end}, options.tip_size.value_or(size), growth_);
    }
  }
  fill_buckets();
  if (options.gap_edges > 0 && !geometry.fractures.empty()) add_gaps(geometry, options);
}

void SizeField::add_gaps(const Geometry& geometry, const MeshOptions& options) {
  double shortest = far_size_;
  for (const Source& source : sources_) shortest = std::min(shortest, source.size);
  const double least = options.gap_size.value_or(least_gap_part * shortest);
  // A gap is narrow if fewer edges than this fit into it.
  const double edges = options.gap_edges, growth = std::min(growth_, most_growth_from_gaps);
  for_each_narrow_gap(
      geometry, {edges * least, edges * far_size_, edges * growth_}, [&](const Point& x) { return edges * at(x); },
      [&](const NarrowGap& gap) {
        const double size = std::max(gap.width / edges, least);
        if (gap.part.length() > options.gap_length * edges * size) return;
        if (add_source(gap.part, size, growth)) put_into_buckets(static_cast<int>(sources_.size()) - 1);
      });
}

bool SizeField::add_source(const Segment& segment, double size, double growth) {
  if (size >= far_size_) return false;
  sources_.push_back({segment, size, growth, (far_size_ - size) / growth});
  return true;
}

int SizeField::bucket(int axis, double coordinate) const {
  const double place = (coordinate - box_.low[axis]) / (box_.high[axis] - box_.low[axis]) * buckets_a_side_;
  return static_cast<int>(std::clamp(place, 0.0, buckets_a_side_ - 1.0));
}

void SizeField::fill_buckets() {
  buckets_a_side_ = 1 + 2 * static_cast<int>(std::sqrt(sources_.size()));
  buckets_.resize(buckets_a_side_ * buckets_a_side_);
  for (int s = 0; s < static_cast<int>(sources_.size()); ++s) put_into_buckets(s);
}

void SizeField::put_into_buckets(int source) {
  const auto& [segment, size, growth, reach] = sources_[source];
  const Point low = segment.from.cwiseMin(segment.to).array() - reach;
  const Point high = segment.from.cwiseMax(segment.to).array() + reach;
  for (int j = bucket(1, low.y()); j <= bucket(1, high.y()); ++j) {
    for (int i = bucket(0, low.x()); i <= bucket(0, high.x()); ++i) {
      buckets_[j * buckets_a_side_ + i].push_back(source);
    }
  }
}

/// The smaller one of `size` and the size that the source asks for.
double SizeField::lowered(double size, const Source& source, const Point& x) {
  const Point &a = source.segment.from, &b = source.segment.to;
  const double reach = (size - source.size) / source.growth;
  if (x.x() < std::min(a.x(), b.x()) - reach || x.x() > std::max(a.x(), b.x()) + reach ||
      x.y() < std::min(a.y(), b.y()) - reach || x.y() > std::max(a.y(), b.y()) + reach) {
    return size;
  }
  return std::min(size, source.size + source.growth * distance(x, source.segment));
}

double SizeField::smallest() const {
  double smallest = far_size_;
  for (const Source& source : sources_) smallest = std::min(smallest, source.size);
  return smallest;
}

double SizeField::at(const Point& x) const {
  double size = far_size_;
  for (const int s : buckets_[bucket(1, x.y()) * buckets_a_side_ + bucket(0, x.x())])
    size = lowered(size, sources_[s], x);
  return size;
}

double SizeField::estimated_triangles() const {
  const double per_area = 4 / std::sqrt(3.0);
  double integral = box_.size().x() * box_.size().y() / (far_size_ * far_size_);
  for (const auto& [segment, size, growth, reach] : sources_) {
    // The integral for h = size + growth * distance: over a strip on either side of a segment, and over a disc around a
    // point.
    integral += 2 * segment.length() * (1 / size - 1 / far_size_) / growth;
    integral += 2 * std::numbers::pi / (growth * growth) * (std::log(far_size_ / size) - 1 + size / far_size_);
  }
  return per_area * integral;
}

}  // namespace sprekk
