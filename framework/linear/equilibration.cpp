#include "framework/linear/equilibration.hpp"

#include <cmath>

#include "framework/invariants.hpp"
#include "framework/linear/unknown_names.hpp"
#include "framework/parallel/parallel.hpp"

namespace sprekk {
namespace {

// The power of two nearest (in the exponent) to 1 / sqrt(value).
double half_inverse(double value) {
  SPREKK_EXPECT(value > 0 && std::isfinite(value), value);
  int exponent = 0;
  std::frexp(value, &exponent);  // value = m 2^exponent, 1/2 <= m < 1
  return std::ldexp(1.0, -(exponent >= 0 ? exponent / 2 : -((-exponent) / 2)));
}

bool is_near_one(const Vector& largest) {
  constexpr double low = 0.25, high = 4;  // scaling by powers of two cannot come closer to 1
  return largest.size() == 0 || (largest.minCoeff() >= low && largest.maxCoeff() <= high);
}

// The smallest number over all processes that is not -1, or -1.
int first_over_processes(int mine) {
  const double smallest = -parallel::max(mine < 0 ? -HUGE_VAL : -static_cast<double>(mine));
  return std::isinf(smallest) ? -1 : static_cast<int>(smallest);
}

struct Largest {
  Vector of_row, of_column;
};

/// The largest entries of the rows and columns of |A|, scaled by rows and columns.
Largest largest_entries(const SparseMatrix& a, const Vector& row_scale, const Vector& column_scale) {
  SPREKK_EXPECT(row_scale.size() == a.rows() && column_scale.size() == a.cols(), row_scale.size(), column_scale.size());
  Largest largest{Vector::Zero(a.rows()), Vector::Zero(a.cols())};
  const int* const outer = a.outerIndexPtr();
  const int* const inner = a.innerIndexPtr();
  const double* const values = a.valuePtr();
  for (int row = 0; row < a.rows(); ++row) {
    const double scale = row_scale[row];
    double of_row = 0;
    for (int k = outer[row]; k < outer[row + 1]; ++k) {
      const int column = inner[k];
      const double size = std::abs(values[k]) * scale * column_scale[column];
      of_row = size > of_row ? size : of_row;
      double& of_column = largest.of_column[column];
      of_column = size > of_column ? size : of_column;
    }
    largest.of_row[row] = of_row;
  }
  parallel::max(largest.of_column);
  return largest;
}

std::string find_mistake(const LinearSystem& system, const SparseMatrix& a, const Largest& largest) {
  int not_a_number = -1, empty_row = -1, empty_column = -1;
  for (int row = 0; row < a.rows() && not_a_number < 0; ++row)
    for (SparseMatrix::InnerIterator entry(a, row); entry; ++entry)
      if (!std::isfinite(entry.value())) not_a_number = system.rows[row];
  for (int row = static_cast<int>(a.rows()) - 1; row >= 0; --row)
    if (largest.of_row[row] == 0) empty_row = system.rows[row];
  for (int column = static_cast<int>(a.cols()) - 1; column >= 0; --column)
    if (largest.of_column[column] == 0) empty_column = column;
  not_a_number = first_over_processes(not_a_number);
  empty_row = first_over_processes(empty_row);
  empty_column = first_over_processes(empty_column);
  if (not_a_number >= 0)
    return "the matrix has an entry that is not a finite number (row of " +
           describe_unknown(system.blocks, not_a_number) + ")";
  if (empty_row >= 0)
    return "the matrix is singular (the row of " + describe_unknown(system.blocks, empty_row) + " is zero)";
  if (empty_column >= 0)
    return "the matrix is singular (nothing determines " + describe_unknown(system.blocks, empty_column) +
           ": its column is zero)";
  return "";
}

}  // namespace

Equilibrated equilibrate(const LinearSystem& system) {
  SPREKK_EXPECT(static_cast<int>(system.rows.size()) == system.local.rows(), system.rows.size(), system.local.rows());
  Equilibrated result;
  result.matrix = system.local;
  SparseMatrix& a = result.matrix;
  a.makeCompressed();
  result.row_scale = Vector::Ones(a.rows());
  result.column_scale = Vector::Ones(a.cols());

  SPREKK_ASSERT(is_well_formed(a), a.rows(), a.cols());
  Largest largest = largest_entries(a, result.row_scale, result.column_scale);
  result.mistake = find_mistake(system, a, largest);
  if (!result.mistake.empty()) return result;

  // A sweep halves the spread of the exponents: 20 sweeps are enough for any double.
  constexpr int most_sweeps = 20;
  for (int sweep = 0; sweep < most_sweeps; ++sweep) {
    if (!parallel::any(!is_near_one(largest.of_row) || !is_near_one(largest.of_column))) break;
    result.row_scale.array() *= largest.of_row.unaryExpr(&half_inverse).array();
    result.column_scale.array() *= largest.of_column.unaryExpr(&half_inverse).array();
    largest = largest_entries(a, result.row_scale, result.column_scale);
  }
  for (int row = 0; row < a.rows(); ++row)
    for (int k = a.outerIndexPtr()[row]; k < a.outerIndexPtr()[row + 1]; ++k)
      a.valuePtr()[k] = a.valuePtr()[k] * result.row_scale[row] * result.column_scale[a.innerIndexPtr()[k]];
  result.norm = std::sqrt(parallel::sum(Eigen::Map<const Vector>(a.valuePtr(), a.nonZeros()).squaredNorm()));
  return result;
}

}  // namespace sprekk
