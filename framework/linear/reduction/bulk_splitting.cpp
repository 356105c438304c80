#include "framework/linear/reduction/bulk_splitting.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "framework/invariants.hpp"
#include "framework/parallel/parallel.hpp"

namespace sprekk {
namespace {

LinearSystem system_of(std::vector<int> rows, SparseMatrix matrix, std::vector<UnknownBlock> blocks) {
  LinearSystem system;
  system.rows = std::move(rows);
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
  constexpr double small = 1e-4;  // of what the terms of its row allow: smaller unknowns are zero
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

/// `rows`: the unknowns of the residuals, ascending. Collective.
double largest_by_block(const std::vector<UnknownBlock>& blocks, const std::vector<int>& rows, const Vector& residual,
                        const Vector& size) {
  Vector errors = Vector::Zero(static_cast<Eigen::Index>(blocks.size())), scales = errors;
  for (std::size_t k = 0; k < blocks.size(); ++k) {
    const UnknownBlock& block = blocks[k];
    const auto begin = std::ranges::lower_bound(rows, block.first);
    const auto count = std::ranges::lower_bound(rows, block.first + block.entities * block.components) - begin;
    if (count == 0) continue;
    errors[k] = residual.segment(begin - rows.begin(), count).lpNorm<Eigen::Infinity>();
    scales[k] = size.segment(begin - rows.begin(), count).lpNorm<Eigen::Infinity>();
  }
  parallel::max(errors);
  parallel::max(scales);
  double largest = 0;
  for (Eigen::Index k = 0; k < errors.size(); ++k)
    if (errors[k] > 0) largest = std::max(largest, errors[k] / scales[k]);
  return largest;
}

}  // namespace

BulkSplitting::BulkSplitting(const LinearSystem& system, std::vector<char> held)
    : outer_(system.local.outerIndexPtr(), system.local.outerIndexPtr() + system.local.rows() + 1),
      inner_(system.local.innerIndexPtr(), system.local.innerIndexPtr() + system.local.nonZeros()),
      held_(std::move(held)),
      is_local_(system.local.cols(), 1),
      place_(system.local.cols(), 0) {
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
      if (chosen.entities > 0) (is_local ? local_blocks_ : bulk_.blocks).push_back(std::move(chosen));
    }
  rows_ = system.rows;
  for (const int row : rows_) (is_local_[row] ? local_rows : bulk_rows).push_back(place_[row]);
  whole_bulk_ = parallel::WholeVectors(bulk_rows, bulk);
  whole_local_ = parallel::WholeVectors(local_rows, local);
  split_own_rows(bulk, local);
  split_rows_of_all(bulk, local);
  bulk_.rows = bulk_rows;
  bulk_.pattern_number = new_system_number();
  SPREKK_ASSERT(is_well_formed(bb()) && is_well_formed(ff.matrix), bulk, local);

