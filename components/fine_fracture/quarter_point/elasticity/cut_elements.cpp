#include "components/fine_fracture/quarter_point/elasticity/cut_elements.hpp"

#include <optional>

#include "components/fine_fracture/fine_level/quadrature.hpp"
#include "components/fine_fracture/quarter_point/elasticity/shapes.hpp"

namespace sprekk::fine_fracture {

bool is_cut(const FineMesh& mesh, const FineMesh::Element& element, const FineRock& rock) {
  if (rock.is_uniform() || element.tip != none) return false;
  std::optional<Elasticity> first;
  for (const TrianglePoint& place : triangle_rule(degree_of_cut)) {
    const Elasticity here = rock.at(shape_point(mesh, element, place.xi, place.eta).x);
    if (first && !(here == *first)) return true;
    first = here;
  }
  return false;
}

}  // namespace sprekk::fine_fracture
