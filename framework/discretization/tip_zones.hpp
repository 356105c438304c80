// Zones around the tips of fractures in which discretizations use the singular fields, and the cells from which the
// strength of these fields is read.
#pragma once

#include <map>
#include <vector>

#include "framework/mesh/mesh.hpp"

namespace sprekk {

/// For every node a tip (a node, see tips_nearby) or none, and how much of its field counts there: 1 near the tip, and
/// less from there on, smoothly down to 0. A field that ended abruptly would leave an error at its end which does not
/// become smaller with the cells. Zones of both tips of a straight fracture meet in its middle, where the fields of
/// both are much alike: there they end within one hundredth of their length.
///
/// A zone reaches half of the way to the nearest other tip, side, junction, other fracture, or place where the tip's
/// own fracture leaves its line: so the error at the end of the zone decreases with the cell size. To both sides of the
/// fracture it reaches eight times the length of the cell at the tip: this limits how many nodes read the same cells.
/// All nodes that tips_nearby assigns to the tip belong to the zone in any case.
struct TipZones {
  std::vector<int> tip;                   ///< for each node: its tip, or none
  std::vector<double> weight;             ///< for each node: 0 to 1
  std::map<int, std::vector<int>> cells;  ///< for each tip: the cells at it and at the nodes next to it, ascending
};

TipZones tip_zones(const Mesh& mesh);

}  // namespace sprekk
