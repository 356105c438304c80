// Tips of fractures around which pressures are taken to be linear, as elsewhere.
#pragma once

#include <string>
#include <vector>

#include "components/matrix_flow/flux_operators.hpp"
#include "framework/assembly/notes.hpp"
#include "framework/discretization/uncorrected_ends.hpp"

namespace sprekk::matrix_flow {

/// The tips of fractures whose flow (TipFlow) is missing, or is missing at a node next to the tip. `mobility`: one a
/// cell, m^2/(Pa s).
UncorrectedEnds uncorrected_tips(const Mesh& mesh, const std::vector<Tensor>& mobility);

/// Notes how many tips of the flow `name` are uncorrected, and why; in space if they are at least half of the nodes of
/// rims.
void note_uncorrected_tips(Notes& notes, const std::string& name, const Mesh& mesh,
                           const std::vector<Tensor>& mobility);

}  // namespace sprekk::matrix_flow
