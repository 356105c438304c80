// Elements that a border between two stiffnesses crosses.
#pragma once

#include "components/fine_fracture/fine_level/fine_rock.hpp"
#include "components/fine_fracture/fine_level/quadrature.hpp"
#include "components/fine_fracture/quarter_point/mesh/fine_mesh.hpp"

namespace sprekk::fine_fracture {

/// The rule for an element outside of rosettes, which have rules of their own: for polynomials of `degree`, on each
/// side of a border (FineRock::borders) that cuts it in two. So integrals are continuous when the mesh moves across a
/// border. Where the stiffness differs in another way, a rule of degree 6 or higher. Valid until the next call.
const std::vector<TrianglePoint>& element_rule(const FineMesh& mesh, const FineMesh::Element& element,
                                               const FineRock& rock, int degree);

/// The stiffness of an element of a rosette: the mean over it where a border cuts it in two. Quarter-point elements
/// assume one rock around the tip, so K so near to a border is an approximation; the mean makes it continuous.
Elasticity rosette_stiffness(const FineMesh& mesh, const FineMesh::Element& element, const FineRock& rock);

}  // namespace sprekk::fine_fracture
