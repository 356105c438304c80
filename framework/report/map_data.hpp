// Values on the triangles of a run, for each cell or point, as the script of a page draws them.
#pragma once

#include <string>
#include <vector>

#include "framework/report/run_results.hpp"

namespace sprekk {

/// A value that is shown as colour on the map: a scalar field, a component, or the length of a vector.
struct MapField {
  std::string label;  ///< "rock.displacement, x"
  std::string unit;   ///< SI
  std::string array;  ///< its name in the files
  int component;      ///< `length_of_vector` for the length
  static constexpr int length_of_vector = -1;
};

/// What can be shown, scalar fields first. A vector gives its components and its length, a tensor its components.
std::vector<MapField> map_fields(const RunResults& results);

/// The fields on fracture cells by which a map can colour fractures.
std::vector<MapField> fracture_map_fields(const RunResults& results);

/// The map as JSON: meshes, each once as long as it does not change, fields with their ranges, and the values at each
/// time as 16-bit fractions of the range; the same for fracture cells, with the number of the fracture of each cell and
/// the names of fractures. The text has at most `most_bytes`: longer runs are shown at fewer times.
std::string map_json(const RunResults& results, std::size_t most_bytes = 24'000'000);

}  // namespace sprekk
