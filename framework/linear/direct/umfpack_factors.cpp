#include "framework/linear/direct/umfpack_factors.hpp"

#include <umfpack.h>

#include <algorithm>

#include "framework/invariants.hpp"

namespace sprekk {
namespace {

constexpr int width = 16;  // columns at a time: two cache lines a row

using Row = Eigen::Map<Eigen::Array<double, width, 1>>;

}  // namespace

// P A^T Q = L U with L by rows and U by columns, so A = Q U^T L^T P: U^T is solved forwards and L^T backwards, each
// along its order in memory.
UmfpackFactors::UmfpackFactors(void* numeric, int n) : n_(n) {
  SPREKK_EXPECT(numeric != nullptr && n > 0, n);
  int lower = 0, upper = 0, rows = 0, columns = 0, diagonal = 0;
  umfpack_di_get_lunz(&lower, &upper, &rows, &columns, &diagonal, numeric);
  lower_start_.resize(n + 1);
  lower_column_.resize(lower);
  lower_values_.resize(lower);
  upper_start_.resize(n + 1);
  upper_row_.resize(upper);
  upper_values_.resize(upper);
  row_order_.resize(n);
  column_order_.resize(n);
  inverse_diagonal_.resize(n);
  int is_reciprocal = 0;
  umfpack_di_get_numeric(lower_start_.data(), lower_column_.data(), lower_values_.data(), upper_start_.data(),
                         upper_row_.data(), upper_values_.data(), row_order_.data(), column_order_.data(),
                         inverse_diagonal_.data(), &is_reciprocal, nullptr, numeric);
  SPREKK_ASSERT(is_reciprocal == 0, is_reciprocal);
  SPREKK_ASSERT(are_indices(row_order_, n) && are_indices(column_order_, n), n);
  for (double& d : inverse_diagonal_) d = 1 / d;
}

void UmfpackFactors::solve(Eigen::Ref<Eigen::MatrixXd> columns) const {
  SPREKK_EXPECT(columns.rows() == n_, columns.rows(), n_);
  std::vector<double> work(static_cast<std::size_t>(n_) * width);
  std::vector<char> is_zero(n_);
  const auto row = [&](int i) { return Row(work.data() + static_cast<std::size_t>(i) * width); };
  for (int first = 0; first < columns.cols(); first += width) {
    const int count = std::min<int>(width, columns.cols() - first);
    for (int k = 0; k < n_; ++k) {
      Row y = row(k);
      y.setZero();
      is_zero[k] = 1;
      for (int c = 0; c < count; ++c) {
        y[c] = columns(column_order_[k], first + c);
        if (y[c] != 0) is_zero[k] = 0;
      }
    }
    for (int k = 0; k < n_; ++k) {
      Eigen::Array<double, width, 1> sum = row(k);
      bool stays_zero = is_zero[k];
      for (int e = upper_start_[k]; e < upper_start_[k + 1]; ++e) {
        const int i = upper_row_[e];
        if (i == k || is_zero[i]) continue;
        sum -= upper_values_[e] * row(i);
        stays_zero = false;
      }
      is_zero[k] = stays_zero;
      row(k) = sum * inverse_diagonal_[k];
    }
    for (int k = n_ - 1; k >= 0; --k) {
      const Eigen::Array<double, width, 1> solved = row(k);
      if ((solved == 0).all()) continue;
      for (int e = lower_start_[k]; e < lower_start_[k + 1]; ++e) {
        const int i = lower_column_[e];
        if (i != k) row(i) -= lower_values_[e] * solved;
      }
    }
    for (int k = 0; k < n_; ++k)
      for (int c = 0; c < count; ++c) columns(row_order_[k], first + c) = row(k)[c];
  }
}

}  // namespace sprekk
