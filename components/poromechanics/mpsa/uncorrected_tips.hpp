// Tips of fractures around which displacements are taken to be linear, as elsewhere.
#pragma once

#include <string>
#include <vector>

#include "components/poromechanics/mpsa/mpsa.hpp"

namespace sprekk::poromechanics {

/// How many tips of a mesh get no correction of their displacements, where the first of them is, and why.
struct UncorrectedTips {
  int tips = 0;        ///< of fractures, all of them
  int plain = 0;       ///< those whose field (TipField) is missing, or at a node next to the tip is
  Point first;         ///< of the plain ones, m
  std::string reason;  ///< why the first is plain
};

UncorrectedTips uncorrected_tips(const Mesh& mesh, const std::vector<Stiffness>& stiffness);

}  // namespace sprekk::poromechanics
