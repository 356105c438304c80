// Zones around the ends of fractures in which discretizations use the singular fields, and the cells from which the
// strength of these fields is read.
#pragma once

#include <map>
#include <vector>

#include "framework/discretization/zone_limits.hpp"
#include "framework/mesh/mesh.hpp"

namespace sprekk {

/// For every node an end (a node, see ends_nearby) or none, and how much of its field counts there: 1 near the end, and
/// less from there on, smoothly down to 0. A field that ended abruptly would leave an error at its end which does not
/// become smaller with the cells. Zones of both ends of a straight fracture meet in its middle, where the fields of
/// both are much alike: there they end within one hundredth of their length.
///
/// A zone reaches half of the way to the nearest other end, side, junction, other fracture, or place where the end's
/// own fracture leaves its line: so the error at the end of the zone decreases with the cell size. Behind a place that
/// is off the line by less than `off_line` the field counts in part, smoothly from all of it on the line to nothing: so
/// weights change with the bend of a path by at most 1.5/off_line per radian. To both sides of the fracture the zone
/// reaches eight times the length of the cell at the end: this limits how many nodes read the same cells.
/// All nodes that ends_nearby assigns to the end belong to the zone in any case.
struct EndZones {
  std::vector<int> end;                   ///< for each node: its end, or none
  std::vector<double> weight;             ///< for each node: 0 to 1
  std::map<int, std::vector<int>> cells;  ///< for each end: the cells at it and at the nodes next to it, ascending
  long looked_at = 0;                     ///< pairs of an end and a node that may disturb it: a measure of the work
};

/// The zones of all ends of fractures that are tips.
EndZones end_zones(const Mesh& mesh, const ZoneLimits& limits = {});

}  // namespace sprekk
