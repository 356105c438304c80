// The stiffness of the rock of a fine level.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "components/fine_fracture/fine_level/elasticity.hpp"

namespace sprekk::fine_fracture {

/// The stiffness in a domain: the same everywhere, or a function of the place.
class FineRock {
 public:
  FineRock(const Elasticity& everywhere) : everywhere_(everywhere) {}
  using Border = std::array<Point, 2>;
  /// `at`: the stiffness at a place (m) in the domain. Functions with different values have different versions.
  /// `borders`: the segments (m) across which it jumps; a border that is missing, or a change that is no jump, costs
  /// accuracy only.
  FineRock(std::function<Elasticity(const Point&)> at, std::uint64_t version, std::vector<Border> borders = {})
      : at_(std::move(at)), version_(version), borders_(std::move(borders)) {}

  bool is_uniform() const { return everywhere_.has_value(); }
  Elasticity at(const Point& x) const { return everywhere_ ? *everywhere_ : at_(x); }
  const std::vector<Border>& borders() const { return borders_; }
  bool operator==(const FineRock& other) const {
    return everywhere_ == other.everywhere_ && version_ == other.version_;
  }

 private:
  std::optional<Elasticity> everywhere_;
  std::function<Elasticity(const Point&)> at_;
  std::uint64_t version_ = 0;
  std::vector<Border> borders_;
};

}  // namespace sprekk::fine_fracture
