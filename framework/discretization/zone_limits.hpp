// How far the singular fields around the ends of fractures reach.
#pragma once

#include "framework/discretization/ends_nearby.hpp"

namespace sprekk {

/// How far zones reach. Only tests take other values, to see how much answers depend on them.
struct ZoneLimits {
  EndLimits near = {};
  double half_width = 8;       ///< of a zone along the fracture, in lengths of the cell at the end
  double fading_part = 0.1;    ///< of the way, where the correction fades out
  double joining_part = 0.01;  ///< the same where the zone of the fracture's other end follows
  double off_line = 3e-3;      ///< how far a fracture may leave the line of its end, of the distance from it
};

}  // namespace sprekk
