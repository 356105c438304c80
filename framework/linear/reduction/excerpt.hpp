// Values of a long list that are kept in a shorter one.
#pragma once

#include <cstddef>
#include <vector>

namespace sprekk {

/// For each value of a list its place in a longer list. Places that follow one another are one piece, so that rows of a
/// matrix take little memory, and are compared and copied as a whole.
class Excerpt {
 public:
  /// The next value of the shorter list is at this place of the long one.
  void add(int place) {
    if (pieces_.empty() || pieces_.back().place + pieces_.back().count != place) pieces_.push_back({place, 0});
    ++pieces_.back().count;
    ++size_;
  }
  /// How many values the shorter list has.
  std::size_t size() const { return size_; }

  /// Whether the bits of a value differ.
  bool differs(const double* whole, const double* mine) const;
  /// Fills the shorter list. True if the bits of a value have changed.
  bool take(const double* whole, double* mine) const;
  /// Puts the values of the shorter list back to their places.
  void put_back(const double* mine, double* whole) const;

 private:
  struct Piece {
    int place, count;
  };
  std::vector<Piece> pieces_;
  std::size_t size_ = 0;
};

}  // namespace sprekk
