// Tips of fractures around which pressures are taken to be linear, as elsewhere.
#pragma once

#include <string>
#include <vector>

#include "components/matrix_flow/flux_operators.hpp"

namespace sprekk::matrix_flow {

/// How many tips of a mesh get no correction of their flow, where the first of them is, and why.
struct UncorrectedTips {
  int tips = 0;        ///< of fractures, all of them
  int plain = 0;       ///< those whose flow (TipFlow) is missing, or at a node next to the tip is
  Point first;         ///< of the plain ones, m
  std::string reason;  ///< why the first is plain
};

UncorrectedTips uncorrected_tips(const Mesh& mesh, const std::vector<Tensor>& mobility);

}  // namespace sprekk::matrix_flow
