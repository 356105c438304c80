// The elastic problem around a tip, as tips need it whatever solves it.
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

/// The rock in a domain is not what a fine level is made for: what it is, and what it should be.
struct UnsuitableRock : std::runtime_error {
  UnsuitableRock(const std::string& problem, std::string wanted)
      : std::runtime_error(problem), wanted(std::move(wanted)) {}
  std::string wanted;
};

/// What a fine level says of its tip.
struct TipFactors {
  Sifs sifs;
  double error;  ///< Pa m^0.5, estimated, by the elements of the fine level
};

/// The elastic problem in the domain around one tip, for one geometry and rock.
class FineLevel {
 public:
  virtual ~FineLevel() = default;
  virtual FineRock rock() const = 0;
  /// The pattern of its elements: factors of fine levels with one pattern depend continuously on the geometry.
  virtual std::uint64_t topology() const = 0;
  /// The places at which each solve needs the stress offset.
  virtual const std::vector<Point>& offset_places() const = 0;
  /// The same for the body force.
  virtual std::vector<Point> body_force_places() const { return offset_places(); }
  /// Throws std::runtime_error where there is no finite result, and UnsuitableRock.
  virtual TipFactors solve(const FineLoads& loads) const = 0;
};

/// What is kept of a fine level from trial to trial within a step, so that factors depend continuously on the advance.
struct KeptLevel {
  std::vector<Point> outline;  ///< m
  virtual ~KeptLevel() = default;
};

/// A fine level that is wanted.
struct FineLevelRequest {
  const FineDomain& domain;
  FineRock rock;
  double size;         ///< m, of the square
  double coarse_size;  ///< m, of the coarse level's edges at the tip
  Point anchor;        ///< m, a place that stays while cracks grow
  bool follows;        ///< whether fine levels are made so that factors may depend continuously on the advance
  bool keeps;          ///< whether this one and the next are levels of trials of one step
  std::shared_ptr<const KeptLevel> kept;  ///< of the trial before, or null
  const FineLoads& loads;
  std::shared_ptr<Profile> profile;
};

/// What a request is answered with.
struct MadeFineLevel {
  std::unique_ptr<const FineLevel> level;
  std::shared_ptr<const KeptLevel> kept;   ///< where `keeps`
  int meshes = 1;                          ///< that were made for it
  std::optional<TipFactors> factors = {};  ///< for the loads of the request, where they are known already
};

/// Makes fine levels: in this one kind of tips differs from another.
class FineLevelMaker {
 public:
  virtual ~FineLevelMaker() = default;
  virtual MadeFineLevel make(const FineLevelRequest& request) const = 0;
  /// m, that a tip needs between itself and an outline that is kept.
  virtual double room(double coarse_size) const = 0;
  /// Whether factors can depend continuously on the advance.
  virtual bool is_steady() const { return true; }
  /// Whether walls may have prescribed jumps.
  virtual bool takes_jumps() const { return true; }
  /// Whether the rock in a domain must have one stiffness.
  virtual bool needs_one_stiffness() const { return false; }
  /// Whether domains are to have the fractures beyond their outlines.
  virtual bool wants_beyond() const { return false; }
};

}  // namespace sprekk::fine_fracture
