// Parts whose balances may float.
#pragma once

namespace sprekk {

/// A part with balances that, in some places, store nothing: there something else has to hold their potential.
class MayStoreNothing {
 public:
  virtual ~MayStoreNothing() = default;
  /// Whether there are such places in the present step.
  virtual bool stores_nothing_somewhere() const = 0;
};

}  // namespace sprekk
