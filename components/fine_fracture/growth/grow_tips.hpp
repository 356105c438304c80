// Lets tips grow together until they arrest (secs. 2.5 and 4.3 of the paper), whatever computes their stress intensity
// factors.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "components/fine_fracture/growth/growth_options.hpp"
#include "components/fine_fracture/growth/increment_search.hpp"
#include "components/fine_fracture/growth/mixed_mode.hpp"
#include "framework/types.hpp"

namespace sprekk::fine_fracture {

/// The path that a tip has added: points from the original tip (exclusive) on, in order; the last one is the present
/// tip. May be empty.
struct TipPath {
  std::vector<Point> added;
};

/// A tip before growth.
struct GrowingTip {
  Point tip = Point::Zero();        ///< the original tip, m
  Point direction = Point::Zero();  ///< unit vector ahead of it
  double toughness = 0;             ///< K_IC, Pa sqrt(m)
  double youngs_prime = 0;          ///< E' = E/(1 − nu^2), Pa
  TipPath path;                     ///< added before this growth, which starts from its end
  WarmStart warm_start = {};        ///< as the increment before has left it
};

/// A tip after growth.
struct TipOutcome {
  TipPath path;  ///< all points from the original tip (exclusive) on, also those added before
  Sifs start;    ///< before growth
  Sifs end;      ///< after growth
  /// Whether K_eq has come down to K_IC (or never was above it), or further growth would be shorter than the shortest
  /// increment.
  bool arrested = false;
  bool blocked = false;            ///< there is no free length ahead
  Point ahead = Point::Zero();     ///< unit vector, where a blocked tip would go on
  std::string reason;              ///< why growth ended, as the end of a sentence for notes
  std::vector<std::string> notes;  ///< increments whose direction or length is not what the options ask for
  WarmStart warm_start;            ///< as the last increment has left it
  int increments = 0;              ///< added in this call
  double length = 0;               ///< m, added in this call
  long evaluations = 0;            ///< of this tip's stress intensity factors
};

/// The stress intensity factors of a tip with the given paths of all tips, in the frame of its last segment.
using EvaluateSifs = std::function<Sifs(int tip, const std::vector<TipPath>& paths)>;
/// The distance (m) that a tip may grow from the end of its path towards `to`, up to the boundary or another crack,
/// less the margin that the mesh needs; at least |to − end| when nothing is in the way.
using FreeLength = std::function<double(int tip, const TipPath& path, const Point& to)>;
/// Whether a tip's stress intensity factors depend on the path of the other.
using InteractsWith = std::function<bool(int tip, int other)>;

/// Lets tips grow in rounds. In each round all tips with K_eq > K_IC advance together, their lengths scaled by Eq. 13
/// of the paper, in the direction and to the length that IncrementSearch finds; then the stress intensity factors of
/// all tips are renewed. A tip at rest grows when others have raised its K_eq. Unstable growth (K_eq rises with the
/// length) goes on until the tip has no free length, or has added the length `longest` or `at_most` increments; the tip
/// is then not arrested. If an evaluation gives numbers that are not finite, its tip stops at its position before the
/// increment. `interacts` saves evaluations for tips that do not affect each other; without it all tips do.
std::vector<TipOutcome> grow_tips(const std::vector<GrowingTip>& tips, const GrowthOptions& options,
                                  const EvaluateSifs& evaluate, const FreeLength& free_length,
                                  const InteractsWith& interacts = {});

}  // namespace sprekk::fine_fracture
