#include "framework/meshing/plane/size_field.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "framework/mesh/search/plane/segment_tree.hpp"
#include "framework/meshing/plane/arrangement.hpp"
#include "framework/meshing/plane/narrow_gaps.hpp"

namespace sprekk {
namespace {

/// A steeper grading gives small angles beside the small edges of a gap.
constexpr double most_growth_from_gaps = 0.5;
/// A piece of a fracture is short if it is shorter, of the edge length there: cells beside it would have angles below 5
/// degrees.
constexpr double short_piece = 0.1;

}  // namespace

SizeField::SizeField(const Geometry& geometry, const MeshOptions& options)
    : box_(geometry.box), far_size_(far_size(geometry, options)), growth_(options.growth) {
  const double tolerance = point_tolerance(geometry.box);
  const auto is_on_boundary = [&](const Point& x) {
    return (x - geometry.box.low).minCoeff() < tolerance || (geometry.box.high - x).minCoeff() < tolerance;
  };
  std::vector<Segment> lines;
  std::vector<const FractureGeometry*> owners;
  for (const FractureGeometry& fracture : geometry.fractures)
    for (std::size_t i = 0; i + 1 < fracture.points.size(); ++i) {
      lines.push_back({fracture.points[i], fracture.points[i + 1]});
      owners.push_back(&fracture);
    }
  const SegmentTree tree(lines);
  const auto is_on_another = [&](const Point& x, const FractureGeometry& own) {
    return std::ranges::any_of(tree.near({x, x}, tolerance),
                               [&](int i) { return owners[i] != &own && distance(x, lines[i]) < tolerance; });
  };
  for (const FractureGeometry& fracture : geometry.fractures) {
    const double size = size_at(fracture, geometry, options);
    for (std::size_t i = 0; i + 1 < fracture.points.size(); ++i) {
      add_source({fracture.points[i], fracture.points[i + 1]}, size, growth_);
    }
    for (const Point& end : {fracture.points.front(), fracture.points.back()}) {
      if (!is_on_boundary(end) && !is_on_another(end, fracture))
        add_source({end, end}, options.tip_size.value_or(size), growth_);
    }
  }
  if (options.gap_edges > 0 && !geometry.fractures.empty()) {
    add_short_pieces(geometry);
    add_gaps(geometry, options);
  }
}

/// Between the points where lines cross, touch and bend, edges can be no longer than the piece: beside an edge that is
/// much shorter than the others, cells would be flat.
void SizeField::add_short_pieces(const Geometry& geometry) {
  const std::vector<Segment> segments = all_segments(geometry);
  const Arrangement arrangement = arrange(segments, point_tolerance(geometry.box));
  const std::size_t first = box_sides.size();
  std::size_t last = first;
  for (const FractureGeometry& fracture : geometry.fractures)
    last += fracture.points.empty() ? 0 : fracture.points.size() - 1;
  std::vector<Segment> pieces;
  for (std::size_t s = first; s < last; ++s) {
    const auto& chain = arrangement.chains[s];
    for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
      const Segment piece{arrangement.points[chain[i]], arrangement.points[chain[i + 1]]};
      if (piece.length() < short_piece * at(0.5 * (piece.from + piece.to))) pieces.push_back(piece);
    }
  }
  std::ranges::stable_sort(pieces, {}, &Segment::length);
  const double growth = std::min(growth_, most_growth_from_gaps);
  for (const Segment& piece : pieces)
    if (piece.length() < short_piece * at(0.5 * (piece.from + piece.to))) add_source(piece, piece.length(), growth);
}

void SizeField::add_gaps(const Geometry& geometry, const MeshOptions& options) {
  double shortest = far_size_;
  for (const SizeSource& source : sources_.all()) shortest = std::min(shortest, source.size);
  const double least = options.gap_size.value_or(least_gap_part * shortest);
  // A gap is narrow if fewer edges than this fit into it.
  const double edges = options.gap_edges, growth = std::min(growth_, most_growth_from_gaps);
  for_each_narrow_gap(
      geometry, {edges * least, edges * far_size_, edges * growth_}, [&](const Point& x) { return edges * at(x); },
      [&](const NarrowGap& gap) {
        const double size = std::max(gap.width / edges, least);
        if (gap.part.length() > options.gap_length * edges * size) return;
        add_source(gap.part, size, growth);
      });
}

void SizeField::add_source(const Segment& segment, double size, double growth) {
  if (size < far_size_) sources_.add({segment, size, growth});
}

double SizeField::smallest() const {
  double smallest = far_size_;
  for (const SizeSource& source : sources_.all()) smallest = std::min(smallest, source.size);
  return smallest;
}

double SizeField::at(const Point& x) const { return sources_.lowered(far_size_, x); }

double SizeField::estimated_triangles() const {
  const double per_area = 4 / std::sqrt(3.0);
  double integral = box_.size().x() * box_.size().y() / (far_size_ * far_size_);
  for (const auto& [segment, size, growth] : sources_.all()) {
    // The integral for h = size + growth * distance: over a strip on either side of a segment, and over a disc around a
    // point.
    integral += 2 * segment.length() * (1 / size - 1 / far_size_) / growth;
    integral += 2 * std::numbers::pi / (growth * growth) * (std::log(far_size_ / size) - 1 + size / far_size_);
  }
  return per_area * integral;
}

}  // namespace sprekk
