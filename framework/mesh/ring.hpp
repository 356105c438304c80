// The corners, or the sides, of one cell.
#pragma once

#include <array>
#include <limits>
#include <utility>

namespace sprekk {

/// Three or four numbers (nodes or faces) in their order around a cell. A range, as small as four integers.
class Ring {
 public:
  Ring() : items_{0, 0, 0, absent} {}
  Ring(int a, int b, int c) : items_{a, b, c, absent} {}
  Ring(int a, int b, int c, int d) : items_{a, b, c, d} {}
  explicit Ring(const std::array<int, 3>& corners) : Ring(corners[0], corners[1], corners[2]) {}

  int size() const { return items_[3] == absent ? 3 : 4; }
  int operator[](int k) const { return items_[k]; }
  int& operator[](int k) { return items_[k]; }
  /// The item after item k; the first after the last.
  int after(int k) const { return items_[k + 1 == size() ? 0 : k + 1]; }
  /// The item before item k; the last before the first.
  int before(int k) const { return items_[k == 0 ? size() - 1 : k - 1]; }

  const int* begin() const { return items_.data(); }
  const int* end() const { return items_.data() + size(); }
  int* begin() { return items_.data(); }
  int* end() { return items_.data() + size(); }

  /// Reverses the orientation; the first item stays.
  void turn() { std::swap(items_[1], items_[size() - 1]); }

  bool operator==(const Ring&) const = default;

 private:
  static constexpr int absent = std::numeric_limits<int>::min();
  std::array<int, 4> items_;
};

}  // namespace sprekk
