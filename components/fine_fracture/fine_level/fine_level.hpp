// The elastic problem around a tip: the interface of all fine levels.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "components/fine_fracture/fine_level/fine_domain.hpp"
#include "components/fine_fracture/fine_level/fine_rock.hpp"
#include "components/fine_fracture/fine_level/loads.hpp"
#include "components/fine_fracture/growth/mixed_mode.hpp"
#include "framework/output/profile.hpp"

namespace sprekk::fine_fracture {

/// The rock in a domain is of a kind that the fine level does not support. `what()` says how it is, `wanted` how it
/// should be.
struct UnsuitableRock : std::runtime_error {
  UnsuitableRock(const std::string& problem, std::string wanted)
      : std::runtime_error(problem), wanted(std::move(wanted)) {}
  std::string wanted;
};

/// The stress intensity factors of the tip of a fine level.
struct TipFactors {
  Sifs sifs;
  double error;  ///< Pa m^0.5, estimated error due to the elements of the fine level
};

/// The elastic problem in the domain around one tip, for one geometry and rock.
class FineLevel {
 public:
  virtual ~FineLevel() = default;
  virtual FineRock rock() const = 0;
  /// A number for the pattern of the elements. Where it is the same, factors depend continuously on the geometry.
  virtual std::uint64_t topology() const = 0;
  /// The places at which each solve needs the stress offset.
  virtual const std::vector<Point>& offset_places() const = 0;
  /// The places at which each solve needs the body force.
  virtual std::vector<Point> body_force_places() const { return offset_places(); }
  /// Throws std::runtime_error where there is no finite result, and UnsuitableRock.
  virtual TipFactors solve(const FineLoads& loads) const = 0;
};

/// What the fine levels of all trials within a step share, so that factors depend continuously on the advance.
struct KeptLevel {
  std::vector<Point> outline;  ///< m
  virtual ~KeptLevel() = default;
};

/// All that is needed to make a fine level.
struct FineLevelRequest {
  const FineDomain& domain;
  FineRock rock;
  double size;                            ///< m, of the square
  double coarse_size;                     ///< m, of the coarse level's edges at the tip
  Point anchor;                           ///< m, a place that does not move while cracks grow
  bool keeps;                             ///< whether this fine level and the next one belong to trials of one step
  std::shared_ptr<const KeptLevel> kept;  ///< what the fine level of the trial before has left, or null
  const FineLoads& loads;
  std::shared_ptr<Profile> profile;
};

/// A fine level that has been made for a request.
struct MadeFineLevel {
  std::unique_ptr<const FineLevel> level;
  std::shared_ptr<const KeptLevel> kept;  ///< for the next trial, where the request has `keeps`
  int meshes = 1;                         ///< how many meshes were made for it
  /// The factors for the loads of the request, if making the fine level has found them.
  std::optional<TipFactors> factors = {};
};

/// Makes fine levels. Kinds of tips differ in their maker alone.
class FineLevelMaker {
 public:
  virtual ~FineLevelMaker() = default;
  virtual MadeFineLevel make(const FineLevelRequest& request) const = 0;
  /// The least distance between a tip and an outline that is kept, m.
  virtual double room(double coarse_size) const = 0;
  /// Whether factors can depend continuously on the advance.
  virtual bool is_steady() const { return true; }
  /// Whether walls may have prescribed jumps.
  virtual bool takes_jumps() const { return true; }
  /// Whether the rock in a domain must have one stiffness.
  virtual bool needs_one_stiffness() const { return false; }
  /// Whether the stress offset is wanted on walls, which belong to no side.
  virtual bool has_offsets_on_walls() const { return false; }
  /// Whether domains are to have the fractures beyond their outlines.
  virtual bool wants_beyond() const { return false; }
};

}  // namespace sprekk::fine_fracture
