// Products of operators with fields, kept while both stay.
#pragma once

#include <cstdint>
#include <map>
#include <utility>

#include "framework/assembly/operator.hpp"
#include "framework/field/field.hpp"

namespace sprekk {

/// A product A x with the size of its terms, and the numbers that say of what.
struct FieldProduct {
  Vector value;  ///< A x
  Vector size;   ///< |A| |x|, or empty if nobody asked for it
};

/// A is compressed.
FieldProduct multiply(const SparseMatrix& a, const Vector& x, bool with_size = true);

/// A step starts from the values that the one before ended with, and a split scheme moves some of the fields only: most
/// products of a residual have been computed before. What is kept has the bits of what would be computed.
class Products {
 public:
  /// With the value of the field now. The reference stays valid until `forget_unused`, or until the field has been
  /// asked for with two other values.
  const FieldProduct& now(const Operator& a, const Field& x) { return of(a, x, x.now(), x.version(), true); }
  /// The same without the sizes, which takes less time.
  const Vector& value_now(const Operator& a, const Field& x) { return of(a, x, x.now(), x.version(), false).value; }
  const Vector& value_accepted(const Operator& a, const Field& x) {
    return of(a, x, x.accepted(), x.accepted_version(), false).value;
  }
  /// Drops the products of operators that nobody has asked for since the last call.
  void forget_unused();

 private:
  struct Kept {
    FieldProduct product;
    std::uint64_t version = 0;
    std::uint64_t used = 0;  ///< when; 0 for never
  };
  struct Recent {
    Kept kept[2];
    bool is_used = false;
  };
  const FieldProduct& of(const Operator& a, const Field& x, const Vector& values, std::uint64_t version,
                         bool with_size);

  std::map<std::pair<std::uint64_t, const Field*>, Recent> recent_;  ///< by the number of the operator
  std::uint64_t uses_ = 0;
};

}  // namespace sprekk
