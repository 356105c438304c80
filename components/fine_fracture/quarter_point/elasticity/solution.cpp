#include "components/fine_fracture/quarter_point/elasticity/solution.hpp"

#include "components/fine_fracture/quarter_point/elasticity/shapes.hpp"
#include "framework/invariants.hpp"

namespace sprekk::fine_fracture {

Point FineSolution::displacement_at(const ElementPlace& place) const {
  const FineMesh::Element& element = mesh->elements[place.element];
  SPREKK_EXPECT(is_index(place.element, static_cast<long>(mesh->elements.size())), place.element);
  SPREKK_EXPECT(displacement.size() == 2 * mesh->node_count(), displacement.size(), mesh->node_count());
  const ShapePoint p = shape_point(*mesh, element, place.xi, place.eta);
  Point u = Point::Zero();
  for (int k = 0; k < 6; ++k) u += p.value[k] * displacement.segment<2>(2 * element.nodes[k]);
  return u;
}

Tensor FineSolution::gradient_at(const ElementPlace& place) const {
  SPREKK_EXPECT(is_index(place.element, static_cast<long>(mesh->elements.size())), place.element);
  const FineMesh::Element& element = mesh->elements[place.element];
  const ShapePoint p = shape_point(*mesh, element, place.xi, place.eta);
  Tensor g = Tensor::Zero();
  for (int k = 0; k < 6; ++k) g += displacement.segment<2>(2 * element.nodes[k]) * p.gradient.row(k);
  return g;
}

Tensor FineSolution::elastic_stress_at(const ElementPlace& place) const {
  const Point x = shape_point(*mesh, mesh->elements[place.element], place.xi, place.eta).x;
  return rock.at(x).stress(0.5 * (gradient_at(place) + gradient_at(place).transpose()));
}

}  // namespace sprekk::fine_fracture
