// A list of a few integers without memory of its own.
#pragma once

#include <array>
#include <initializer_list>

#include "framework/assert.hpp"

namespace sprekk {

/// At most `capacity` numbers (nodes or faces) in their order.
template <int capacity>
class ShortList {
 public:
  ShortList() = default;
  ShortList(std::initializer_list<int> items) {
    for (const int item : items) push_back(item);
  }

  void push_back(int item) {
    SPREKK_ASSERT(size_ < capacity, size_, capacity);
    items_[size_++] = item;
  }

  int size() const { return size_; }
  int operator[](int k) const { return items_[k]; }
  int& operator[](int k) { return items_[k]; }
  /// The item after item k; the first after the last.
  int after(int k) const { return items_[k + 1 == size_ ? 0 : k + 1]; }
  /// The item before item k; the last before the first.
  int before(int k) const { return items_[k == 0 ? size_ - 1 : k - 1]; }

  const int* begin() const { return items_.data(); }
  const int* end() const { return items_.data() + size_; }
  int* begin() { return items_.data(); }
  int* end() { return items_.data() + size_; }

  bool operator==(const ShortList&) const = default;

 private:
  std::array<int, capacity> items_{};  ///< zeros behind the last
  int size_ = 0;
};

}  // namespace sprekk
