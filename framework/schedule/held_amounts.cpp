#include "framework/schedule/held_amounts.hpp"

#include <algorithm>
#include <utility>

#include "framework/assembly/assemble_all.hpp"
#include "framework/invariants.hpp"
#include "framework/matrix_of.hpp"
#include "framework/parallel/parallel.hpp"

namespace sprekk {

namespace {

double scale_of(const Assembly::Block& block, int row) {
  return block.weights ? block.factor * (*block.weights)[row] : block.factor;
}

/// d row / d column; the rows that this process owns.
SparseMatrix derivative(const Assembly& assembly, int row, int column) {
  std::vector<Triplet> entries;
  for (const Assembly::Block& block : assembly.blocks()) {
    if (block.row != row || block.column != column) continue;
    for (int r = 0; r < block.matrix->outerSize(); ++r)
      for (SparseMatrix::InnerIterator entry(*block.matrix, r); entry; ++entry)
        entries.emplace_back(r, static_cast<int>(entry.col()), scale_of(block, r) * entry.value());
  }
  return matrix_of(assembly.unknowns()[row]->size(), assembly.unknowns()[column]->size(), entries);
}

/// What balances store for a uniform change of their own field by 1; the rows that this process owns. 0 for rows with
/// fixed values.
Vector stored(const Assembly& assembly, int row) {
  Vector sums = Vector::Zero(assembly.unknowns()[row]->size());
  for (const Assembly::Block& block : assembly.blocks()) {
    if (block.row != row || block.column != row) continue;
    for (int r = 0; r < block.in_sum->outerSize(); ++r)
      for (SparseMatrix::InnerIterator entry(*block.in_sum, r); entry; ++entry)
        sums[r] += scale_of(block, r) * entry.value();
  }
  for (const Assembly::Fixed& fixed : assembly.fixed())
    if (fixed.unknown == row) sums[fixed.row] = 0;
  return sums;
}

/// The factors −b/s, with the rows of all processes.
SparseMatrix following(const SparseMatrix& b, const Vector& s, const std::vector<char>& owned) {
  std::vector<int> places;
  std::vector<double> values;
  for (int r = 0; r < b.outerSize(); ++r) {
    if (!owned[r] || s[r] <= 0) continue;
    for (SparseMatrix::InnerIterator entry(b, r); entry; ++entry) {
      if (entry.value() == 0) continue;
      places.insert(places.end(), {r, static_cast<int>(entry.col())});
      values.push_back(-entry.value() / s[r]);
    }
  }
  places = parallel::gather(places);
  values = parallel::gather(values);
  SPREKK_ASSERT(places.size() == 2 * values.size(), places.size(), values.size());
  std::vector<Triplet> entries;
  for (std::size_t i = 0; i < values.size(); ++i) entries.emplace_back(places[2 * i], places[2 * i + 1], values[i]);
  return matrix_of(b.rows(), b.cols(), entries);
}

std::vector<const Field*> joined(std::vector<const Field*> fields, const std::vector<const Field*>& more) {
  fields.insert(fields.end(), more.begin(), more.end());
  return fields;
}

bool are_same(const SparseMatrix& a, const SparseMatrix& b) {
  if (a.rows() != b.rows() || a.cols() != b.cols() || a.nonZeros() != b.nonZeros()) return false;
  return std::equal(a.valuePtr(), a.valuePtr() + a.nonZeros(), b.valuePtr()) &&
         std::equal(a.innerIndexPtr(), a.innerIndexPtr() + a.nonZeros(), b.innerIndexPtr());
}

}  // namespace

HeldAmounts::HeldAmounts(const Mesh& mesh, std::vector<const Field*> held, std::vector<const Field*> solved,
                         std::vector<Part*> parts)
    : held_(std::move(held)),
      solved_(std::move(solved)),
      all_(joined(solved_, held_)),
      parts_(std::move(parts)),
      system_(mesh, all_) {}

const std::vector<ResponseTerm>& HeldAmounts::update(const StepTime& step) {
  products_.forget_unused();
  Assembly assembly(all_, Assembly::Request::residual_and_derivatives, &products_);
  assemble_all(assembly, parts_, step);
  const int solved = static_cast<int>(solved_.size());
  std::size_t next = 0;
  const auto add = [&](const Field* row, const Field* column, SparseMatrix by_held, const SparseMatrix& follows) {
    const bool is_kept = next < terms_.size() && terms_[next].row == row && terms_[next].column == column &&
                         are_same(factors_[next].by_held, by_held) && are_same(factors_[next].following, follows);
    if (!is_kept) {
      terms_.resize(std::max(terms_.size(), next + 1));
      factors_.resize(terms_.size());
      terms_[next] = {row, column, SparseMatrix(by_held * follows)};
      factors_[next] = {std::move(by_held), follows};
    }
    ++next;
  };
  for (std::size_t h = 0; h < held_.size(); ++h) {
    const int held = solved + static_cast<int>(h);
    const Vector amounts = stored(assembly, held);
    for (int c = 0; c < solved; ++c) {
      const SparseMatrix b = derivative(assembly, held, c);
      if (!parallel::any(b.nonZeros() > 0)) continue;
      const SparseMatrix follows = following(b, amounts, system_.owned(held));
      for (int r = 0; r < solved; ++r) {
        SparseMatrix by_held = derivative(assembly, r, held);
        if (parallel::any(by_held.nonZeros() > 0)) add(solved_[r], solved_[c], std::move(by_held), follows);
      }
    }
  }
  terms_.resize(next);
  factors_.resize(next);
  return terms_;
}

}  // namespace sprekk