  std::vector<char> is_interface(local, 0);
  const int* const of_interface = bf.matrix.innerIndexPtr();
  for (const int i : parallel::gather(std::vector<int>(of_interface, of_interface + bf.matrix.nonZeros())))
    is_interface[i] = 1;
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

/// A_BB and A_BF, and the places of the entries of local rows.
void BulkSplitting::split_own_rows(int bulk, int local) {
  Rows mine;
  for (std::size_t row = 0; row < rows_.size(); ++row) {
    if (!is_local_[rows_[row]]) mine.add(outer_[row], outer_[row + 1]);
    for (int k = outer_[row]; is_local_[rows_[row]] && k < outer_[row + 1]; ++k) of_local_rows_.push_back(k);
  }
  SubMatrix bb = extract(mine, inner_, false, bulk);
  bulk_.local.swap(bb.matrix);
  of_bulk_ = std::move(bb.source);
  bf = extract(mine, inner_, true, local);
}

/// A_FB and A_FF, with the rows of all processes.
void BulkSplitting::split_rows_of_all(int bulk, int local) {
  std::vector<int> lengths, columns;
  for (std::size_t row = 0; row < rows_.size(); ++row)
    if (is_local_[rows_[row]]) lengths.push_back(outer_[row + 1] - outer_[row]);
  for (const int k : of_local_rows_) columns.push_back(inner_[k]);
  const std::vector<int> row_of_all = parallel::gather(local_rows), lengths_of_all = parallel::gather(lengths);
  SPREKK_ASSERT(static_cast<int>(row_of_all.size()) == local, row_of_all.size(), local);
  Rows all;
  all.spans.resize(local);
  int end = 0;
  for (std::size_t i = 0; i < row_of_all.size(); ++i) {
    const int begin = std::exchange(end, end + lengths_of_all[i]);
    all.spans[row_of_all[i]] = {begin, end};
  }
  columns = parallel::gather(columns);
  fb = extract(all, columns, false, bulk);
  ff = extract(all, columns, true, local);
}

SubMatrix BulkSplitting::extract(const Rows& rows, const std::vector<int>& column_of, bool local_columns,
                                 int width) const {
  SubMatrix sub;
  std::vector<int> starts{0}, columns;
  for (const auto& [begin, end] : rows.spans) {
    for (int k = begin; k < end; ++k) {
      const int column = column_of[k];
      if (static_cast<bool>(is_local_[column]) != local_columns) continue;
      columns.push_back(place_[column]);
      sub.source.add(k);
    }
    starts.push_back(static_cast<int>(columns.size()));
  }
  sub.matrix.resize(static_cast<int>(starts.size()) - 1, width);
  sub.matrix.resizeNonZeros(columns.size());
  std::copy(starts.begin(), starts.end(), sub.matrix.outerIndexPtr());
  std::copy(columns.begin(), columns.end(), sub.matrix.innerIndexPtr());
  std::fill_n(sub.matrix.valuePtr(), columns.size(), std::nan(""));  // the first update is a change
  return sub;
}

bool BulkSplitting::fits(const SparseMatrix& matrix) const {
  const bool fits_here = static_cast<int>(inner_.size()) == matrix.nonZeros() &&
                         static_cast<int>(outer_.size()) == matrix.rows() + 1 &&
                         std::equal(outer_.begin(), outer_.end(), matrix.outerIndexPtr()) &&
                         std::equal(inner_.begin(), inner_.end(), matrix.innerIndexPtr());
  return !parallel::any(!fits_here);
}

bool BulkSplitting::has_other_bulk(const SparseMatrix& matrix) const {
  SPREKK_EXPECT(matrix.nonZeros() == static_cast<Eigen::Index>(inner_.size()), matrix.nonZeros(), inner_.size());
  const double* values = matrix.valuePtr();
  return of_bulk_.differs(values, bulk_.local.valuePtr()) || bf.differs(values);
}

void BulkSplitting::update(const SparseMatrix& matrix, Bulk bulk) {
  SPREKK_EXPECT(matrix.nonZeros() == static_cast<Eigen::Index>(inner_.size()), matrix.nonZeros(), inner_.size());
  const double* values = matrix.valuePtr();
  if (bulk == Bulk::changes) {
    of_bulk_.take(values, bulk_.local.valuePtr());
    bf.update(values);
  }
  values_of_local_rows_.clear();
  for (const int k : of_local_rows_) values_of_local_rows_.push_back(values[k]);
  const std::vector<double> all = parallel::gather(values_of_local_rows_);
  fb.update(all.data());
  ff.update(all.data());
}

void BulkSplitting::take_sums(const std::vector<int>& sums) {
  if (sums == sums_) return;
  sums_ = sums;
  SPREKK_ASSERT(are_indices(sums_, static_cast<long>(place_.size())), place_.size());
  std::vector<int> of_bulk;
  for (const int sum : sums_)
    if (!is_local_[sum]) of_bulk.push_back(place_[sum]);
  if (of_bulk == bulk_.sums) return;
  bulk_.sums = std::move(of_bulk);
  bulk_.pattern_number = new_system_number();
}

Vector BulkSplitting::bulk_part(const Vector& rows) const {
  SPREKK_EXPECT(rows.size() == static_cast<Eigen::Index>(rows_.size()), rows.size(), rows_.size());
  Vector mine(bulk_rows.size());
  Eigen::Index next = 0;
  for (std::size_t i = 0; i < rows_.size(); ++i)
    if (!is_local_[rows_[i]]) mine[next++] = rows[i];
  return mine;
}

Vector BulkSplitting::local_part(const Vector& rows) const {
  SPREKK_EXPECT(rows.size() == static_cast<Eigen::Index>(rows_.size()), rows.size(), rows_.size());
  Vector mine(local_rows.size());
  Eigen::Index next = 0;
  for (std::size_t i = 0; i < rows_.size(); ++i)
    if (is_local_[rows_[i]]) mine[next++] = rows[i];
  return whole_local_.whole(mine);
}

Vector BulkSplitting::joined(const Vector& bulk, const Vector& local) const {
  SPREKK_EXPECT(bulk.size() == bulk_size() && local.size() == local_size(), bulk.size(), local.size());
  Vector whole(is_local_.size());
  for (std::size_t i = 0; i < is_local_.size(); ++i) whole[i] = is_local_[i] ? local[place_[i]] : bulk[place_[i]];
  return whole;
}

LinearSystem BulkSplitting::local_system(SparseMatrix matrix) const {
  SPREKK_EXPECT(matrix.rows() == local_size() && matrix.cols() == local_size(), matrix.rows(), matrix.cols());
  std::vector<int> rows(local_size());
  std::iota(rows.begin(), rows.end(), 0);
  LinearSystem system = system_of(std::move(rows), std::move(matrix), local_blocks_);
  for (const int sum : sums_)
    if (is_local_[sum]) system.sums.push_back(place_[sum]);
  return system;
}

LinearSystem BulkSplitting::whole_system() const {
  SparseMatrix matrix(rows_.size(), is_local_.size());
  matrix.resizeNonZeros(inner_.size());
  std::copy(outer_.begin(), outer_.end(), matrix.outerIndexPtr());
  std::copy(inner_.begin(), inner_.end(), matrix.innerIndexPtr());
  of_bulk_.put_back(bulk_.local.valuePtr(), matrix.valuePtr());
  bf.source.put_back(bf.matrix.valuePtr(), matrix.valuePtr());
  for (std::size_t k = 0; k < of_local_rows_.size(); ++k)
    matrix.valuePtr()[of_local_rows_[k]] = values_of_local_rows_[k];
  LinearSystem system = system_of(rows_, std::move(matrix), blocks_);
  system.sums = sums_;
  return system;
}

double BulkSplitting::backward_error(const Vector& bulk, const Vector& local, const Vector& b_bulk,
                                     const Vector& b_local) const {
  if (!std::isfinite(bulk.sum() + local.sum())) return HUGE_VAL;
  const auto own_bulk = static_cast<Eigen::Index>(bulk_rows.size());
  SPREKK_EXPECT(b_bulk.size() == own_bulk && b_local.size() == local_size(), b_bulk.size(), b_local.size());
  Vector product = Vector::Zero(own_bulk), size = b_bulk.cwiseAbs();
  multiply(bb(), bulk, product, size);
  multiply(bf.matrix, local, product, size);
  const double of_bulk = largest_by_block(bulk_.blocks, bulk_rows, b_bulk - product, size);
  product = Vector::Zero(local_size());
  size = b_local.cwiseAbs();
  multiply(fb.matrix, bulk, product, size);
  multiply(ff.matrix, local, product, size);
  size = size.cwiseMax(least_sizes(ff.matrix, size));
  std::vector<int> all(local_size());
  std::iota(all.begin(), all.end(), 0);
  return std::max(of_bulk, largest_by_block(local_blocks_, all, b_local - product, size));
}

}  // namespace sprekk
