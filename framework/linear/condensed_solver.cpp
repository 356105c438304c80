#include "framework/linear/condensed_solver.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "framework/linear/bulk_splitting.hpp"
#include "framework/linear/stopwatch.hpp"
#include "framework/parallel/parallel.hpp"

namespace sprekk {
namespace {

constexpr std::size_t kept_bulks = 2;
constexpr double largest_response = 1.5e8;  // entries of X: 1.2 GB

bool same_values(const SparseMatrix& a, const std::vector<double>& kept) {
  return a.nonZeros() == static_cast<Eigen::Index>(kept.size()) &&
         (kept.empty() || std::memcmp(a.valuePtr(), kept.data(), kept.size() * sizeof(double)) == 0);
}

std::vector<double> values_of(const SparseMatrix& a) { return {a.valuePtr(), a.valuePtr() + a.nonZeros()}; }

bool has_both_kinds(const LinearSystem& system) {
  bool bulk = false, local = false;
  for (const UnknownBlock& block : system.blocks)
    (block.kind == UnknownBlock::Kind::local ? local : bulk) |= block.entities > 0;
  return bulk && local;
}

/// Entries of A_FF, and in rows that feel the bulk those of all columns that the bulk feels.
SparseMatrix pattern_of_reduced(const BulkSplitting& split) {
  std::vector<Triplet> entries;
  for (int row = 0; row < split.local_size(); ++row) {
    for (SparseMatrix::InnerIterator entry(split.ff.matrix, row); entry; ++entry)
      entries.emplace_back(row, static_cast<int>(entry.col()), 0.0);
    if (split.fb.has_row(row))
      for (const int column : split.felt) entries.emplace_back(row, column, 0.0);
  }
  SparseMatrix pattern(split.local_size(), split.local_size());
  pattern.setFromTriplets(entries.begin(), entries.end());
  return pattern;
}

/// The price of the columns of X in factorizations: each reads the factors, n log n entries in two dimensions, where a
/// factorization takes n^(3/2) operations. The factor was measured for 4,500 and 70,000 unknowns.
double price_of_columns(const BulkSplitting& split) {
  const double n = split.bulk_size();
  return split.felt.size() * std::log2(n) / (20 * std::sqrt(n));
}

/// A step of Newton's method takes about three systems, so what costs two factorizations pays at once; what costs more
/// when the bulk has stayed for as many systems.
constexpr double worth_at_once = 2;

}  // namespace

struct CondensedSolver::Bulk {
  explicit Bulk(const LinearOptions& options) : solver(make_linear_solver(options)) {}
  std::unique_ptr<LinearSolver> solver;
  std::vector<double> values, columns;  ///< of the A_BB and A_BF for which the rest holds
  int systems = 0;                      ///< that it has had
  bool is_tried = false;                ///< whether it has been factorized, successfully or not
  LinearReport report;
  Eigen::MatrixXd response;  ///< X; its columns are those of BulkSplitting::felt
};

CondensedSolver::CondensedSolver(const LinearOptions& options) : options_(options) {}
CondensedSolver::~CondensedSolver() = default;

LinearReport CondensedSolver::factor(const LinearSystem& system) {
  is_condensed_ = false;
  if (parallel::size() == 1 && has_both_kinds(system) && system.local.isCompressed()) {
    const LinearReport report = condense(system);
    is_condensed_ = report.solved;
    if (is_condensed_) return report;
  }
  return factor_whole(system);
}

LinearReport CondensedSolver::factor_whole(const LinearSystem& system) {
  is_condensed_ = false;
  if (!whole_) whole_ = make_linear_solver(options_);
  return whole_->factor(system);
}

LinearReport CondensedSolver::condense(const LinearSystem& system) {
  const auto is_same = [](std::uint64_t number, std::uint64_t last) { return number != 0 && number == last; };
  if (!splitting_ || !(is_same(system.pattern_number, pattern_number_) || splitting_->fits(system.local))) {
    for (const Bulk& bulk : bulks_) retired_ += bulk.solver->counts();
    bulks_.clear();
    splitting_ = std::make_unique<BulkSplitting>(system);
    reduced_pattern_ = pattern_of_reduced(*splitting_);
    number_ = reduced_number_ = 0;
  }
  BulkSplitting& split = *splitting_;
  split.take_sums(system.sums);
  if (static_cast<double>(split.bulk_size()) * split.felt.size() > largest_response)
    return LinearReport::failure("too many unknowns on fractures to condense the bulk");
  if (!is_same(system.number, number_)) {
    const double* values = system.local.valuePtr();
    const bool has_changed = split.bb.update(values) | split.bf.update(values);
    split.fb.update(values);
    split.ff.update(values);
    if (has_changed) choose_bulk();
  }
  pattern_number_ = system.pattern_number;
  number_ = system.number;
  Bulk& bulk = bulks_.front();
  ++bulk.systems;
  if (!bulk.is_tried) {
    const double price = price_of_columns(split);
    if (price > worth_at_once && bulk.systems <= price)
      return LinearReport::failure("condensing costs more than the few systems that the bulk has had so far");
    bulk.report = respond(bulk);
    bulk.is_tried = true;
    is_proven_ = false;
  }
  if (!bulk.report.solved) return bulk.report;
  if (is_same(system.number, reduced_number_)) return reduced_report_;
  reduced_number_ = system.number;
  return reduced_report_ = reduced_.factor(split.local_system(reduced_matrix()));
}

void CondensedSolver::choose_bulk() {
  const auto known = std::find_if(bulks_.begin(), bulks_.end(), [this](const Bulk& bulk) {
    return same_values(splitting_->bb.matrix, bulk.values) && same_values(splitting_->bf.matrix, bulk.columns);
  });
  if (known != bulks_.end()) {
    bulks_.splice(bulks_.begin(), bulks_, known);
    return;
  }
  if (bulks_.size() < kept_bulks)
    bulks_.emplace_front(options_);
  else
    bulks_.splice(bulks_.begin(), bulks_, std::prev(bulks_.end()));  // keeps its ordering
  Bulk& bulk = bulks_.front();
  bulk.values = values_of(splitting_->bb.matrix);
  bulk.columns = values_of(splitting_->bf.matrix);
  bulk.systems = 0;
  bulk.is_tried = false;
}

LinearReport CondensedSolver::respond(Bulk& bulk) const {
  const BulkSplitting& split = *splitting_;
  const LinearReport report = bulk.solver->factor(split.bulk_system());
  if (!report.solved) return report;
  std::vector<int> column_of(split.local_size());
  for (std::size_t c = 0; c < split.felt.size(); ++c) column_of[split.felt[c]] = static_cast<int>(c);
  bulk.response.setZero(split.bulk_size(), split.felt.size());
  for (int row = 0; row < split.bulk_size(); ++row)
    for (SparseMatrix::InnerIterator entry(split.bf.matrix, row); entry; ++entry)
      bulk.response(row, column_of[entry.col()]) = entry.value();
  if (!bulk.solver->solve_columns(bulk.response))
    return LinearReport::failure(bulk.solver->name() + " does not solve for columns");
  return report;
}

SparseMatrix CondensedSolver::reduced_matrix() const {
  const BulkSplitting& split = *splitting_;
  SparseMatrix reduced = reduced_pattern_;
  Vector dense(split.felt.size());
  for (int row = 0; row < split.local_size(); ++row) {
    SparseMatrix::InnerIterator kept(split.ff.matrix, row);
    const bool feels = split.fb.has_row(row);
    if (feels) dense.setZero();
    for (SparseMatrix::InnerIterator entry(split.fb.matrix, row); entry; ++entry)
      dense += entry.value() * bulks_.front().response.row(entry.col()).transpose();
    std::size_t c = 0;
    for (SparseMatrix::InnerIterator entry(reduced, row); entry; ++entry) {
      double value = 0;
      if (kept && kept.col() == entry.col()) {
        value = kept.value();
        ++kept;
      }
      if (feels) {
        while (c < split.felt.size() && split.felt[c] < entry.col()) ++c;
        if (c < split.felt.size() && split.felt[c] == entry.col()) value -= dense[c];
      }
      entry.valueRef() = value;
    }
  }
  return reduced;
}

LinearReport CondensedSolver::solve_condensed(const Vector& b_bulk, const Vector& b_local, Vector& bulk,
                                              Vector& local) {
  const BulkSplitting& split = *splitting_;
  bulk = Vector::Zero(split.bulk_size());
  if (!b_bulk.isZero(0)) {
    const LinearReport report = bulks_.front().solver->solve(b_bulk, bulk);
    if (!report.solved) return report;
  }
  const LinearReport report = reduced_.solve(b_local - split.fb.matrix * bulk, local);
  if (!report.solved) return report;
  Vector felt(split.felt.size());
  for (std::size_t c = 0; c < split.felt.size(); ++c) felt[c] = local[split.felt[c]];
  bulk.noalias() -= bulks_.front().response * felt;
  return report;
}

LinearReport CondensedSolver::solve(const Vector& b_rows, Vector& x) {
  if (is_condensed_) {
    constexpr double accurate = 1e-11, acceptable = 1e-9;
    const BulkSplitting& split = *splitting_;
    const Vector b_bulk = split.bulk_part(b_rows), b_local = split.local_part(b_rows);
    Vector bulk, local;
    LinearReport report = solve_condensed(b_bulk, b_local, bulk, local);
    double error = !report.solved ? HUGE_VAL : is_proven_ ? 0 : split.backward_error(bulk, local, b_bulk, b_local);
    if (error > accurate && std::isfinite(error)) {
      Vector more_bulk, more_local;
      const Vector r_bulk = b_bulk - split.bb.matrix * bulk - split.bf.matrix * local;
      const Vector r_local = b_local - split.fb.matrix * bulk - split.ff.matrix * local;
      if (solve_condensed(r_bulk, r_local, more_bulk, more_local).solved) {
        more_bulk += bulk;
        more_local += local;
        const double next = split.backward_error(more_bulk, more_local, b_bulk, b_local);
        if (next < error) {
          error = next;
          bulk = std::move(more_bulk);
          local = std::move(more_local);
        }
      }
    }
    if (error <= acceptable) {
      is_proven_ = true;
      x = split.joined(bulk, local);
      return report;
    }
    report = factor_whole(split.whole_system());
    if (!report.solved) return report;
  }
  return whole_ ? whole_->solve(b_rows, x) : LinearReport::failure("solve was called before factor");
}

std::string CondensedSolver::name() const {
  if (is_condensed_) return "condensed " + bulks_.front().solver->name();
  return whole_ ? whole_->name() : options_.type;
}

const LinearCounts& CondensedSolver::counts() const {
  total_ = retired_;
  for (const Bulk& bulk : bulks_) total_ += bulk.solver->counts();
  if (whole_) total_ += whole_->counts();
  const LinearCounts& reduced = reduced_.counts();
  total_.condensed += reduced.factorizations;
  total_.seconds_ordering += reduced.seconds_ordering;
  total_.seconds_factor += reduced.seconds_factor;
  total_.seconds_solve += reduced.seconds_solve;
  return total_;
}

}  // namespace sprekk
