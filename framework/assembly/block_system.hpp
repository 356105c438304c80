// From an assembly to the sparse system of the rows that this process owns.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "framework/assembly/assembly.hpp"
#include "framework/assembly/balance_sums.hpp"
#include "framework/assembly/floating_balances.hpp"
#include "framework/linear/linear_solver.hpp"
#include "framework/mesh/mesh.hpp"

namespace sprekk {

/// Numbers the unknowns of a solve one field after the other, and makes the sparse system of an assembly. The sparsity
/// pattern is kept from one assembly to the next: when only values have changed, only values are copied, and values of
/// equations that have not changed stay.
class BlockSystem {
 public:
  BlockSystem(const Mesh& mesh, std::vector<const Field*> unknowns);

  int size() const { return size_; }
  int first(int unknown) const { return first_[unknown]; }
  const std::vector<int>& rows() const { return system_.rows; }

  /// The Jacobian of the owned rows. The reference stays valid until the next call.
  const LinearSystem& matrix(const Assembly& assembly);
  /// The residual of the owned rows.
  Vector residual(const Assembly& assembly) const;
  /// Sums of balances in the place of one of them, where that is allowed and needed.
  const BalanceSums& sums() const { return sums_; }
  /// The balances whose sums are in the linear system of an assembly. Collective.
  std::vector<Balances::Quantity> sums_of(const Assembly& assembly) const {
    return sums_.sums_of(assembly, owned_, first_);
  }
  /// The unknown in one of whose rows the sum of a quantity stands. Collective.
  int unknown_with_sum(const Assembly& assembly, const Balances::Quantity& quantity) const;
  /// "" or, where nothing holds some balances of an assembly, a sentence that says which. Collective.
  std::string describe_floating(const Assembly& assembly, Floating told = Floating::somewhere) const;
  void use_sums(bool wanted) { sums_.are_used = wanted; }
  void use_coupled_sums(bool wanted);
  /// The sum over all processes of the residuals of balances, without the round-off of what rows exchange. Collective.
  double residual_of_sum(const Assembly& assembly, int unknown) const {
    return sum_of_residuals(assembly, unknown, owned_[unknown]);
  }
  /// For every row of an unknown: whether this process owns it.
  const std::vector<char>& owned(int unknown) const { return owned_[unknown]; }
  /// The preconditioner's diagonal of a block (see UnknownBlock::stabilization).
  void set_stabilization(const Field& field, const Vector& diagonal);

  int patterns_built() const { return patterns_built_; }

 private:
  /// A block of the last matrix: the number of its operator, or a copy of its entries.
  struct Known {
    int row, column;
    double factor;
    Vector weights;  ///< empty for none
    std::uint64_t number;
    SparseMatrix entries;
    bool has_pattern_of(const Assembly::Block& block) const;
    bool has_values_of(const Assembly::Block& block) const;
  };
  void remember(const Assembly& assembly);
  bool has_same_fixed(const Assembly& assembly) const;
  /// For each unknown: whether its rows in the system already have the values of the assembly.
  std::vector<char> known_rows(const Assembly& assembly) const;
  void build_pattern(const Assembly& assembly);
  void mark_balances(const Assembly& assembly);
  void apply_fixed(const Assembly& assembly);

  std::vector<const Field*> unknowns_;
  std::vector<int> first_;
  std::vector<int> first_row_;  ///< of each unknown: place of its first owned row in the system; last, their number
  int size_ = 0;
  std::vector<std::vector<char>> owned_;  ///< [unknown][row of the field]
  LinearSystem system_;
  BalanceSums sums_;
  std::vector<int> destinations_;                ///< of every kept entry of every block, in order
  std::vector<std::size_t> first_destinations_;  ///< by block
  std::vector<Known> known_;
  std::vector<std::pair<int, double>> fixed_;  ///< unknowns and scales
  int patterns_built_ = 0;
};

}  // namespace sprekk
