#include "framework/meshing/space/sizes_in_space.hpp"

#include <algorithm>
#include <cmath>

#include "framework/meshing/space/outer_sides.hpp"

namespace sprekk {

SizesInSpace::SizesInSpace(const Geometry& geometry, const MeshOptions& options)
    : box_(geometry.box), far_size_(far_size(geometry, options)), growth_(options.growth) {
  const double tolerance = point_tolerance(geometry.box);
  const auto is_on_side = [&](const Line& edge) {
    for (int axis = 0; axis < dimension; ++axis)
      for (const double side : {box_.low[axis], box_.high[axis]})
        if (std::abs(edge.from[axis] - side) < tolerance && std::abs(edge.to[axis] - side) < tolerance) return true;
    return false;
  };
  for (const FractureGeometry& fracture : geometry.fractures) {
    const double size = size_at(fracture, geometry, options), rim_size = options.tip_size.value_or(size);
    FlatShape shape(fracture);
    Source source{shape, size, rim_size, {}, shape.low(), shape.high(), 2};
    if (rim_size < size)
      for (const Line& edge : edges_of(shape.corners()))
        if (!is_on_side(edge)) source.rim.push_back(edge);
    if (std::min(size, rim_size) < far_size_) sources_.push_back(std::move(source));
  }
  for (const SidePart& part : geometry.side_parts)
    if (const double size = part.size.value_or(far_size_); size < far_size_) {
      const FlatShape shape(corners_of(part, box_));
      sources_.push_back({shape, size, size, {}, shape.low(), shape.high(), 1});
    }
}

double SizesInSpace::at(const Point& x) const {
  double size = far_size_;
  for (const Source& source : sources_) {
    const double away = (x - x.cwiseMax(source.low).cwiseMin(source.high)).norm();
    if (std::min(source.size, source.rim_size) + growth_ * away >= size) continue;
    size = std::min(size, source.size + growth_ * source.shape.distance(x));
    for (const Line& edge : source.rim)
      size = std::min(size, source.rim_size + growth_ * (nearest_point(x, edge) - x).norm());
  }
  return size;
}

double SizesInSpace::smallest() const {
  double smallest = far_size_;
  for (const Source& source : sources_)
    smallest = std::min({smallest, source.size, source.rim.empty() ? source.size : source.rim_size});
  return smallest;
}

double SizesInSpace::estimated_cells() const {
  const double per_volume = 6 * std::sqrt(2.0);
  const auto cubed = [](double size) { return size * size * size; };
  double integral = box_.size().prod() / cubed(far_size_);
  // For h = size + growth * distance: over the layers beside a fracture or a part of a side, and over the surroundings
  // of its rim.
  for (const Source& source : sources_) {
    if (source.size < far_size_)
      integral += source.layers * source.shape.area() / (2 * growth_) *
                  (1 / (source.size * source.size) - 1 / (far_size_ * far_size_));
    for (const Line& edge : source.rim)
      integral += M_PI * (edge.to - edge.from).norm() / (growth_ * growth_) *
                  (1 / source.rim_size - 2 / far_size_ + source.rim_size / (far_size_ * far_size_));
  }
  return per_volume * integral;
}

}  // namespace sprekk
