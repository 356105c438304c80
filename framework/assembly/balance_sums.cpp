#include "framework/assembly/balance_sums.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "framework/invariants.hpp"
#include "framework/parallel/parallel.hpp"
#include "framework/round_off.hpp"

namespace sprekk {
namespace {

double largest_weight(const Assembly::Block& block) {
  return std::abs(block.factor) * (block.weights ? block.weights->lpNorm<Eigen::Infinity>() : 1);
}

/// Calls use(row, column, value) for the entries of a block in rows that are owned.
template <class Use>
void for_entries(const Assembly::Block& block, const SparseMatrix& entries, const std::vector<char>& owned,
                 const Use& use) {
  SPREKK_EXPECT(static_cast<Eigen::Index>(owned.size()) == entries.rows(), owned.size(), entries.rows());
  for (int row = 0; row < entries.outerSize(); ++row) {
    if (!owned[row]) continue;
    const double scale = block.weights ? block.factor * (*block.weights)[row] : block.factor;
    for (SparseMatrix::InnerIterator entry(entries, row); entry; ++entry)
      use(row, static_cast<int>(entry.col()), scale * entry.value());
  }
}

/// Whether an unknown is a balance of the same quantity as those that are summed.
bool is_beside(const Assembly& assembly, const Balances::Quantity& summed, int unknown) {
  return std::ranges::any_of(assembly.balances().quantities(), [&](const Balances::Quantity& quantity) {
    return quantity.has(unknown) && quantity.has(summed.unknowns.front());
  });
}

/// An upper bound of the sum of the conductances by which unknowns on interfaces join the summed balances to others.
double held_through_interfaces(const Assembly& assembly, const Balances::Quantity& summed) {
  double held = 0;
  for (std::size_t w = 0; w < assembly.unknowns().size(); ++w) {
    const int flux = static_cast<int>(w);
    if (is_bulk(assembly.unknowns()[w]->spec().role.kind()) || is_beside(assembly, summed, flux)) continue;
    Vector own = Vector::Zero(assembly.unknowns()[w]->size());
    double amount = 0, answer = 0;
    for (const Assembly::Block& block : assembly.blocks()) {
      const auto sum_or_largest = [&](bool sum) {
        if (block.matrix->nonZeros() == 0) return 0.0;
        const Eigen::Map<const Vector> values(block.matrix->valuePtr(), block.matrix->nonZeros());
        return largest_weight(block) * (sum ? values.lpNorm<1>() : values.lpNorm<Eigen::Infinity>());
      };
      if (summed.has(block.row) && block.column == flux) amount += sum_or_largest(true);
      if (block.row == flux && summed.has(block.column)) answer += sum_or_largest(false);
      if (block.row == flux && block.column == flux)
        for_entries(block, *block.matrix, std::vector<char>(own.size(), 1), [&](int row, int column, double value) {
          if (row == column) own[row] += value;
        });
    }
    if (amount > 0 && answer > 0) held += amount * answer / own.cwiseAbs().minCoeff();
  }
  return held;
}

}  // namespace

bool is_weak(const Assembly& assembly, const Balances::Quantity& summed, bool also_coupled) {
  constexpr double weak = 1e-6;  // storage over exchange: below, rows are summed
  SPREKK_EXPECT(!summed.unknowns.empty(), summed.name);
  for (const Assembly::Fixed& fixed : assembly.fixed())
    if (summed.has(fixed.unknown)) return false;
  double exchanged = 0, passed_on = 0;  // what leads to other balances of the quantity holds these
  bool is_coupled = false, is_part = false;
  for (const Balances::Quantity& quantity : assembly.balances().quantities())
    is_part = is_part || (quantity.has(summed.unknowns.front()) && quantity.unknowns.size() > summed.unknowns.size());
  for (const Assembly::Block& block : assembly.blocks()) {
    if (!summed.has(block.row)) continue;
    if (summed.has(block.column)) {
      if (block.largest_exchange > 0) exchanged = std::max(exchanged, largest_weight(block) * block.largest_exchange);
    } else if (is_beside(assembly, summed, block.column)) {
      if (block.largest_exchange > 0)  // the sum of these balances misses it
        passed_on += largest_weight(block) *
                     Eigen::Map<const Vector>(block.matrix->valuePtr(), block.matrix->nonZeros()).lpNorm<1>();
    } else if (is_bulk(assembly.unknowns()[block.column]->spec().role.kind())) {
      const double* values = block.matrix->valuePtr();
      is_coupled =
          is_coupled || std::any_of(values, values + block.matrix->nonZeros(), [](double v) { return v != 0; });
    }
  }
  if (!also_coupled && parallel::any(is_coupled)) return false;
  exchanged = parallel::max(exchanged);
  if (exchanged == 0) return false;
  double held = passed_on;
  for (const int unknown : summed.unknowns) {
    Vector by_constant = Vector::Zero(assembly.unknowns()[unknown]->size());
    for (const Assembly::Block& block : assembly.blocks())
      if (block.row == unknown && summed.has(block.column))
        for_entries(block, *block.in_sum, std::vector<char>(by_constant.size(), 1),
                    [&](int row, int, double value) { by_constant[row] += value; });
    held += by_constant.lpNorm<1>();
  }
  if (is_part) held += held_through_interfaces(assembly, summed);
  return parallel::sum(held) <= weak * exchanged;
}

SumRow sum_of_rows(const Assembly& assembly, const Balances::Quantity& quantity,
                   const std::vector<std::vector<char>>& owned, const std::vector<int>& first) {
  SPREKK_EXPECT(owned.size() == assembly.unknowns().size(), owned.size());
  SPREKK_EXPECT(first.size() == assembly.unknowns().size(), first.size());
  struct Total {
    double value = 0, size = 0;
  };
  std::map<int, Total> totals;  // of this process's rows first
  for (const Assembly::Block& block : assembly.blocks())
    if (quantity.has(block.row))
      for_entries(block, *block.in_sum, owned[block.row], [&](int, int column, double value) {
        Total& total = totals[first[block.column] + column];
        total.value += value;
        total.size += std::abs(value);
      });
  if (parallel::size() > 1) {
    std::vector<int> columns;
    std::vector<double> values;
    for (const auto& [column, total] : totals) {
      columns.push_back(column);
      values.insert(values.end(), {total.value, total.size});
    }
    columns = parallel::gather(columns);
    values = parallel::gather(values);
    SPREKK_ASSERT(2 * columns.size() == values.size(), columns.size(), values.size());
    totals.clear();
    for (std::size_t k = 0; k < columns.size(); ++k) {
      totals[columns[k]].value += values[2 * k];
      totals[columns[k]].size += values[2 * k + 1];
    }
  }
  SumRow sum;
  for (const auto& [column, total] : totals) {
    if (std::abs(total.value) <= rounding::of_sum * total.size) continue;  // terms that cancel give no entry
    sum.columns.push_back(column);
    sum.values.push_back(total.value);
  }
  SPREKK_ASSERT(is_ascending(sum.columns));
  return sum;
}

int row_to_replace(const Assembly& assembly, const Balances::Quantity& quantity,
                   const std::vector<std::vector<char>>& owned, const std::vector<int>& first) {
  double strongest = 0;
  int mine = -1;
  for (const Assembly::Block& block : assembly.blocks()) {
    if (!quantity.has(block.row) || block.row != block.column || block.largest_exchange == 0) continue;
    for_entries(block, *block.matrix, owned[block.row], [&](int row, int column, double value) {
      if (row != column || std::abs(value) <= strongest) return;
      strongest = std::abs(value);
      mine = first[block.row] + row;
    });
  }
  const bool is_mine = mine >= 0 && strongest == parallel::max(strongest);
  return static_cast<int>(parallel::max(is_mine ? mine : -1.0));
}

double sum_of_residuals(const Assembly& assembly, int unknown, const std::vector<char>& owned) {
  double sum = 0;
  const Vector& residual = assembly.balances().residual(unknown);
  for (int row = 0; row < residual.size(); ++row)
    if (owned[row]) sum += residual[row];
  return parallel::sum(sum);
}

std::vector<Balances::Quantity> BalanceSums::sums_of(const Assembly& assembly,
                                                     const std::vector<std::vector<char>>& owned,
                                                     const std::vector<int>& first) const {
  std::vector<Balances::Quantity> sums;
  if (!are_used) return sums;
  for (const Balances::Quantity& quantity : assembly.balances().quantities()) {
    const bool is_whole = is_weak(assembly, quantity, are_used_where_coupled);
    if (is_whole) sums.push_back(quantity);
    if (quantity.unknowns.size() == 1) continue;
    // The sum of all balances takes the place of a row of one field; the other fields may need a sum of their own.
    const int row = is_whole ? row_to_replace(assembly, quantity, owned, first) : -1;
    for (const int unknown : quantity.unknowns) {
      if (row >= first[unknown] && row < first[unknown] + assembly.unknowns()[unknown]->size()) continue;
      const Balances::Quantity own{quantity.name, {unknown}};
      if (is_weak(assembly, own, are_used_where_coupled)) sums.push_back(own);
    }
  }
  return sums;
}

void BalanceSums::put_into(const LinearSystem& plain, const Assembly& assembly,
                           const std::vector<std::vector<char>>& owned, const std::vector<int>& first) {
  replaced_.clear();
  if (!are_used) return;
  std::map<int, SumRow> rows;  // by their place
  std::vector<int> sums;
  for (const Balances::Quantity& quantity : sums_of(assembly, owned, first)) {
    SumRow sum = sum_of_rows(assembly, quantity, owned, first);
    if (sum.columns.empty()) continue;  // nothing determines this mode: the solver will report it
    const int row = row_to_replace(assembly, quantity, owned, first);
    SPREKK_ASSERT(is_index(row, plain.local.cols()), quantity.name, row, plain.local.cols());
    sums.push_back(row);
    const auto place = std::lower_bound(plain.rows.begin(), plain.rows.end(), row);
    const bool is_mine = place != plain.rows.end() && *place == row;
    replaced_.push_back({quantity, is_mine ? static_cast<int>(place - plain.rows.begin()) : -1});
    if (is_mine) rows[replaced_.back().place] = std::move(sum);
  }
  if (replaced_.empty()) return;
  with_sums_.rows = plain.rows;
  with_sums_.blocks = plain.blocks;
  SPREKK_ASSERT(are_indices(sums, plain.local.cols()), plain.local.cols());
  with_sums_.sums = std::move(sums);
  with_sums_.pattern_number = 0;
  with_sums_.number = new_system_number();
  const SparseMatrix& rows_of_plain = plain.local;
  std::vector<int> outer{0}, inner;
  std::vector<double> values;
  for (int row = 0; row < rows_of_plain.rows(); ++row) {
    const auto sum = rows.find(row);
    const int start = rows_of_plain.outerIndexPtr()[row], end = rows_of_plain.outerIndexPtr()[row + 1];
    inner.insert(inner.end(), sum == rows.end() ? rows_of_plain.innerIndexPtr() + start : sum->second.columns.data(),
                 sum == rows.end() ? rows_of_plain.innerIndexPtr() + end
                                   : sum->second.columns.data() + sum->second.columns.size());
    values.insert(
        values.end(), sum == rows.end() ? rows_of_plain.valuePtr() + start : sum->second.values.data(),
        sum == rows.end() ? rows_of_plain.valuePtr() + end : sum->second.values.data() + sum->second.values.size());
    outer.push_back(static_cast<int>(inner.size()));
  }
  SparseMatrix& local = with_sums_.local;
  local.resize(rows_of_plain.rows(), rows_of_plain.cols());
  local.resizeNonZeros(inner.size());
  std::copy(outer.begin(), outer.end(), local.outerIndexPtr());
  std::copy(inner.begin(), inner.end(), local.innerIndexPtr());
  SPREKK_ASSERT(inner.size() == values.size() && outer.size() == plain.rows.size() + 1, inner.size(), values.size());
  std::copy(values.begin(), values.end(), local.valuePtr());
}

}  // namespace sprekk
