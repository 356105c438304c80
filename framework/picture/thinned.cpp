#include "framework/picture/thinned.hpp"

#include <algorithm>
#include <cmath>
#include <set>

namespace sprekk {

Curve thinned(const Curve& curve, std::size_t bins) {
  const std::size_t count = curve.x.size();
  if (count <= 4 * bins) return curve;
  Curve result = curve;
  result.x.clear();
  result.y.clear();
  for (std::size_t bin = 0; bin < bins; ++bin) {
    const std::size_t begin = bin * count / bins, end = (bin + 1) * count / bins;
    std::set<std::size_t> kept = {begin, end - 1};
    std::size_t lowest = begin, highest = begin;
    for (std::size_t i = begin; i < end; ++i) {
      if (!std::isfinite(curve.y[i])) kept.insert(i);
      if (curve.y[i] < curve.y[lowest]) lowest = i;
      if (curve.y[i] > curve.y[highest]) highest = i;
    }
    kept.insert({lowest, highest});
    for (const std::size_t i : kept) {
      result.x.push_back(curve.x[i]);
      result.y.push_back(curve.y[i]);
    }
  }
  return result;
}

}  // namespace sprekk
