// What is known of a field within cells, beside the means of the cells.
#pragma once

#include <map>

#include "framework/field/linear_pieces.hpp"

namespace sprekk {

/// For fields with one component.
struct KnownWithinCells {
  LinearPieces pieces;             ///< of cells whose shape is known
  std::map<int, double> at_faces;  ///< values at the centres of faces that have one cell, as walls do, by face
};

}  // namespace sprekk
