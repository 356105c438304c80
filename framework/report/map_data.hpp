// Numbers on the triangles of a run, one a cell or point, as a page's script draws them.
#pragma once

#include <string>
#include <vector>

#include "framework/report/run_results.hpp"

namespace sprekk {

/// A number that has a colour on the map: a scalar field, a component, or the length of a vector.
struct MapField {
  std::string label;  ///< "rock.displacement, x"
  std::string unit;   ///< SI
  std::string array;  ///< its name in the files
  int component;      ///< `length_of_vector` for the length
  static constexpr int length_of_vector = -1;
};

/// Scalar fields first. A vector gives its components and its length, a tensor its components.
std::vector<MapField> map_fields(const RunResults& results);

/// JSON: meshes, which are written once as long as they do not change, fields with their ranges, and the values at each
/// time as 16-bit fractions of the range. At most `most_bytes` large: of longer runs fewer times are taken.
std::string map_json(const RunResults& results, std::size_t most_bytes = 24'000'000);

}  // namespace sprekk
