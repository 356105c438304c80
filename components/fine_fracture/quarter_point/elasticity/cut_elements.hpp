// Elements that a border between two stiffnesses crosses.
#pragma once

#include "components/fine_fracture/fine_level/fine_rock.hpp"
#include "components/fine_fracture/quarter_point/mesh/fine_mesh.hpp"

namespace sprekk::fine_fracture {

/// Of the rule for stiffness and stress offset in elements that are cut; both have to be taken at the same places.
constexpr int degree_of_cut = 6;

/// Whether the element has two stiffnesses; false in rosettes, which have rules of their own.
bool is_cut(const FineMesh& mesh, const FineMesh::Element& element, const FineRock& rock);

}  // namespace sprekk::fine_fracture
