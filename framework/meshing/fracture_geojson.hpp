// Fractures from GeoJSON, as geographic information systems write traces.
#pragma once

#include <string>
#include <vector>

#include "framework/meshing/geometry.hpp"

namespace sprekk {

/// Whether the name of a file ends in .geojson or .json.
bool is_geojson(const std::string& file);

/// The fractures of a GeoJSON file (RFC 7946): in a plane each LineString, or line of a MultiLineString, and in space
/// each Polygon with z. Coordinates are in m, of a projected system: degrees are refused where the file says that it
/// has them. A fracture has the property `name`, else the `id` of its feature; a property `size` is the length of its
/// cells, m. Data may take other properties that are numbers ({column: friction}, or "height[mm]" with its unit); those
/// that no datum takes are ignored. Throws InputError with the file's line, or with `where`, the place of the request.
/// Fractures without a name are called set_1, set_2, …
std::vector<FractureGeometry> read_fracture_geojson(const std::string& content, const std::string& file,
                                                    const std::string& set, const Origin& where);

}  // namespace sprekk
