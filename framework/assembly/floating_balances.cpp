#include "framework/assembly/floating_balances.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "framework/invariants.hpp"
#include "framework/joined_sets.hpp"
#include "framework/parallel/parallel.hpp"
#include "framework/round_off.hpp"

namespace sprekk {
namespace {

/// A sum of entries, and that of their absolute values.
struct Sum {
  double value = 0, size = 0;
  void add(double entry) {
    value += entry;
    size += std::abs(entry);
  }
  bool is_difference() const { return std::abs(value) <= rounding::of_terms * size; }
};

void join_with_other_processes(JoinedSets& sets, int count) {
  std::vector<int> pairs;
  for (int i = 0; i < count; ++i)
    if (sets.root(i) != i) pairs.insert(pairs.end(), {i, sets.root(i)});
  pairs = parallel::gather(pairs);
  for (std::size_t k = 0; k + 1 < pairs.size(); k += 2) sets.join(pairs[k], pairs[k + 1]);
}

/// The rows and columns of one quantity in an assembly.
class Potentials {
 public:
  Potentials(const Assembly& assembly, const Balances::Quantity& quantity, const std::vector<std::vector<char>>& owned,
             const std::vector<int>& first)
      : assembly_(assembly), quantity_(quantity), owned_(owned), first_(first) {
    const std::string& unit = assembly.unknowns()[quantity.unknowns.front()]->spec().unit;
    for (std::size_t u = 0; u < assembly.unknowns().size(); ++u) {
      const FieldSpec& spec = assembly.unknowns()[u]->spec();
      are_potentials_.push_back(
          quantity.has(static_cast<int>(u)) ||
          (spec.components == 1 && spec.unit == unit && !assembly.balances().are_rows_of(static_cast<int>(u))));
    }
  }

  /// Whether each balance stores something, so that none floats.
  bool all_store() const {
    bool all = true;
    for (const int unknown : quantity_.unknowns) {
      std::vector<char> stores(owned_[unknown].size(), 0);
      for (const Assembly::Block& block : assembly_.blocks())
        if (block.row == unknown && block.column == unknown && block.largest_exchange == 0)
          for_rows(block, *block.matrix, [&](int row, const Sum& sum) { stores[row] |= !sum.is_difference(); });
      for (std::size_t row = 0; row < stores.size(); ++row) all = all && (stores[row] || !owned_[unknown][row]);
    }
    return !parallel::any(!all);
  }

  std::vector<FloatingBalances> find(int number, Floating told) {
    const int count = size();
    JoinedSets sets(count);
    Vector holds = Vector::Zero(count);
    for (std::size_t u = 0; u < assembly_.unknowns().size(); ++u) take_rows(static_cast<int>(u), sets, holds);
    for (const Assembly::Fixed& fixed : assembly_.fixed())
      if (are_potentials_[fixed.unknown]) holds[first_[fixed.unknown] + fixed.row] = 1;
    join_with_other_processes(sets, count);
    parallel::sum(holds);
    std::vector<char> is_held(count, 0);
    for (int i = 0; i < count; ++i)
      if (holds[i] > 0) is_held[sets.root(i)] = 1;
    std::map<int, FloatingBalances> found;  // by root
    for (const int unknown : quantity_.unknowns)
      for (int i = first_[unknown]; i < first_[unknown] + assembly_.unknowns()[unknown]->size(); ++i)
        if (!is_held[sets.root(i)])
          ++found.try_emplace(sets.root(i), FloatingBalances{number, i, 0}).first->second.balances;
    int held = 0;
    for (const int unknown : quantity_.unknowns) held += assembly_.unknowns()[unknown]->size();
    for (const auto& [root, set] : found) held -= set.balances;
    if (told == Floating::everywhere && held > 0) return {};
    std::vector<FloatingBalances> floating;
    for (const auto& [root, set] : found) floating.push_back(set);
    return floating;
  }

 private:
  int size() const { return first_.back() + assembly_.unknowns().back()->size(); }

  /// Calls use(row, sum) for the sums of the entries of a block in rows that are owned and have some.
  template <class Use>
  void for_rows(const Assembly::Block& block, const SparseMatrix& entries, const Use& use) const {
    for (int row = 0; row < entries.outerSize(); ++row) {
      if (!owned_[block.row][row]) continue;
      const double scale = block.weights ? block.factor * (*block.weights)[row] : block.factor;
      Sum sum;
      for (SparseMatrix::InnerIterator entry(entries, row); entry; ++entry) sum.add(scale * entry.value());
      if (sum.size > 0) use(row, sum);
    }
  }

  /// Joins the potentials that a row has entries for, and finds the rows that hold them.
  void take_rows(int unknown, JoinedSets& sets, Vector& holds) const {
    const auto rows = static_cast<int>(owned_[unknown].size());
    std::vector<int> of_row(rows, -1);  // a potential of the row
    std::vector<Sum> leaving(rows), differences(rows);
    std::vector<char> is_held(rows, 0);
    const bool are_balances = quantity_.has(unknown);
    for (const Assembly::Block& block : assembly_.blocks()) {
      if (block.row != unknown || !are_potentials_[block.column]) continue;
      for (int row = 0; row < block.matrix->outerSize(); ++row) {
        if (!owned_[unknown][row] || (block.weights ? block.factor * (*block.weights)[row] : block.factor) == 0)
          continue;
        for (SparseMatrix::InnerIterator entry(*block.matrix, row); entry; ++entry) {
          if (entry.value() == 0) continue;
          const int potential = first_[block.column] + static_cast<int>(entry.col());
          if (of_row[row] >= 0) sets.join(of_row[row], potential);
          of_row[row] = potential;
        }
      }
      if (are_balances && block.largest_exchange > 0) {
        // What leaves all rows is judged by what they exchange, of which it may be the round-off.
        for_rows(block, *block.in_sum, [&](int row, const Sum& sum) { leaving[row].value += sum.value; });
        for_rows(block, *block.matrix, [&](int row, const Sum& sum) { leaving[row].size += sum.size; });
        continue;
      }
      for_rows(block, *block.matrix, [&](int row, const Sum& sum) {
        if (are_balances) is_held[row] |= !sum.is_difference();  // it may be any part of what is exchanged
        differences[row].value += sum.value;
        differences[row].size += sum.size;
      });
    }
    for (int row = 0; row < rows; ++row)
      if (of_row[row] >= 0 &&
          (is_held[row] || !leaving[row].is_difference() || (!are_balances && !differences[row].is_difference())))
        holds[of_row[row]] = 1;
  }

  const Assembly& assembly_;
  const Balances::Quantity& quantity_;
  const std::vector<std::vector<char>>& owned_;
  const std::vector<int>& first_;
  std::vector<char> are_potentials_;
};

}  // namespace

std::vector<FloatingBalances> floating_balances(const Assembly& assembly, const std::vector<std::vector<char>>& owned,
                                                const std::vector<int>& first, Floating told) {
  SPREKK_EXPECT(assembly.wants_derivatives());
  SPREKK_EXPECT(owned.size() == assembly.unknowns().size() && first.size() == owned.size(), owned.size(), first.size());
  std::vector<FloatingBalances> floating;
  int number = 0;
  for (const Balances::Quantity& quantity : assembly.balances().quantities()) {
    Potentials potentials(assembly, quantity, owned, first);
    if (!potentials.all_store()) std::ranges::copy(potentials.find(number, told), std::back_inserter(floating));
    ++number;
  }
  return floating;
}

}  // namespace sprekk
