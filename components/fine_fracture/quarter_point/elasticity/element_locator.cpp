#include "components/fine_fracture/quarter_point/elasticity/element_locator.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "framework/mesh/mesh.hpp"

namespace sprekk::fine_fracture {

ElementLocator::ElementLocator(const FineMesh& mesh) : mesh_(mesh), low_(mesh.nodes[0]) {
  Point high = low_;
  for (const Point& x : mesh.nodes) low_ = low_.cwiseMin(x), high = high.cwiseMax(x);
  const Point size = high - low_;
  width_ = std::sqrt(size.x() * size.y() / static_cast<double>(mesh.elements.size()));
  for (int d = 0; d < 2; ++d) counts_[d] = static_cast<int>(size[d] / width_) + 1;
  buckets_.resize(counts_[0] * counts_[1]);
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    const auto& nodes = mesh.elements[e].nodes;
    Point from = mesh.nodes[nodes[0]], to = from;
    for (int k = 1; k < 3; ++k) from = from.cwiseMin(mesh.nodes[nodes[k]]), to = to.cwiseMax(mesh.nodes[nodes[k]]);
    const auto first = bucket_of(from), last = bucket_of(to);
    for (int i = first[0]; i <= last[0]; ++i) {
      for (int j = first[1]; j <= last[1]; ++j) buckets_[i * counts_[1] + j].push_back(static_cast<int>(e));
    }
  }
}

std::array<int, 2> ElementLocator::bucket_of(const Point& x) const {
  std::array<int, 2> bucket;
  for (int d = 0; d < 2; ++d) {
    bucket[d] = static_cast<int>(std::clamp((x[d] - low_[d]) / width_, 0.0, counts_[d] - 1.0));
  }
  return bucket;
}

std::optional<ElementPlace> ElementLocator::place_in(int e, const Point& x) const {
  constexpr double tolerance = 1e-12;  // of an element: round-off of points on an edge
  const FineMesh::Element& element = mesh_.elements[e];
  const Point& origin = mesh_.nodes[element.nodes[0]];
  Tensor sides;
  sides << mesh_.nodes[element.nodes[1]] - origin, mesh_.nodes[element.nodes[2]] - origin;
  const Point local = sides.inverse() * (x - origin);
  if (local.minCoeff() < -tolerance || local.sum() > 1 + tolerance) return std::nullopt;
  // In a quarter-point element x = (xi + eta) (xi X1 + eta X2).
  const double scale = element.tip == none || local.sum() <= 0 ? 1 : 1 / std::sqrt(local.sum());
  return ElementPlace{e, local.x() * scale, local.y() * scale};
}

std::optional<ElementPlace> ElementLocator::find(const Point& x) const {
  const auto bucket = bucket_of(x);
  for (const int e : buckets_[bucket[0] * counts_[1] + bucket[1]]) {
    if (const auto place = place_in(e, x)) return place;
  }
  return std::nullopt;
}

}  // namespace sprekk::fine_fracture
