#include "framework/linear/reduction/excerpt.hpp"

#include <algorithm>
#include <cstring>

namespace sprekk {
namespace {

bool same_bits(const double* a, const double* b, int count) {
  return std::memcmp(a, b, static_cast<std::size_t>(count) * sizeof(double)) == 0;
}

}  // namespace

bool Excerpt::differs(const double* whole, const double* mine) const {
  for (const Piece& piece : pieces_) {
    if (!same_bits(mine, whole + piece.place, piece.count)) return true;
    mine += piece.count;
  }
  return false;
}

bool Excerpt::take(const double* whole, double* mine) const {
  bool has_changed = false;
  for (const Piece& piece : pieces_) {
    if (!same_bits(mine, whole + piece.place, piece.count)) {
      has_changed = true;
      std::copy_n(whole + piece.place, piece.count, mine);
    }
    mine += piece.count;
  }
  return has_changed;
}

void Excerpt::put_back(const double* mine, double* whole) const {
  for (const Piece& piece : pieces_) {
    std::copy_n(mine, piece.count, whole + piece.place);
    mine += piece.count;
  }
}

}  // namespace sprekk
