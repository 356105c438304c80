// Products of operators with fields, kept while both stay.
#pragma once

#include <cstdint>
#include <map>
#include <utility>

#include "framework/assembly/operator.hpp"
#include "framework/field/field.hpp"

namespace sprekk {

/// A product A x, with the size of the terms of each row.
struct FieldProduct {
  Vector value;  ///< A x
  Vector size;   ///< |A| |x|, or empty if it was not asked for
};

/// The product of a matrix in compressed form with a vector.
FieldProduct multiply(const SparseMatrix& a, const Vector& x, bool with_size = true);

/// Keeps products of operators with fields, to be reused while operator and field stay the same. A step starts from the
/// values that the previous step ended with, and a split scheme moves only some of the fields: most products of a
/// residual have been computed before. A product that is kept has the same bits as one that is computed anew.
class Products {
 public:
  /// The product with the current value of the field. The reference stays valid until `forget_unused`, or until
  /// products of this operator with two other values of the field have been asked for.
  const FieldProduct& now(const Operator& a, const Field& x) { return of(a, x, true); }
  /// The product alone, without the sizes, which takes less time.
  const Vector& value_now(const Operator& a, const Field& x) { return of(a, x, false).value; }
  /// Drops the products that have not been asked for since the last call.
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
  const FieldProduct& of(const Operator& a, const Field& x, bool with_size);

  std::map<std::pair<std::uint64_t, const Field*>, Recent> recent_;  ///< by the number of the operator
  std::uint64_t uses_ = 0;
};

}  // namespace sprekk
