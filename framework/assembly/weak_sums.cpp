#include "framework/assembly/weak_sums.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "framework/parallel/parallel.hpp"

namespace sprekk {
namespace {

bool has(const Assembly::Conserved& conserved, int unknown) {
  return std::find(conserved.rows.begin(), conserved.rows.end(), unknown) != conserved.rows.end();
}

double largest_weight(const Assembly::Block& block) {
  return std::abs(block.factor) * (block.weights ? block.weights->lpNorm<Eigen::Infinity>() : 1);
}

/// Calls use(row, column, value) for the entries of a block in rows that are owned.
template <class Use>
void for_entries(const Assembly::Block& block, const SparseMatrix& entries, const std::vector<char>& owned,
                 const Use& use) {
  for (int row = 0; row < entries.outerSize(); ++row) {
    if (!owned[row]) continue;
    const double scale = block.weights ? block.factor * (*block.weights)[row] : block.factor;
    for (SparseMatrix::InnerIterator entry(entries, row); entry; ++entry)
      use(row, static_cast<int>(entry.col()), scale * entry.value());
  }
}

}  // namespace

bool is_weak(const Assembly& assembly, const Assembly::Conserved& conserved, bool also_answered) {
  constexpr double weak = 1e-6;
  for (const Assembly::Fixed& fixed : assembly.fixed())
    if (has(conserved, fixed.unknown)) return false;
  double exchanged = 0;
  bool is_answered = false;
  for (const Assembly::Block& block : assembly.blocks()) {
    if (!has(conserved, block.row)) continue;
    if (has(conserved, block.column)) {
      if (block.largest_exchange > 0) exchanged = std::max(exchanged, largest_weight(block) * block.largest_exchange);
    } else if (is_bulk(assembly.unknowns()[block.column]->spec().role.kind())) {
      const double* values = block.matrix->valuePtr();
      is_answered =
          is_answered || std::any_of(values, values + block.matrix->nonZeros(), [](double v) { return v != 0; });
    }
  }
  if (!also_answered && parallel::any(is_answered)) return false;
  exchanged = parallel::max(exchanged);
  if (exchanged == 0) return false;
  double held = 0;
  for (const Assembly::Block& block : assembly.blocks())
    if (has(conserved, block.row) && has(conserved, block.column) && block.in_sum->nonZeros() > 0)
      held += largest_weight(block) *
              Eigen::Map<const Vector>(block.in_sum->valuePtr(), block.in_sum->nonZeros()).lpNorm<1>();
  return parallel::sum(held) <= weak * exchanged;
}

SumRow sum_of_rows(const Assembly& assembly, const Assembly::Conserved& conserved,
                   const std::vector<std::vector<char>>& owned, const std::vector<int>& first) {
  std::vector<int> columns;
  std::vector<double> values;
  for (const Assembly::Block& block : assembly.blocks())
    if (has(conserved, block.row))
      for_entries(block, *block.in_sum, owned[block.row], [&](int, int column, double value) {
        columns.push_back(first[block.column] + column);
        values.push_back(value);
      });
  columns = parallel::gather(columns);
  values = parallel::gather(values);
  struct Total {
    double value = 0, size = 0;
  };
  std::map<int, Total> totals;
  for (std::size_t k = 0; k < columns.size(); ++k) {
    Total& total = totals[columns[k]];
    total.value += values[k];
    total.size += std::abs(values[k]);
  }
  constexpr double round_off = 64 * std::numeric_limits<double>::epsilon();
  SumRow sum;
  for (const auto& [column, total] : totals) {
    if (std::abs(total.value) <= round_off * total.size) continue;  // what cancels is no entry
    sum.columns.push_back(column);
    sum.values.push_back(total.value);
  }
  return sum;
}

int row_to_replace(const Assembly& assembly, const Assembly::Conserved& conserved,
                   const std::vector<std::vector<char>>& owned, const std::vector<int>& first) {
  double strongest = 0;
  int mine = -1;
  for (const Assembly::Block& block : assembly.blocks()) {
    if (!has(conserved, block.row) || block.row != block.column || block.largest_exchange == 0) continue;
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
  const Vector& residual = assembly.in_sum(unknown);
  for (int row = 0; row < residual.size(); ++row)
    if (owned[row]) sum += residual[row];
  return parallel::sum(sum);
}

}  // namespace sprekk
