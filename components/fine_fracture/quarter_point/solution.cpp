#include "components/fine_fracture/quarter_point/solution.hpp"

#include <Eigen/LU>
#include <cmath>

#include "components/fine_fracture/quarter_point/shapes.hpp"
#include "framework/mesh/mesh.hpp"

namespace sprekk::fine_fracture {

std::optional<ElementPlace> find_place(const FineMesh& mesh, const Point& x) {
  constexpr double tolerance = 1e-12;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    const FineMesh::Element& element = mesh.elements[e];
    const Point& origin = mesh.nodes[element.nodes[0]];
    Tensor sides;
    sides << mesh.nodes[element.nodes[1]] - origin, mesh.nodes[element.nodes[2]] - origin;
    const Point local = sides.inverse() * (x - origin);
    if (local.minCoeff() < -tolerance || local.sum() > 1 + tolerance) continue;
    // In a quarter-point element x = (xi + eta) (xi X1 + eta X2).
    const double scale = element.tip == none ? 1 : 1 / std::sqrt(std::max(local.sum(), 1e-300));
    return ElementPlace{static_cast<int>(e), local.x() * scale, local.y() * scale};
  }
  return std::nullopt;
}

Point FineSolution::displacement_at(const ElementPlace& place) const {
  const FineMesh::Element& element = mesh->elements[place.element];
  const ShapePoint p = shape_point(*mesh, element, place.xi, place.eta);
  Point u = Point::Zero();
  for (int k = 0; k < 6; ++k) u += p.value[k] * displacement.segment<2>(2 * element.nodes[k]);
  return u;
}

Tensor FineSolution::gradient_at(const ElementPlace& place) const {
  const FineMesh::Element& element = mesh->elements[place.element];
  const ShapePoint p = shape_point(*mesh, element, place.xi, place.eta);
  Tensor g = Tensor::Zero();
  for (int k = 0; k < 6; ++k) g += displacement.segment<2>(2 * element.nodes[k]) * p.gradient.row(k);
  return g;
}

}  // namespace sprekk::fine_fracture
