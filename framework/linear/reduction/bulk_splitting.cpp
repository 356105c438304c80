#include "framework/linear/reduction/bulk_splitting.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>

#include "framework/invariants.hpp"

namespace sprekk {
namespace {

LinearSystem system_of(SparseMatrix matrix, std::vector<UnknownBlock> blocks) {
  LinearSystem system;
  system.rows.resize(matrix.rows());
  std::iota(system.rows.begin(), system.rows.end(), 0);
  system.local = std::move(matrix);
  system.blocks = std::move(blocks);
  return system;
}

/// Adds A x, and |A| |x| to the sizes of the terms.
void multiply(const SparseMatrix& a, const Vector& x, Vector& product, Vector& size) {
  SPREKK_EXPECT(x.size() == a.cols(), x.size(), a.cols());
  SPREKK_EXPECT(product.size() == a.rows() && size.size() == a.rows(), product.size(), size.size(), a.rows());
  for (int row = 0; row < a.rows(); ++row)
    for (SparseMatrix::InnerIterator entry(a, row); entry; ++entry) {
      const double term = entry.value() * x[entry.col()];
      product[row] += term;
      size[row] += std::abs(term);
    }
}

/// Lower bounds of the sizes of the terms in the rows of `a`. Each unknown counts with at least a small part of what
/// the terms of its own row allow: a jump that is zero is a difference of displacements that are not, and its round-off
/// is no error.
Vector least_sizes(const SparseMatrix& a, const Vector& size) {
  constexpr double small = 1e-4;
  Vector determined = Vector::Zero(a.cols()), least = Vector::Zero(a.rows());
  for (int row = 0; row < a.rows(); ++row) {
    double largest = 0;
    for (SparseMatrix::InnerIterator entry(a, row); entry; ++entry)
      largest = std::max(largest, std::abs(entry.value()));
    if (largest > 0 && std::abs(a.coeff(row, row)) == largest) determined[row] = size[row] / largest;
  }
  for (int row = 0; row < a.rows(); ++row)
    for (SparseMatrix::InnerIterator entry(a, row); entry; ++entry)
      least[row] += small * std::abs(entry.value()) * determined[entry.col()];
  return least;
}

/// The entities of a block whose unknowns are of one kind, as a block of its own.
UnknownBlock chosen_entities(const UnknownBlock& block, const std::vector<char>& is_local, bool local,
                             const std::vector<int>& place) {
  UnknownBlock chosen = block;
  std::vector<int> entities;
  for (int entity = 0; entity < block.entities; ++entity) {
    const int unknown = block.first + entity * block.components;
    if (static_cast<bool>(is_local[unknown]) != local) continue;
    if (entities.empty()) chosen.first = place[unknown];
    entities.push_back(entity);
  }
  chosen.entities = static_cast<int>(entities.size());
  if (block.has_coordinates()) chosen.coordinates = block.coordinates(Eigen::all, entities);
  return chosen;
}

double largest_by_block(const std::vector<UnknownBlock>& blocks, const Vector& residual, const Vector& size) {
  double largest = 0;
  for (const UnknownBlock& block : blocks) {
    const int count = block.entities * block.components;
    if (count == 0) continue;
    const double error = residual.segment(block.first, count).lpNorm<Eigen::Infinity>();
    if (error > 0) largest = std::max(largest, error / size.segment(block.first, count).maxCoeff());
  }
  return largest;
}

}  // namespace

bool take_values(SparseMatrix& matrix, const double* values, const std::vector<int>& source) {
  SPREKK_EXPECT(static_cast<Eigen::Index>(source.size()) == matrix.nonZeros(), source.size(), matrix.nonZeros());
  bool has_changed = false;
  double* mine = matrix.valuePtr();
  for (std::size_t k = 0; k < source.size(); ++k) {
    const double value = values[source[k]];
    has_changed |= std::memcmp(&value, &mine[k], sizeof value) != 0;
    mine[k] = value;
  }
  return has_changed;
}

BulkSplitting::BulkSplitting(const LinearSystem& system, std::vector<char> held)
    : outer_(system.local.outerIndexPtr(), system.local.outerIndexPtr() + system.local.rows() + 1),
      inner_(system.local.innerIndexPtr(), system.local.innerIndexPtr() + system.local.nonZeros()),
      held_(std::move(held)),
      is_local_(system.local.cols(), 1),
      place_(system.local.cols(), 0) {
  SPREKK_EXPECT(system.local.rows() == system.local.cols(), system.local.rows(), system.local.cols());
  SPREKK_EXPECT(system.local.isCompressed());
  SPREKK_EXPECT(held_.empty() || held_.size() == is_local_.size(), held_.size(), is_local_.size());
  for (UnknownBlock block : system.blocks) {
    block.stabilization.resize(0);
    blocks_.push_back(block);
    if (block.kind != BlockKind::interface)
      std::fill_n(is_local_.begin() + block.first, block.entities * block.components, 0);
  }
  for (std::size_t i = 0; i < held_.size(); ++i) is_local_[i] |= held_[i];
  int bulk = 0, local = 0;
  for (std::size_t i = 0; i < place_.size(); ++i) place_[i] = is_local_[i] ? local++ : bulk++;
  if (std::ranges::count(held_, 1) > 0) is_held_local_.assign(local, 0);
  for (std::size_t i = 0; i < held_.size(); ++i)
    if (held_[i]) is_held_local_[place_[i]] = 1;
  for (const UnknownBlock& block : blocks_)
    for (const bool is_local : {false, true}) {
      UnknownBlock chosen = chosen_entities(block, is_local_, is_local, place_);
      if (chosen.entities > 0) (is_local ? local_blocks_ : bulk_blocks_).push_back(std::move(chosen));
    }
  bb = extract(system.local, false, false);
  bf = extract(system.local, false, true);
  fb = extract(system.local, true, false);
  ff = extract(system.local, true, true);
  SPREKK_ASSERT(bb.matrix.nonZeros() + bf.matrix.nonZeros() + fb.matrix.nonZeros() + ff.matrix.nonZeros() ==
                system.local.nonZeros());
  SPREKK_ASSERT(is_well_formed(bb.matrix) && is_well_formed(ff.matrix), bulk, local);

  std::vector<char> is_interface(local, 0);
  for (int k = 0; k < bf.matrix.nonZeros(); ++k) is_interface[bf.matrix.innerIndexPtr()[k]] = 1;
  for (int i = 0; i < local; ++i)
    if (is_interface[i]) interface_columns.push_back(i);
  for (int i = 0; i < local; ++i)
    if (fb.has_row(i)) interface_rows.push_back(i);
  near_place.assign(bulk, -1);
  for (int k = 0; k < fb.matrix.nonZeros(); ++k) near_place[fb.matrix.innerIndexPtr()[k]] = 0;
  for (int i = 0; i < bulk; ++i) {
    if (near_place[i] < 0) continue;
    near_place[i] = static_cast<int>(near.size());
    near.push_back(i);
  }
}

SubMatrix BulkSplitting::extract(const SparseMatrix& matrix, bool local_rows, bool local_columns) const {
  SubMatrix sub;
  std::vector<int> starts{0}, columns;
  for (int row = 0; row < matrix.rows(); ++row) {
    if (static_cast<bool>(is_local_[row]) != local_rows) continue;
    for (int k = matrix.outerIndexPtr()[row]; k < matrix.outerIndexPtr()[row + 1]; ++k) {
      const int column = matrix.innerIndexPtr()[k];
      if (static_cast<bool>(is_local_[column]) != local_columns) continue;
      columns.push_back(place_[column]);
      sub.source.push_back(k);
    }
    starts.push_back(static_cast<int>(columns.size()));
  }
  const auto width = std::count(is_local_.begin(), is_local_.end(), static_cast<char>(local_columns));
  sub.matrix.resize(static_cast<int>(starts.size()) - 1, static_cast<int>(width));
  sub.matrix.resizeNonZeros(columns.size());
  std::copy(starts.begin(), starts.end(), sub.matrix.outerIndexPtr());
  std::copy(columns.begin(), columns.end(), sub.matrix.innerIndexPtr());
  std::fill_n(sub.matrix.valuePtr(), columns.size(), std::nan(""));  // the first update is a change
  return sub;
}

bool BulkSplitting::fits(const SparseMatrix& matrix) const {
  return static_cast<int>(inner_.size()) == matrix.nonZeros() && static_cast<int>(outer_.size()) == matrix.rows() + 1 &&
         std::equal(outer_.begin(), outer_.end(), matrix.outerIndexPtr()) &&
         std::equal(inner_.begin(), inner_.end(), matrix.innerIndexPtr());
}

bool BulkSplitting::update(const SparseMatrix& matrix) {
  SPREKK_EXPECT(fits(matrix));
  const double* values = matrix.valuePtr();
  const bool has_changed = bb.update(values) | bf.update(values);
  fb.update(values);
  ff.update(values);
  return has_changed;
}

Vector BulkSplitting::part(const Vector& whole, bool local, int size) const {
  SPREKK_EXPECT(whole.size() == static_cast<Eigen::Index>(is_local_.size()), whole.size(), is_local_.size());
  Vector mine(size);
  for (std::size_t i = 0; i < is_local_.size(); ++i)
    if (static_cast<bool>(is_local_[i]) == local) mine[place_[i]] = whole[i];
  return mine;
}

Vector BulkSplitting::joined(const Vector& bulk, const Vector& local) const {
  SPREKK_EXPECT(bulk.size() == bulk_size() && local.size() == local_size(), bulk.size(), local.size());
  Vector whole(is_local_.size());
  for (std::size_t i = 0; i < is_local_.size(); ++i) whole[i] = is_local_[i] ? local[place_[i]] : bulk[place_[i]];
  return whole;
}

LinearSystem BulkSplitting::bulk_system() const {
  SPREKK_ASSERT(are_indices(sums_, static_cast<long>(place_.size())), place_.size());
  LinearSystem system = system_of(bb.matrix, bulk_blocks_);
  for (const int sum : sums_)
    if (!is_local_[sum]) system.sums.push_back(place_[sum]);
  return system;
}

LinearSystem BulkSplitting::local_system(SparseMatrix matrix) const {
  SPREKK_EXPECT(matrix.rows() == local_size() && matrix.cols() == local_size(), matrix.rows(), matrix.cols());
  LinearSystem system = system_of(std::move(matrix), local_blocks_);
  for (const int sum : sums_)
    if (is_local_[sum]) system.sums.push_back(place_[sum]);
  return system;
}

LinearSystem BulkSplitting::whole_system() const {
  const int size = static_cast<int>(is_local_.size());
  SparseMatrix matrix(size, size);
  matrix.resizeNonZeros(inner_.size());
  std::copy(outer_.begin(), outer_.end(), matrix.outerIndexPtr());
  std::copy(inner_.begin(), inner_.end(), matrix.innerIndexPtr());
  for (const SubMatrix* sub : {&bb, &bf, &fb, &ff})
    for (std::size_t k = 0; k < sub->source.size(); ++k) matrix.valuePtr()[sub->source[k]] = sub->matrix.valuePtr()[k];
  LinearSystem system = system_of(std::move(matrix), blocks_);
  system.sums = sums_;
  return system;
}

double BulkSplitting::backward_error(const Vector& bulk, const Vector& local, const Vector& b_bulk,
                                     const Vector& b_local) const {
  if (!std::isfinite(bulk.sum() + local.sum())) return HUGE_VAL;
  SPREKK_EXPECT(b_bulk.size() == bulk_size() && b_local.size() == local_size(), b_bulk.size(), b_local.size());
  Vector product = Vector::Zero(bulk_size()), size = b_bulk.cwiseAbs();
  multiply(bb.matrix, bulk, product, size);
  multiply(bf.matrix, local, product, size);
  const double of_bulk = largest_by_block(bulk_blocks_, b_bulk - product, size);
  product = Vector::Zero(local_size());
  size = b_local.cwiseAbs();
  multiply(fb.matrix, bulk, product, size);
  multiply(ff.matrix, local, product, size);
  size = size.cwiseMax(least_sizes(ff.matrix, size));
  return std::max(of_bulk, largest_by_block(local_blocks_, b_local - product, size));
}

}  // namespace sprekk
