// A physical group of curves in a mesh file.
#pragma once

#include <array>
#include <string>
#include <vector>

namespace sprekk {

/// The lines of a group, in the order of the file.
struct CurveGroup {
  std::string name;
  std::vector<std::array<int, 2>> lines;  ///< pairs of nodes
};

}  // namespace sprekk
