// Sources of short edges: lines, around each of which the wanted edge length grows with the distance.
#pragma once

#include <array>
#include <vector>

#include "framework/mesh/plane/planar.hpp"

namespace sprekk {

/// Around `segment`, a point when from == to, the wanted edge length is `size` + `growth` · distance, m.
struct SizeSource {
  Segment segment;
  double size;
  double growth;
};

/// Any number of sources. Finding the smallest size at a place takes a time that hardly depends on their number. Trees
/// of 1, 2, 4, … blocks of sources, so that adding one more does not build everything anew (Bentley and Saxe, Journal
/// of Algorithms 1 (1980) 301).
class SizeSources {
 public:
  void add(const SizeSource& source);
  const std::vector<SizeSource>& all() const { return all_; }
  /// The smallest of `size` and of what the sources ask for at x.
  double lowered(double size, const Point& x) const;

 private:
  /// Sources first … last - 1 of order_, and what bounds them.
  struct Branch {
    Point low, high;
    double size, growth;
    int first, last;
    int second_child;  ///< the first one follows its parent; none for a leaf
  };
  struct Tree {
    std::vector<int> order;
    std::vector<Branch> branches;
  };
  int grow(Tree& tree, int first, int last) const;
  static double least(const Branch& branch, const Point& x);
  double lowered_by(const Tree& tree, int branch, double size, const Point& x) const;

  std::vector<SizeSource> all_;
  std::vector<Tree> trees_;
  int loose_ = 0;  ///< the last ones of all_, which are in no tree yet
};

}  // namespace sprekk
