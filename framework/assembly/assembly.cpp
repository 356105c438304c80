#include "framework/assembly/assembly.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "framework/invariants.hpp"

namespace sprekk {

Assembly::Assembly(std::vector<const Field*> unknowns, Request request, Products* products)
    : unknowns_(std::move(unknowns)),
      request_(request),
      products_(products != nullptr ? products : &own_products_),
      balances_(unknowns_.size()) {
  for (const Field* field : unknowns_) {
    SPREKK_EXPECT(field != nullptr);
    SPREKK_EXPECT(index_.count(field) == 0, field->name());
    SPREKK_EXPECT(field->now().size() == field->size(), field->name(), field->now().size(), field->size());
    index_[field] = static_cast<int>(residuals_.size());

    residuals_.push_back(Vector::Zero(field->size()));
  }
  magnitudes_.assign(unknowns_.size(), 0);
  round_off_bases_.assign(unknowns_.size(), 0);
}

int Assembly::index_of(const Field& row) const {
  const auto found = index_.find(&row);
  return found == index_.end() ? -1 : found->second;
}

void Assembly::add(const Field& row, const Vector& values) {
  if (const int i = index_of(row); i >= 0) add(i, values, values);
}

void Assembly::add(int i, const Vector& values, const Vector& in_sum) {
  SPREKK_EXPECT(is_index(i, static_cast<long>(unknowns_.size())), i, unknowns_.size());
  if (values.size() != residuals_[i].size() || in_sum.size() != values.size())
    throw std::logic_error("assembly of " + unknowns_[i]->name() + ": wrong size");
  if (values.size() == 0) return;
  residuals_[i] += values;
  const double largest = values.lpNorm<Eigen::Infinity>();
  magnitudes_[i] = std::max(magnitudes_[i], largest);
  round_off_bases_[i] = std::max(round_off_bases_[i], largest);
  balances_.add(i, in_sum);
}

void Assembly::compare_with(const Field& row, double magnitude) {
  SPREKK_EXPECT(!(magnitude < 0), row.name(), magnitude);
  const auto found = index_.find(&row);
  if (found == index_.end()) return;
  magnitudes_[found->second] = std::max(magnitudes_[found->second], magnitude);
  round_off_bases_[found->second] = std::max(round_off_bases_[found->second], magnitude);
}

void Assembly::compare_round_off(const Field& row, double largest) {
  SPREKK_EXPECT(!(largest < 0), row.name(), largest);
  const int i = index_of(row);
  if (i < 0) return;
  compare_round_off_of_rows(i, largest);
  balances_.compare_round_off(i, row.size() * largest);
}

void Assembly::compare_round_off_of_rows(int unknown, double largest) {
  round_off_bases_[unknown] = std::max(round_off_bases_[unknown], largest);
}

void Assembly::fix(const Field& row, int i, double target, double scale) {
  SPREKK_EXPECT(is_index(i, row.size()), row.name(), i, row.size());
  SPREKK_EXPECT(std::isfinite(target), row.name(), i, target);
  SPREKK_EXPECT(std::isfinite(scale) && scale != 0, row.name(), i, scale);
  const auto found = index_.find(&row);
  if (found == index_.end()) return;
  const double value = row.now()[i], size = std::max(std::abs(value), std::abs(target));
  residuals_[found->second][i] = scale * (value - target);
  fixed_.push_back({found->second, i, scale, size > 0 ? std::abs(value - target) / size : 0});
}

void Assembly::keep_block(const Field& row, const Field& column, const SparseMatrix& block, double factor,
                          const Vector* weights, const Operator* kept) {
  if (!wants_derivatives()) return;
  const auto i = index_.find(&row), j = index_.find(&column);
  SPREKK_EXPECT(block.isCompressed(), row.name(), column.name());
  SPREKK_EXPECT(weights == nullptr || weights->size() == row.size(), row.name(), row.size());
  SPREKK_EXPECT(std::isfinite(factor), row.name(), column.name(), factor);
  SPREKK_ASSERT(is_well_formed(block), row.name(), column.name());
  if (i == index_.end() || j == index_.end()) return;
  if (block.rows() != row.size() || block.cols() != column.size())
    throw std::logic_error("derivative of " + row.name() + " by " + column.name() + ": wrong shape");
  blocks_.push_back({i->second, j->second, &block, factor, weights, kept ? kept->number() : 0,
                     kept ? &kept->leaving() : &block, kept ? kept->largest_exchange() : 0});
}

void Assembly::derivative(const Field& row, const Field& column, const SparseMatrix& block, double factor,
                          const Vector* weights) {
  keep_block(row, column, block, factor, weights, nullptr);
}

void Assembly::derivative(const Field& row, const Field& column, const Operator& block, double factor,
                          const Vector* weights) {
  keep_block(row, column, block.entries(), factor, weights, &block);
}

void Assembly::derivative(const Field& row, const Field& column, SparseMatrix&& block) {
  if (!wants_derivatives()) return;
  owned_.push_back(std::move(block));
  keep_block(row, column, owned_.back(), 1, nullptr, nullptr);
}

void Assembly::exchange_derivative(const Field& row, const Field& column, SparseMatrix&& block) {
  if (!wants_derivatives()) return;
  const std::size_t before = blocks_.size();
  derivative(row, column, std::move(block));
  if (blocks_.size() == before) return;
  Block& kept = blocks_.back();
  owned_.emplace_back(kept.matrix->rows(), kept.matrix->cols());
  kept.in_sum = &owned_.back();
  for (int k = 0; k < kept.matrix->nonZeros(); ++k)
    kept.largest_exchange = std::max(kept.largest_exchange, std::abs(kept.matrix->valuePtr()[k]));
}

void Assembly::diagonal(const Field& row, const Field& column, const Vector& entries) {
  if (!wants_derivatives() || !has_row(row) || !has_row(column)) return;
  if (column.size() != entries.size())
    throw std::logic_error("derivative of " + row.name() + " by " + column.name() + ": wrong shape");
  derivative(row, column, diagonal_matrix(entries));
}

void Assembly::linear(const Field& row, const Operator& matrix, const Field& column, double factor,
                      const Vector* weights) {
  const auto found = index_.find(&row);
  if (found == index_.end()) return;
  if (matrix.entries().rows() != row.size() || matrix.entries().cols() != column.size())
    throw std::logic_error("term of " + row.name() + " in " + column.name() + ": wrong shape");
  const int i = found->second;
  const FieldProduct& product = products_->now(matrix, column);
  SPREKK_EXPECT(weights == nullptr || weights->size() == row.size(), row.name(), row.size());
  SPREKK_ASSERT(product.value.size() == row.size() && product.size.size() == row.size(), row.name(), row.size());
  const bool is_balance = balances_.are_rows_of(i);
  Vector scaled(is_balance ? row.size() : 0);
  double largest = 0, largest_absolute = 0, sum_of_absolute = 0;
  for (int r = 0; r < row.size(); ++r) {
    const double scale = weights ? factor * (*weights)[r] : factor;
    const double value = scale * product.value[r];
    residuals_[i][r] += value;
    largest = std::max(largest, std::abs(value));
    const double absolute = std::abs(scale) * product.size[r];
    largest_absolute = std::max(largest_absolute, absolute);
    sum_of_absolute += absolute;
    if (is_balance) scaled[r] = matrix.is_exchange() ? scale : value;
  }
  if (is_balance) {
    if (matrix.is_exchange())
      scaled = scaled.cwiseProduct(matrix.leaving() * column.now()).eval();
    else
      balances_.compare_round_off(i, sum_of_absolute);
    balances_.add(i, scaled);
  }
  magnitudes_[i] = std::max(magnitudes_[i], largest);
  round_off_bases_[i] = std::max(round_off_bases_[i], largest_absolute);
  derivative(row, column, matrix, factor, weights);
}

void Assembly::linear(const Field& row, const LinearExpression& expression, double factor, const Vector* weights) {
  SPREKK_EXPECT(expression.constant.size() == row.size(), row.name(), expression.constant.size(), row.size());
  SPREKK_EXPECT(weights == nullptr || weights->size() == row.size(), row.name(), row.size());
  if (!has_row(row)) return;
  Vector constant = factor * expression.constant;
  if (weights) constant = constant.cwiseProduct(*weights);
  add(row, constant);
  for (const LinearExpression::Term& term : expression.terms) linear(row, term.matrix, *term.field, factor, weights);
}

}  // namespace sprekk
