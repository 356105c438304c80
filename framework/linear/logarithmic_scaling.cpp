#include "framework/linear/logarithmic_scaling.hpp"

#include <cmath>

#include "framework/invariants.hpp"
#include "framework/parallel/parallel.hpp"

namespace sprekk {
namespace {

/// Calls use(row, column, |value|) for the entries that are not zero.
template <class Use>
void for_entries(const SparseMatrix& a, const Use& use) {
  for (int row = 0; row < a.rows(); ++row)
    for (SparseMatrix::InnerIterator entry(a, row); entry; ++entry)
      if (entry.value() != 0) use(row, static_cast<int>(entry.col()), std::abs(entry.value()));
}

double power_of_two(double exponent) { return std::exp2(std::round(exponent)); }

/// Logarithms of the scales of rows and of columns.
struct Exponents {
  Vector row, column;
};

Exponents least_squares(const SparseMatrix& a) {
  constexpr int sweeps = 30;
  Exponents scale{Vector::Zero(a.rows()), Vector::Zero(a.cols())};
  Vector in_row = scale.row, in_column = scale.column;  // numbers of entries
  for_entries(a, [&](int i, int j, double) {
    in_row[i] += 1;
    in_column[j] += 1;
  });
  parallel::sum(in_column);
  SPREKK_EXPECT(a.rows() == 0 || (in_row.minCoeff() > 0 && in_column.minCoeff() > 0), a.rows(), a.cols());
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    Vector sums = Vector::Zero(a.rows());
    for_entries(a, [&](int i, int j, double size) { sums[i] += std::log2(size) + scale.column[j]; });
    scale.row = -sums.cwiseQuotient(in_row);
    sums = Vector::Zero(a.cols());
    for_entries(a, [&](int i, int j, double size) { sums[j] += std::log2(size) + scale.row[i]; });
    parallel::sum(sums);
    scale.column = -sums.cwiseQuotient(in_column);
  }
  return scale;
}

}  // namespace

void rescale_by_logarithms(Equilibrated& scaled) {
  SparseMatrix& a = scaled.matrix;
  SPREKK_EXPECT(scaled.mistake.empty(), scaled.mistake);
  Exponents scale = least_squares(a);
  constexpr double none = -1e4;  // below the exponent of any double
  Vector largest = Vector::Constant(a.rows(), none);
  for_entries(a,
              [&](int i, int j, double size) { largest[i] = std::max(largest[i], std::log2(size) + scale.column[j]); });
  scale.row = -largest;
  largest = Vector::Constant(a.cols(), none);
  for_entries(a, [&](int i, int j, double size) { largest[j] = std::max(largest[j], std::log2(size) + scale.row[i]); });
  parallel::max(largest);
  const Vector row = scale.row.unaryExpr(&power_of_two), column = (-largest).unaryExpr(&power_of_two);
  a = row.asDiagonal() * a * column.asDiagonal();
  a.makeCompressed();
  scaled.row_scale.array() *= row.array();
  scaled.column_scale.array() *= column.array();
}

}  // namespace sprekk
