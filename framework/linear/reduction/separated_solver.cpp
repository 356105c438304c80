#include "framework/linear/reduction/separated_solver.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "framework/invariants.hpp"
#include "framework/joined_sets.hpp"
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
  JoinedSets joined_blocks(count);
  for (int row = 0; row < a.rows(); ++row) {
    char* joined = is_joined.data() + block_of[row] * count;
    for (SparseMatrix::InnerIterator entry(a, row); entry; ++entry) joined[block_of[entry.col()]] = 1;
  }
  for (int b = 0; b < count; ++b)
    for (int other = 0; other < count; ++other)
      if (is_joined[b * count + other]) joined_blocks.join(b, other);
  std::vector<int> set(count, -1), number(count, -1);
  sets = 0;
  for (int b = 0; b < count; ++b) {
    if (system.blocks[b].entities == 0) continue;
    int& mine = number[joined_blocks.root(b)];
    if (mine < 0) mine = sets++;
    set[b] = mine;
  }
  return set;
}

}  // namespace

/// For every unknown whether its entity is lone: the rows and columns of all its unknowns have a diagonal entry alone.
/// Empty where few are.
std::vector<char> lone_unknowns(const LinearSystem& system) {
  constexpr double worth_it = 0.1;  // of all unknowns: it copies the matrix once
  const SparseMatrix& a = system.local;
  std::vector<int> entries(a.cols(), 0);
  for (int row = 0; row < a.rows(); ++row)
    for (SparseMatrix::InnerIterator entry(a, row); entry; ++entry) {
      ++entries[entry.col()];
      if (entry.col() != row) entries[row] = 2;
    }
  std::vector<char> lone(a.cols(), 0);
  int count = 0;
  for (const UnknownBlock& block : system.blocks)
    for (int first = block.first; first < block.first + block.entities * block.components; first += block.components) {
      const auto own = entries.begin() + first;
      if (!std::all_of(own, own + block.components, [](int n) { return n == 1; })) continue;
      std::fill_n(lone.begin() + first, block.components, 1);
      count += block.components;
    }
  if (count < worth_it * static_cast<double>(a.cols()) || count == a.cols()) return {};
  return lone;
}

/// The block without its lone entities, which begins at unknown `first` of a part.
UnknownBlock without_lone(const UnknownBlock& block, const std::vector<char>& lone, int first) {
  UnknownBlock rest = block;
  rest.first = first;
  if (lone.empty()) return rest;
  std::vector<int> entities;
  std::vector<double> stabilization;
  for (int i = 0; i < block.entities; ++i) {
    if (lone[block.first + i * block.components]) continue;
    entities.push_back(i);
    if (block.stabilization.size() > 0)
      for (int k = 0; k < block.components; ++k) stabilization.push_back(block.stabilization[i * block.components + k]);
  }
  rest.entities = static_cast<int>(entities.size());
  if (block.has_coordinates()) rest.coordinates = block.coordinates(Eigen::all, entities);
  if (block.stabilization.size() > 0)
    rest.stabilization = Eigen::Map<Vector>(stabilization.data(), stabilization.size());
  return rest;
}

bool SeparatedSolver::fits(const LinearSystem& system) const {
  const SparseMatrix& a = system.local;
  if (groups_.empty()) return false;
  if (system.pattern_number != 0 && system.pattern_number == pattern_number_) return true;
  return static_cast<int>(inner_.size()) == a.nonZeros() && static_cast<int>(outer_.size()) == a.rows() + 1 &&
         std::equal(outer_.begin(), outer_.end(), a.outerIndexPtr()) &&
         std::equal(inner_.begin(), inner_.end(), a.innerIndexPtr());
}

void SeparatedSolver::separate(const LinearSystem& system, Lone where) {
  const SparseMatrix& a = system.local;
  int sets = 1;
  std::vector<int> set_of_block(system.blocks.size(), 0);
  const bool can_separate = parallel::size() == 1 && a.isCompressed() && system.blocks.size() > 1;
  if (can_separate) set_of_block = sets_of_blocks(system, sets);
  std::vector<char> lone;
  if (where == Lone::apart && parallel::size() == 1 && a.isCompressed()) lone = lone_unknowns(system);
  // A single part keeps its solver, with its ordering, when the pattern changes.
  if (groups_.size() != 1 || sets != 1 || !lone.empty() || !lone_.empty()) {
    for (const Group& group : groups_) retired_ += group.solver->counts();
    groups_.clear();
    groups_.resize(std::max(1, sets));
    for (Group& group : groups_) group.solver = make_();
  }
  outer_.clear();
  inner_.clear();
  lone_.clear();
  for (int unknown = 0; unknown < static_cast<int>(lone.size()); ++unknown)
    if (lone[unknown]) lone_.push_back(unknown);
  if (is_passed_on()) return;

  outer_.assign(a.outerIndexPtr(), a.outerIndexPtr() + a.rows() + 1);
  inner_.assign(a.innerIndexPtr(), a.innerIndexPtr() + a.nonZeros());
  std::vector<int> place(a.cols(), 0);
  for (std::size_t b = 0; b < system.blocks.size(); ++b) {
    if (set_of_block[b] < 0) continue;
    const UnknownBlock& block = system.blocks[b];
    Group& group = groups_[set_of_block[b]];
    UnknownBlock rest = without_lone(block, lone, static_cast<int>(group.unknowns.size()));
    if (rest.entities > 0) group.system.blocks.push_back(std::move(rest));
    for (int unknown = block.first; unknown < block.first + block.entities * block.components; ++unknown) {
      if (!lone.empty() && lone[unknown]) continue;
      place[unknown] = static_cast<int>(group.unknowns.size());
      group.unknowns.push_back(unknown);
    }
  }
  std::erase_if(groups_, [](const Group& group) { return group.unknowns.empty(); });
  for (Group& group : groups_) {
    std::vector<int> starts{0}, columns;
    for (const int row : group.unknowns) {
      for (int k = outer_[row]; k < outer_[row + 1]; ++k) {
        columns.push_back(place[inner_[k]]);
        group.source.add(k);
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

bool SeparatedSolver::take_lone(const SparseMatrix& a) {
  of_lone_.resize(static_cast<Eigen::Index>(lone_.size()));
  for (std::size_t i = 0; i < lone_.size(); ++i) {
    of_lone_[i] = a.valuePtr()[a.outerIndexPtr()[lone_[i]]];
    if (of_lone_[i] == 0 || !std::isfinite(of_lone_[i])) return false;
  }
  return true;
}

LinearReport SeparatedSolver::factor(const LinearSystem& system) {
  expect_sound(system);
  if (!fits(system)) separate(system, Lone::apart);
  if (!take_lone(system.local)) separate(system, Lone::within);  // singular: the solver says where
  const bool is_same = system.number != 0 && system.number == number_;
  pattern_number_ = system.pattern_number;
  number_ = system.number;
  if (is_passed_on()) return groups_[0].solver->factor(system);
  for (Group& group : groups_) {
    if (!is_same && group.source.take(system.local.valuePtr(), group.system.local.valuePtr()))
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
  if (is_passed_on()) return groups_[0].solver->solve(b_rows, x);
  x = Vector::Zero(b_rows.size());
  if (!lone_.empty()) x(lone_) = b_rows(lone_).cwiseQuotient(of_lone_);
#ifdef SPREKK_ASSERTIONS
  auto unknowns_of_groups = static_cast<Eigen::Index>(lone_.size());
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
