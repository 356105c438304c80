#include "framework/meshing/plane/size_sources.hpp"

#include <algorithm>
#include <numeric>

#include "framework/mesh/mesh.hpp"
#include "framework/round_off.hpp"

namespace sprekk {
namespace {

constexpr int in_a_block = 8;  // sources that are looked at one by one

/// The smaller one of `size` and the size that the source asks for.
double lowered_by(const SizeSource& source, double size, const Point& x) {
  const Point &a = source.segment.from, &b = source.segment.to;
  const double reach = (size - source.size) / source.growth;
  if (x.x() < std::min(a.x(), b.x()) - reach || x.x() > std::max(a.x(), b.x()) + reach ||
      x.y() < std::min(a.y(), b.y()) - reach || x.y() > std::max(a.y(), b.y()) + reach) {
    return size;
  }
  return std::min(size, source.size + source.growth * distance(x, source.segment));
}

}  // namespace

void SizeSources::add(const SizeSource& source) {
  all_.push_back(source);
  if (++loose_ < in_a_block) return;
  Tree tree;
  tree.order.resize(loose_);
  std::iota(tree.order.begin(), tree.order.end(), static_cast<int>(all_.size()) - loose_);
  loose_ = 0;
  for (; !trees_.empty() && trees_.back().order.size() <= tree.order.size(); trees_.pop_back())
    tree.order.insert(tree.order.end(), trees_.back().order.begin(), trees_.back().order.end());
  grow(tree, 0, static_cast<int>(tree.order.size()));
  trees_.push_back(std::move(tree));
}

int SizeSources::grow(Tree& tree, int first, int last) const {
  const SizeSource& one = all_[tree.order[first]];
  Branch branch{one.segment.from, one.segment.from, one.size, one.growth, first, last, none};
  for (int i = first; i < last; ++i) {
    const SizeSource& source = all_[tree.order[i]];
    branch.low = branch.low.cwiseMin(source.segment.from).cwiseMin(source.segment.to);
    branch.high = branch.high.cwiseMax(source.segment.from).cwiseMax(source.segment.to);
    branch.size = std::min(branch.size, source.size);
    branch.growth = std::min(branch.growth, source.growth);
  }
  const int number = static_cast<int>(tree.branches.size());
  tree.branches.push_back(branch);
  if (last - first <= in_a_block) return number;
  const Point extent = branch.high - branch.low;
  const int axis = extent.x() >= extent.y() ? 0 : 1, middle = first + (last - first) / 2;
  const auto center = [&](int i) { return all_[i].segment.from[axis] + all_[i].segment.to[axis]; };
  std::nth_element(tree.order.begin() + first, tree.order.begin() + middle, tree.order.begin() + last,
                   [&](int a, int b) { return center(a) < center(b); });
  grow(tree, first, middle);
  const int second = grow(tree, middle, last);
  tree.branches[number].second_child = second;
  return number;
}

/// A lower bound of what the sources of a branch ask for at x.
double SizeSources::least(const Branch& branch, const Point& x) {
  const double away = (x - x.cwiseMax(branch.low).cwiseMin(branch.high)).norm();
  // A little less, so that the bound does not hide the source itself.
  return (1 - rounding::of_terms) * (branch.size + branch.growth * away);
}

double SizeSources::lowered_by(const Tree& tree, int number, double size, const Point& x) const {
  const Branch& branch = tree.branches[number];
  if (branch.second_child == none) {
    for (int i = branch.first; i < branch.last; ++i) size = sprekk::lowered_by(all_[tree.order[i]], size, x);
    return size;
  }
  // The nearer half first: it often makes the other one superfluous.
  std::array<std::pair<double, int>, 2> halves;
  halves[0] = {least(tree.branches[number + 1], x), number + 1};
  halves[1] = {least(tree.branches[branch.second_child], x), branch.second_child};
  if (halves[1].first < halves[0].first) std::swap(halves[0], halves[1]);
  for (const auto& [bound, half] : halves)
    if (bound < size) size = lowered_by(tree, half, size, x);
  return size;
}

double SizeSources::lowered(double size, const Point& x) const {
  for (std::size_t i = all_.size() - loose_; i < all_.size(); ++i) size = sprekk::lowered_by(all_[i], size, x);
  for (const Tree& tree : trees_)
    if (least(tree.branches[0], x) < size) size = lowered_by(tree, 0, size, x);
  return size;
}

}  // namespace sprekk
