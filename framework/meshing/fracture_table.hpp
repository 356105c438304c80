// Fractures from a table, as mappings of outcrops and generators of networks write them.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "framework/config/node.hpp"
#include "framework/meshing/geometry.hpp"

namespace sprekk {

/// The file of a table of fractures.
struct FractureTable {
  std::string file;              ///< as the user gave it
  std::string folder;            ///< of the scene: the file is relative to it
  std::string set;               ///< fractures without a name are called set_1, set_2, … by their row
  Origin where;                  ///< of the request
  Point origin = Point::Zero();  ///< m, in the coordinates of the table: what is the origin of the scene
};

/// The fractures of a GeoJSON file (read_fracture_geojson), or of a CSV file with headings (split_csv). Either each row
/// is a straight fracture with the columns x1, y1, x2, y2; or each row is a point of a polyline with the columns name,
/// x, y, and successive rows of one name are one fracture. Further columns: `name`, and `size`, the length of its
/// cells. Lengths are in m, or in the unit that a heading says, like x1[mm]. Other columns hold numbers that data may
/// take ({column: friction}); of a polyline those of its first row count. In space each row is a fracture with the
/// columns x, y, z, strike, dip (rad, or strike[deg]) and length, height or radius; or a point of a polygon with name,
/// x, y, z. Usual names of columns stand for these: START_X, START_Y, END_X, END_Y for the ends, and FID or ID for the
/// name. Headings may stand behind a '#'. Throws InputError with the file's line for what is missing, unknown or no
/// finite number.
std::vector<FractureGeometry> read_fracture_table(const FractureTable& table);

/// The text of a CSV file from which read_fracture_table reads these fractures to the last bit, with their names, the
/// lengths of their cells where all have one, and the further columns that all have. Throws InputError for a name that
/// a table cannot hold, and where there are no fractures.
std::string fracture_table(const std::vector<FractureGeometry>& fractures);

/// Throws InputError for a column of a CSV file that says nothing of the geometry and that no datum takes, such as a
/// misspelt one. Files of geographic information systems have many of them.
void require_used_columns(const std::vector<FractureGeometry>& fractures, const std::set<std::string>& used);

/// Lets `fractures: {table: network.csv}` mean the same as `fractures: {table: {table: network.csv}}`.
void expand_fracture_table(Node& geometry);

}  // namespace sprekk
