// Ends of fractures around which a discretization makes no use of the singular field.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "framework/mesh/mesh.hpp"

namespace sprekk {

/// How many ends of the fractures of a mesh get no correction for their singular field, where the first of them is, and
/// why.
struct UncorrectedEnds {
  int ends = 0;         ///< all of them
  int uncorrected = 0;  ///< those without a correction
  Point first;          ///< the first of these, m
  std::string reason;   ///< why the first has none
};

/// `cells_at`: for each end (a node) the cells from which its field is found. `why_not(end, cells)`: why an end is not
/// corrected, "" where it is.
UncorrectedEnds uncorrected_ends(const Mesh& mesh, const std::map<int, std::vector<int>>& cells_at,
                                 const std::function<std::string(int, const std::vector<int>&)>& why_not);

}  // namespace sprekk
