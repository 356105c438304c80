#include "framework/linear/reduction/summed_balances.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "framework/invariants.hpp"
#include "framework/joined_sets.hpp"
#include "framework/linear/expect_sound.hpp"
#include "framework/linear/gather_entries.hpp"
#include "framework/parallel/parallel.hpp"

namespace sprekk {
namespace {

std::vector<char> rows_of_interfaces(const std::vector<UnknownBlock>& blocks, Eigen::Index size) {
  std::vector<char> is_local(size, 0);
  for (const UnknownBlock& block : blocks)
    if (block.kind == BlockKind::interface)
      std::fill_n(is_local.begin() + block.first, block.entities * block.components, 1);
  return is_local;
}

/// The rows of local blocks, of all processes, at their places in the whole system.
SparseMatrix local_rows(const LinearSystem& system) {
  const std::vector<char> is_local = rows_of_interfaces(system.blocks, system.local.cols());
  SparseMatrix whole(system.local.cols(), system.local.cols());
  if (parallel::size() == 1) {
    int entries = 0;
    for (int row = 0; row < system.local.rows(); ++row)
      if (is_local[row]) entries += static_cast<int>(system.local.innerVector(row).nonZeros());
    whole.reserve(entries);
    for (int row = 0; row < system.local.rows(); ++row) {
      whole.startVec(row);
      if (!is_local[row]) continue;
      for (SparseMatrix::InnerIterator entry(system.local, row); entry; ++entry)
        whole.insertBackByOuterInnerUnordered(row, entry.col()) = entry.value();
    }
    whole.finalize();
    return whole;
  }
  std::vector<Triplet> entries;
  for (int i = 0; i < system.local.rows(); ++i) {
    if (!is_local[system.rows[i]]) continue;
    for (SparseMatrix::InnerIterator entry(system.local, i); entry; ++entry)
      entries.emplace_back(system.rows[i], static_cast<int>(entry.col()), entry.value());
  }
  return gather_entries(entries, static_cast<int>(system.local.cols()), static_cast<int>(system.local.cols()));
}

/// The entries of a column in the rows of one block.
struct Column {
  int entries = 0, first = -1, second = -1;
  double value = 0, sum = 0;
};

/// The columns outside of [first, end) that those rows have entries in, ascending. Counts them in `columns`.
std::vector<int> columns_outside(const SparseMatrix& a, int first, int end, std::vector<Column>& columns) {
  std::vector<int> found;
  for (int row = first; row < end; ++row)
    for (SparseMatrix::InnerIterator entry(a, row); entry; ++entry) {
      const int at = static_cast<int>(entry.col());
      if (entry.value() == 0 || (at >= first && at < end)) continue;
      Column& column = columns[at];
      ++column.entries;
      (column.entries == 1 ? column.first : column.second) = row;
      if (column.entries == 1) {
        column.value = entry.value();
        found.push_back(at);
      }
      column.sum += entry.value();
    }
  std::sort(found.begin(), found.end());
  return found;
}

/// Whether the flux at a row leads from the rows [first, end) to local unknowns with a zero diagonal, such as the
/// potential of an entity whose flux is given: these follow any change, and do not determine the constant.
bool leads_to_what_follows(const SparseMatrix& a, int flux, int first, int end, const std::vector<char>& is_local) {
  bool leads = false;
  for (SparseMatrix::InnerIterator entry(a, flux); entry; ++entry) {
    const int at = static_cast<int>(entry.col());
    if (entry.value() == 0 || at == flux || (at >= first && at < end)) continue;
    if (!is_local[at] || a.coeff(at, at) != 0) return false;
    leads = true;
  }
  return leads;
}

/// Whether adding `factor` times a row to a sum of rows leaves no entry of that row.
bool cancels(const SparseMatrix& a, int row, double factor, const std::map<int, double>& sum) {
  constexpr double round_off = 1e-15;  // of the entry: what a flux that another row gives may leave in the sum
  for (SparseMatrix::InnerIterator entry(a, row); entry; ++entry) {
    if (entry.value() == 0) continue;
    const auto own = sum.find(static_cast<int>(entry.col()));
    const double added = factor * entry.value();
    if (own == sum.end() || std::abs(own->second + added) > round_off * std::abs(added)) return false;
  }
  return true;
}

/// Takes fluxes that other rows prescribe out of a sum: in one row with them, what is stored would be lost to
/// round-off. Returns these rows with the factors by which they are added.
std::vector<std::pair<int, double>> take_out_given_fluxes(const SparseMatrix& a, const std::vector<int>& group,
                                                          const std::vector<char>& is_local,
                                                          std::map<int, double>& sum) {
  std::vector<std::pair<int, double>> added;
  const std::map<int, double> whole = sum;
  for (const auto& [flux, value] : whole) {
    if (!is_local[flux] || sum.find(flux) == sum.end() || !std::isfinite(value) || value == 0) continue;
    if (!leads_to_what_follows(a, flux, group.front(), group.back() + 1, is_local)) continue;
    for (SparseMatrix::InnerIterator entry(a, flux); entry; ++entry) {
      const int giving = static_cast<int>(entry.col());
      if (giving == flux || std::binary_search(group.begin(), group.end(), giving) || entry.value() == 0) continue;
      const double given = a.coeff(giving, flux);
      if (given == 0 || !cancels(a, giving, -value / given, sum)) continue;
      added.emplace_back(giving, -value / given);
      for (SparseMatrix::InnerIterator out(a, giving); out; ++out) sum.erase(static_cast<int>(out.col()));
      break;
    }
  }
  return added;
}

/// The sum of rows without the entries that cancel. An entry whose terms are all zero stays, so that the pattern does
/// not depend on the values.
std::map<int, double> sum_of(const SparseMatrix& a, const std::vector<int>& rows) {
  struct Total {
    double value = 0;
    int entries = 0;
  };
  std::map<int, Total> totals;
  for (const int row : rows)
    for (SparseMatrix::InnerIterator entry(a, row); entry; ++entry) {
      Total& total = totals[static_cast<int>(entry.col())];
      total.value += entry.value();
      ++total.entries;
    }
  std::map<int, double> sum;
  for (const auto& [column, total] : totals)
    if (total.value != 0 || total.entries == 1) sum.emplace_hint(sum.end(), column, total.value);
  return sum;
}

/// Of rows of this process, by their places: entries that stand in place of those that they had, or are added as zeros.
using OtherEntries = std::map<int, std::map<int, double>>;

/// Adds, as zeros, the entries that rows have where they are sums: for the first row of each group that exchanges may
/// join, those that the sum of the group may have. Which groups are summed follows from values, these entries do not.
void add_pattern_of_sums(const SparseMatrix& all, const LinearSystem& system, OtherEntries& others) {
  for (const PossibleSum& sum : possible_sums(all, system.blocks)) {
    const auto found = std::lower_bound(system.rows.begin(), system.rows.end(), sum.rows.front());
    if (found == system.rows.end() || *found != sum.rows.front()) continue;
    const int place = static_cast<int>(found - system.rows.begin());
    const auto [other, is_new] = others.try_emplace(place);
    if (is_new)
      for (SparseMatrix::InnerIterator entry(system.local, place); entry; ++entry)
        other->second[static_cast<int>(entry.col())] = entry.value();
    for (const int column : sum.columns) other->second.try_emplace(column, 0.0);
  }
}

SparseMatrix with_other_entries(const SparseMatrix& a, const OtherEntries& others) {
  Eigen::Index entries = a.nonZeros();
  for (const auto& [row, other] : others) entries += static_cast<Eigen::Index>(other.size());
  SparseMatrix result(a.rows(), a.cols());
  result.reserve(entries);
  for (int row = 0; row < a.rows(); ++row) {
    result.startVec(row);
    if (const auto other = others.find(row); other != others.end()) {
      for (const auto& [column, value] : other->second) result.insertBack(row, column) = value;
      continue;
    }
    for (SparseMatrix::InnerIterator entry(a, row); entry; ++entry) result.insertBack(row, entry.col()) = entry.value();
  }
  result.finalize();
  return result;
}

}  // namespace

std::vector<PossibleSum> possible_sums(const SparseMatrix& rows, const std::vector<UnknownBlock>& blocks) {
  std::vector<PossibleSum> possible;
  struct Entries {
    int count = 0, first = -1, second = -1;
  };
  std::vector<Entries> columns(rows.cols());
  for (const UnknownBlock& block : blocks) {
    if (block.kind != BlockKind::interface || !block.may_store) continue;
    const int first = block.first, size = block.entities * block.components;
    std::vector<int> seen;
    for (int row = first; row < first + size; ++row)
      for (SparseMatrix::InnerIterator entry(rows, row); entry; ++entry) {
        Entries& column = columns[entry.col()];
        if (++column.count == 1) seen.push_back(static_cast<int>(entry.col()));
        (column.count == 1 ? column.first : column.second) = row;
      }
    JoinedSets joined(size);
    const auto joins = [&](int column) {
      return columns[column].count == 2 && (column < first || column >= first + size);
    };
    for (const int column : seen)
      if (joins(column)) joined.join(columns[column].second - first, columns[column].first - first);
    std::map<int, PossibleSum> groups;
    for (int row = first; row < first + size; ++row) {
      PossibleSum& group = groups[joined.root(row - first)];
      group.rows.push_back(row);
      for (SparseMatrix::InnerIterator entry(rows, row); entry; ++entry)
        if (!joins(static_cast<int>(entry.col()))) group.columns.push_back(static_cast<int>(entry.col()));
    }
    for (const int column : seen) columns[column] = {};
    for (auto& [root, group] : groups) {
      if (group.rows.size() == 1) continue;
      std::sort(group.columns.begin(), group.columns.end());
      group.columns.erase(std::unique(group.columns.begin(), group.columns.end()), group.columns.end());
      possible.push_back(std::move(group));
    }
  }
  return possible;
}

std::vector<std::vector<int>> exchanging_rows(const SparseMatrix& rows, const std::vector<UnknownBlock>& blocks) {
  constexpr double weak = 1e-6, closed = 1e-3;  // storage, and conductance to other groups, over what rows exchange
  SPREKK_EXPECT(rows.rows() == rows.cols(), rows.rows(), rows.cols());
  std::vector<std::vector<int>> groups;
  const std::vector<char> is_local = rows_of_interfaces(blocks, rows.cols());
  std::vector<Column> columns(rows.cols());
  for (const UnknownBlock& block : blocks) {
    if (block.kind != BlockKind::interface || !block.may_store) continue;
    const int first = block.first, size = block.entities * block.components;
    JoinedSets joined(size);
    std::vector<double> weakest(size, HUGE_VAL), strongest(size, 0), outwards(size, 0);
    for (const int at : columns_outside(rows, first, first + size, columns)) {
      const Column column = std::exchange(columns[at], Column{});
      if (column.entries > 2 || (column.entries == 2 && column.sum != 0)) continue;
      const auto conductance = [&](int row) {
        return std::abs(column.value * rows.coeff(at, row) / rows.coeff(at, at));
      };
      const bool joins = column.entries == 2;
      // A flux that depends on other fluxes only, or on nothing, does not connect two balances.
      if (joins && conductance(column.first) == 0 && conductance(column.second) == 0) continue;
      for (const int row : {column.first, column.second}) {
        if (row < 0 || std::isnan(conductance(row))) continue;
        if (joins) {
          weakest[row - first] = std::min(weakest[row - first], conductance(row));
          strongest[row - first] = std::max(strongest[row - first], conductance(row));
        } else if (!leads_to_what_follows(rows, at, first, first + size, is_local)) {
          outwards[row - first] = std::max(outwards[row - first], conductance(row));
        }
      }
      if (joins) joined.join(column.second - first, column.first - first);
    }
    std::map<int, std::vector<int>> members;
    for (int row = 0; row < size; ++row) members[joined.root(row)].push_back(first + row);
    for (auto& [root, group] : members) {
      double inside = 0, outside = 0;
      bool stores_little = group.size() > 1;
      for (const int row : group) {
        inside = std::max(inside, strongest[row - first]);
        outside = std::max(outside, outwards[row - first]);
        stores_little = stores_little && std::abs(rows.coeff(row, row)) <= weak * weakest[row - first];
      }
      if (stores_little && outside <= closed * inside) groups.push_back(std::move(group));
    }
  }
  return groups;
}

SummedBalances::SummedBalances(std::unique_ptr<LinearSolver> solver) : solver_(std::move(solver)) {}

LinearReport SummedBalances::factor(const LinearSystem& system) {
  expect_sound(system);
  sums_.clear();
  const bool is_alone = parallel::size() == 1 && system.local.rows() == system.local.cols();
  const SparseMatrix gathered = is_alone ? SparseMatrix() : local_rows(system);
  const SparseMatrix& rows = is_alone ? system.local : gathered;
  OtherEntries replaced;
  std::vector<char> is_local;
  for (std::vector<int>& group : exchanging_rows(rows, system.blocks)) {
    Sum sum;
    for (const int row : group) {
      const auto found = std::lower_bound(system.rows.begin(), system.rows.end(), row);
      if (found == system.rows.end() || *found != row) continue;
      sum.owned.push_back(static_cast<int>(found - system.rows.begin()));
      if (row == group.front()) sum.replaced = sum.owned.back();
    }
    if (is_local.empty()) is_local = rows_of_interfaces(system.blocks, rows.cols());
    std::map<int, double> entries = sum_of(rows, group);
    sum.given = take_out_given_fluxes(rows, group, is_local, entries);
    for (const auto& [row, factor] : sum.given) {
      const auto found = std::lower_bound(system.rows.begin(), system.rows.end(), row);
      if (found != system.rows.end() && *found == row)
        sum.owned_given.emplace_back(static_cast<int>(found - system.rows.begin()), factor);
    }
    if (sum.replaced >= 0) replaced[sum.replaced] = std::move(entries);
    sum.rows = std::move(group);
    sums_.push_back(std::move(sum));
  }
  if (sums_.empty()) return solver_->factor(system);

  LinearSystem summed;
  summed.rows = system.rows;
  summed.blocks = system.blocks;
  summed.sums = system.sums;
  for (const Sum& sum : sums_) summed.sums.push_back(sum.rows.front());
  for (auto& [row, sum] : replaced)
    for (SparseMatrix::InnerIterator entry(system.local, row); entry; ++entry)
      sum.try_emplace(static_cast<int>(entry.col()), 0.0);
  add_pattern_of_sums(rows, system, replaced);
  summed.local = with_other_entries(system.local, replaced);
  return solver_->factor(summed);
}

LinearReport SummedBalances::solve(const Vector& b_rows, Vector& x) {
  if (sums_.empty()) return solver_->solve(b_rows, x);
  Vector totals = Vector::Zero(sums_.size());
#ifdef SPREKK_ASSERTIONS
  for (const Sum& sum : sums_) SPREKK_ASSERT(are_indices(sum.owned, b_rows.size()), b_rows.size());
#endif
  for (std::size_t s = 0; s < sums_.size(); ++s) {
    for (const int place : sums_[s].owned) totals[s] += b_rows[place];
    for (const auto& [place, factor] : sums_[s].owned_given) totals[s] += factor * b_rows[place];
  }
  parallel::sum(totals);
  Vector b = b_rows;
  for (std::size_t s = 0; s < sums_.size(); ++s)
    if (sums_[s].replaced >= 0) b[sums_[s].replaced] = totals[s];
  return solver_->solve(b, x);
}

std::optional<LinearReport> SummedBalances::factor_bordered(const LinearSystem& system, const SparseMatrix& columns,
                                                            const SparseMatrix& rows, Eigen::MatrixXd& schur) {
  const bool is_alone = parallel::size() == 1;
  if (!exchanging_rows(is_alone ? system.local : local_rows(system), system.blocks).empty()) return std::nullopt;
  sums_.clear();
  return solver_->factor_bordered(system, columns, rows, schur);
}

bool SummedBalances::solve_columns(Eigen::Ref<Eigen::MatrixXd> columns) {
  for (const Sum& sum : sums_) {
    SPREKK_ASSERT(are_indices(sum.owned, columns.rows()), columns.rows());
    Vector total = Vector::Zero(columns.cols());
    for (const int row : sum.owned) total += columns.row(row);
    for (const auto& [row, factor] : sum.owned_given) total += factor * columns.row(row);
    parallel::sum(total);
    if (sum.replaced >= 0) columns.row(sum.replaced) = total;
  }
  return solver_->solve_columns(columns);
}

}  // namespace sprekk
