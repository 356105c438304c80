#include "framework/linear/reduction/separated_solver.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "framework/invariants.hpp"
#include "framework/linear/expect_sound.hpp"
#include "framework/parallel/parallel.hpp"

namespace sprekk {
namespace {

/// For every block the number of its set, counted from 0.
std::vector<int> sets_of_blocks(const LinearSystem& system, int& sets) {
  const SparseMatrix& a = system.local;
  const int count = static_cast<int>(system.blocks.size());
  std::vector<int> block_of(a.cols(), 0);
  for (int b = 0; b < count; ++b) {
    const UnknownBlock& block = system.blocks[b];
    std::fill_n(block_of.begin() + block.first, block.entities * block.components, b);
  }
  std::vector<char> is_joined(count * count, 0);
  std::vector<int> root(count);
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&](int b) {
    while (root[b] != b) b = root[b] = root[root[b]];
    return b;
  };
  for (int row = 0; row < a.rows(); ++row) {
    char* joined = is_joined.data() + block_of[row] * count;
    for (SparseMatrix::InnerIterator entry(a, row); entry; ++entry) joined[block_of[entry.col()]] = 1;
  }
  for (int b = 0; b < count; ++b)
    for (int other = 0; other < count; ++other)
      if (is_joined[b * count + other]) root[find(b)] = find(other);
  std::vector<int> set(count, -1), number(count, -1);
  sets = 0;
  for (int b = 0; b < count; ++b) {
    if (system.blocks[b].entities == 0) continue;
    int& mine = number[find(b)];
    if (mine < 0) mine = sets++;
    set[b] = mine;
  }
  return set;
}

}  // namespace

bool SeparatedSolver::fits(const LinearSystem& system) const {
  const SparseMatrix& a = system.local;
  if (groups_.empty()) return false;
  if (system.pattern_number != 0 && system.pattern_number == pattern_number_) return true;
  return static_cast<int>(inner_.size()) == a.nonZeros() && static_cast<int>(outer_.size()) == a.rows() + 1 &&
         std::equal(outer_.begin(), outer_.end(), a.outerIndexPtr()) &&
         std::equal(inner_.begin(), inner_.end(), a.innerIndexPtr());
}

void SeparatedSolver::separate(const LinearSystem& system) {
  const SparseMatrix& a = system.local;
  int sets = 1;
  std::vector<int> set_of_block(system.blocks.size(), 0);
  const bool can_separate = parallel::size() == 1 && a.isCompressed() && system.blocks.size() > 1;
  if (can_separate) set_of_block = sets_of_blocks(system, sets);
  // A single part keeps its solver, with its ordering, when the pattern changes.
  if (groups_.size() != 1 || sets != 1) {
    for (const Group& group : groups_) retired_ += group.solver->counts();
    groups_.clear();
    groups_.resize(std::max(1, sets));
    for (Group& group : groups_) group.solver = make_();
  }
  outer_.clear();
  inner_.clear();
  if (groups_.size() == 1) return;

  outer_.assign(a.outerIndexPtr(), a.outerIndexPtr() + a.rows() + 1);
  inner_.assign(a.innerIndexPtr(), a.innerIndexPtr() + a.nonZeros());
  std::vector<int> place(a.cols(), 0);
  for (std::size_t b = 0; b < system.blocks.size(); ++b) {
    if (set_of_block[b] < 0) continue;
    UnknownBlock block = system.blocks[b];
    Group& group = groups_[set_of_block[b]];
    const int first = static_cast<int>(group.unknowns.size());
    for (int i = 0; i < block.entities * block.components; ++i) {
      place[block.first + i] = first + i;
      group.unknowns.push_back(block.first + i);
    }
    block.first = first;
    group.system.blocks.push_back(std::move(block));
  }
  for (Group& group : groups_) {
    std::vector<int> starts{0}, columns;
    for (const int row : group.unknowns) {
      for (int k = outer_[row]; k < outer_[row + 1]; ++k) {
        columns.push_back(place[inner_[k]]);
        group.source.push_back(k);
      }
      starts.push_back(static_cast<int>(columns.size()));
    }
    const int size = static_cast<int>(group.unknowns.size());
    group.system.rows.resize(size);
    std::iota(group.system.rows.begin(), group.system.rows.end(), 0);
    SparseMatrix& matrix = group.system.local;
    matrix.resize(size, size);
    matrix.resizeNonZeros(columns.size());
    std::copy(starts.begin(), starts.end(), matrix.outerIndexPtr());
    std::copy(columns.begin(), columns.end(), matrix.innerIndexPtr());
    std::fill_n(matrix.valuePtr(), columns.size(), std::nan(""));
    group.system.pattern_number = new_system_number();
  }
}

LinearReport SeparatedSolver::factor(const LinearSystem& system) {
  expect_sound(system);
  if (!fits(system)) separate(system);
  const bool is_same = system.number != 0 && system.number == number_;
  pattern_number_ = system.pattern_number;
  number_ = system.number;
  if (groups_.size() == 1) return groups_[0].solver->factor(system);
  for (Group& group : groups_) {
    if (!is_same && take_values(group.system.local, system.local.valuePtr(), group.source))
      group.system.number = new_system_number();
    group.system.sums.clear();
    for (const int sum : system.sums) {
      const auto place = std::lower_bound(group.unknowns.begin(), group.unknowns.end(), sum);
      if (place != group.unknowns.end() && *place == sum)
        group.system.sums.push_back(static_cast<int>(place - group.unknowns.begin()));
    }
    const LinearReport report = group.solver->factor(group.system);
    if (!report.solved) return report;
  }
  return LinearReport::success();
}

LinearReport SeparatedSolver::solve(const Vector& b_rows, Vector& x) {
  if (groups_.empty()) return LinearReport::failure("solve was called before factor");
  if (groups_.size() == 1) return groups_[0].solver->solve(b_rows, x);
  x = Vector::Zero(b_rows.size());
#ifdef SPREKK_ASSERTIONS
  Eigen::Index unknowns_of_groups = 0;
  for (const Group& group : groups_) unknowns_of_groups += static_cast<Eigen::Index>(group.unknowns.size());
  SPREKK_ASSERT(unknowns_of_groups == b_rows.size(), unknowns_of_groups, b_rows.size());
#endif
  LinearReport all = LinearReport::success();
  for (Group& group : groups_) {
    const Vector b = b_rows(group.unknowns);
    if (b.isZero(0)) continue;
    Vector mine;
    const LinearReport report = group.solver->solve(b, mine);
    SPREKK_ASSERT(!report.solved || mine.size() == b.size(), mine.size(), b.size());
    if (!report.solved) return report;
    all.iterations += report.iterations;
    all.relative_residual = std::max(all.relative_residual, report.relative_residual);
    x(group.unknowns) = mine;
  }
  return all;
}

std::string SeparatedSolver::name() const { return groups_.empty() ? "none" : groups_[0].solver->name(); }

const LinearCounts& SeparatedSolver::counts() const {
  total_ = retired_;
  for (const Group& group : groups_) total_ += group.solver->counts();
  return total_;
}

}  // namespace sprekk
