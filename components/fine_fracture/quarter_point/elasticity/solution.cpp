#include "components/fine_fracture/quarter_point/elasticity/solution.hpp"

#include "components/fine_fracture/quarter_point/elasticity/shapes.hpp"

namespace sprekk::fine_fracture {

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
