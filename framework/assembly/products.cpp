#include "framework/assembly/products.hpp"

#include <cmath>

namespace sprekk {

FieldProduct multiply(const SparseMatrix& a, const Vector& x) {
  FieldProduct product{Vector(a.rows()), Vector(a.rows())};
  for (int row = 0; row < a.rows(); ++row) {
    double value = 0, size = 0;
    for (SparseMatrix::InnerIterator entry(a, row); entry; ++entry) {
      const double term = entry.value() * x[entry.col()];
      value += term;
      size += std::abs(term);
    }
    product.value[row] = value;
    product.size[row] = size;
  }
  return product;
}

const FieldProduct& Products::of(const Operator& a, const Field& x, const Vector& values, std::uint64_t version) {
  Recent& recent = recent_[{a.number(), &x}];
  recent.is_used = true;
  for (Kept& kept : recent.kept)
    if (kept.used > 0 && kept.version == version) {
      kept.used = ++uses_;
      return kept.product;
    }
  Kept& oldest = recent.kept[recent.kept[0].used <= recent.kept[1].used ? 0 : 1];
  oldest = {multiply(a.entries(), values), version, ++uses_};
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
