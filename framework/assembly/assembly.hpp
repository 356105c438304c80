// The equations of one simultaneous solve: each term is written once, and the unknowns of the solve choose which rows
// and which derivative blocks are kept. A term whose other field is not an unknown here uses that field's latest value.
#pragma once

#include <deque>
#include <map>
#include <string>
#include <vector>

#include "framework/assembly/balances.hpp"
#include "framework/assembly/linear_expression.hpp"
#include "framework/assembly/products.hpp"
#include "framework/field/field.hpp"
#include "framework/types.hpp"

namespace sprekk {

/// The residual and, if wanted, the blocks of the Jacobian of the equations of the given unknowns, in the units that
/// the parts give their terms. Vectors have one entry a value of the row's field.
class Assembly {
 public:
  /// Whether the blocks of the Jacobian are kept, or the residual alone.
  enum class Request { residual, residual_and_derivatives };

  /// The equation that determines a field is named after the field: row i of the equation is that of value i of the
  /// field. `products`: matrix-vector products that are kept from one assembly to the next; without it, products live
  /// as long as this assembly.
  Assembly(std::vector<const Field*> unknowns, Request request, Products* products = nullptr);

  bool has_row(const Field& row) const { return index_.count(&row) > 0; }
  bool wants_derivatives() const { return request_ == Request::residual_and_derivatives; }

  /// residual(row) += values.
  void add(const Field& row, const Vector& values);
  /// Adds another magnitude that the residual is compared with, in the units of the equation.
  void compare_with(const Field& row, double magnitude);
  /// Adds a bound of the numbers whose differences make up the residual: these numbers leave round-off of their own
  /// size in the residual.
  void compare_round_off(const Field& row, double largest);
  /// d residual(row) / d column += factor · diag(weights) · block; ignored unless both are unknowns here. `block` and
  /// `weights` must outlive the assembly.
  void derivative(const Field& row, const Field& column, const SparseMatrix& block, double factor = 1,
                  const Vector* weights = nullptr);
  void derivative(const Field& row, const Field& column, SparseMatrix&& block);
  /// A block that is an Operator need not be copied again into the system of the next assembly.
  void derivative(const Field& row, const Field& column, const Operator& block, double factor = 1,
                  const Vector* weights = nullptr);
  void derivative(const Field&, const Field&, Operator&&, double = 1, const Vector* = nullptr) = delete;
  /// A block of this assembly alone that is an exchange: the sum over all rows is zero in each column.
  void exchange_derivative(const Field& row, const Field& column, SparseMatrix&& block);
  /// d residual(row) / d column += a diagonal block with these entries.
  void diagonal(const Field& row, const Field& column, const Vector& entries);

  /// residual(row) += factor · diag(weights) · (matrix · column), with its derivative.
  void linear(const Field& row, const Operator& matrix, const Field& column, double factor = 1,
              const Vector* weights = nullptr);
  void linear(const Field&, Operator&&, const Field&, double = 1, const Vector* = nullptr) = delete;
  /// residual(row) += factor · diag(weights) · expression, with its derivatives.
  void linear(const Field& row, const LinearExpression& expression, double factor = 1, const Vector* weights = nullptr);

  /// The product of matrix and column, for terms that a part puts together itself. Terms of exchanges are then added
  /// with BalanceRows::exchange.
  const Vector& product(const Operator& matrix, const Field& column) { return products_->value_now(matrix, column); }

  /// Replaces row i of the equation by scale · (value − target) = 0, whatever other terms it has. `scale` brings it to
  /// the units of the equation. To be called after all terms: by Part::constrain.
  void fix(const Field& row, int i, double target, double scale);

  /// A row that `fix` has replaced.
  struct Fixed {
    int unknown, row;
    double scale;
    double error;  ///< |value − target| over the larger of the two; such rows are judged by this alone
  };
  const std::vector<Fixed>& fixed() const { return fixed_; }

  /// A term of the Jacobian: factor · diag(weights) · matrix, added to the derivative of one equation by one unknown.
  struct Block {
    int row, column;  ///< indices into unknowns()
    const SparseMatrix* matrix;
    double factor;
    const Vector* weights;
    std::uint64_t number;        ///< number of the operator, or 0 for entries that may differ in the next assembly
    const SparseMatrix* in_sum;  ///< the matrix that takes the place of `matrix` in a sum of rows
    double largest_exchange;     ///< largest absolute entry of an exchange, 0 if it is none
  };
  const std::vector<const Field*>& unknowns() const { return unknowns_; }
  const Vector& residual(int unknown) const { return residuals_[unknown]; }
  /// The largest entry of any single term of the equation, with which its residual is compared.
  double magnitude(int unknown) const { return magnitudes_[unknown]; }
  /// The largest sum of absolute products in a row: round-off is a small multiple of machine epsilon times this.
  double round_off_base(int unknown) const { return round_off_bases_[unknown]; }
  const std::vector<Block>& blocks() const { return blocks_; }
  /// The balances that parts have declared.
  const Balances& balances() const { return balances_; }

 private:
  friend class BalanceRows;
  int index_of(const Field& row) const;  ///< -1 where it is not in the solve
  /// `in_sum`: the values that count in a sum of rows.
  void add(int unknown, const Vector& values, const Vector& in_sum);
  void compare_round_off_of_rows(int unknown, double largest);
  void keep_block(const Field& row, const Field& column, const SparseMatrix& block, double factor,
                  const Vector* weights, const Operator* kept);

  std::vector<const Field*> unknowns_;
  Request request_;
  Products own_products_;
  Products* products_;
  std::map<const Field*, int> index_;
  std::vector<Vector> residuals_;
  std::vector<double> magnitudes_, round_off_bases_;
  Balances balances_;
  std::vector<Block> blocks_;
  std::vector<Fixed> fixed_;
  std::deque<SparseMatrix> owned_;  ///< blocks that were moved in
};

}  // namespace sprekk
