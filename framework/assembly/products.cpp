#include "framework/assembly/products.hpp"

#include <cmath>

#include "framework/invariants.hpp"

namespace sprekk {

namespace {

template <bool with_size>
FieldProduct multiplied(const SparseMatrix& a, const Vector& x) {
  FieldProduct product{Vector(a.rows()), Vector(with_size ? a.rows() : 0)};
  const int *outer = a.outerIndexPtr(), *inner = a.innerIndexPtr();
  const double *entries = a.valuePtr(), *values = x.data();
  for (int row = 0; row < a.rows(); ++row) {
    // Two sums at a time, since additions to a single sum wait for one another.
    double value[2] = {0, 0}, size[2] = {0, 0};
    int k = outer[row];
    for (; k + 1 < outer[row + 1]; k += 2)
      for (int i = 0; i < 2; ++i) {
        const double term = entries[k + i] * values[inner[k + i]];
        value[i] += term;
        if (with_size) size[i] += std::abs(term);
      }
    if (k < outer[row + 1]) {
      const double term = entries[k] * values[inner[k]];
      value[0] += term;
      if (with_size) size[0] += std::abs(term);
    }
    product.value[row] = value[0] + value[1];
    if (with_size) product.size[row] = size[0] + size[1];
  }
  return product;
}

}  // namespace

FieldProduct multiply(const SparseMatrix& a, const Vector& x, bool with_size) {
  SPREKK_EXPECT(a.cols() == x.size(), a.cols(), x.size());
  SPREKK_EXPECT(a.isCompressed());
  return with_size ? multiplied<true>(a, x) : multiplied<false>(a, x);
}

const FieldProduct& Products::of(const Operator& a, const Field& x, bool with_size) {
  const Vector& values = x.now();
  const std::uint64_t version = x.version();
  Recent& recent = recent_[{a.number(), &x}];
  recent.is_used = true;
  for (Kept& kept : recent.kept)
    if (kept.used > 0 && kept.version == version) {
      kept.used = ++uses_;
      if (with_size && kept.product.size.size() != a.entries().rows()) kept.product = multiply(a.entries(), values);
      return kept.product;
    }
  Kept& oldest = recent.kept[recent.kept[0].used <= recent.kept[1].used ? 0 : 1];
  oldest = {multiply(a.entries(), values, with_size), version, ++uses_};
  return oldest.product;
}

void Products::forget_unused() {
  for (auto entry = recent_.begin(); entry != recent_.end();) {
    if (!entry->second.is_used) {
      entry = recent_.erase(entry);
    } else {
      entry->second.is_used = false;
      ++entry;
    }
  }
}

}  // namespace sprekk
