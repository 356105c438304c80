// Where around the tips of fractures their fields are felt, and which cells tell how strong they are.
#pragma once

#include <map>
#include <vector>

#include "framework/mesh/mesh.hpp"

namespace sprekk {

/// For every node a tip (a node, see tips_nearby) or none, and how much of its field counts there: 1 near the tip, and
/// less from there on, smoothly down to 0. A field that ended abruptly would leave an error at its end which does not
/// become smaller with the cells.
///
/// A zone reaches half of the way to the nearest other tip, side, junction, other fracture, or place where the tip's
/// own fracture leaves its line, so that what remains at its end falls with the cells, and eight cells (of the length
/// of that at the tip) to both sides of the fracture: that limits how many nodes read the same cells. All nodes that
/// tips_nearby gives the tip belong to it in any case.
struct TipZones {
  std::vector<int> tip;                   ///< of each node, or none
  std::vector<double> weight;             ///< of each node, 0 to 1
  std::map<int, std::vector<int>> cells;  ///< of each tip: those at it and at the nodes next to it, ascending
};

TipZones tip_zones(const Mesh& mesh);

}  // namespace sprekk
