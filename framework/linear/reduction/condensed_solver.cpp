#include "framework/linear/reduction/condensed_solver.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "framework/invariants.hpp"
#include "framework/linear/expect_sound.hpp"
#include "framework/linear/last_system.hpp"
#include "framework/linear/reduction/bulk_schur_complement.hpp"
#include "framework/linear/reduction/bulk_splitting.hpp"
#include "framework/linear/reduction/floating_parts.hpp"
#include "framework/linear/stopwatch.hpp"
#include "framework/matrix_of.hpp"
#include "framework/parallel/alone.hpp"
#include "framework/parallel/gathered.hpp"
#include "framework/parallel/parallel.hpp"
#include "framework/round_off.hpp"

namespace sprekk {
namespace {

constexpr std::size_t kept_bulks = 2;         // steps of two sizes alternate
constexpr double most_schur_entries = 1.5e8;  ///< largest number of entries that are always kept, 1.2 GB

bool same_values(const SparseMatrix& a, const std::vector<double>& kept) {
  return a.nonZeros() == static_cast<Eigen::Index>(kept.size()) &&
         (kept.empty() || std::memcmp(a.valuePtr(), kept.data(), kept.size() * sizeof(double)) == 0);
}

/// Whether it holds on every process. All decide alike, so that all make the same collective calls.
bool all_say(bool here) { return !parallel::any(!here); }

std::vector<double> values_of(const SparseMatrix& a) { return {a.valuePtr(), a.valuePtr() + a.nonZeros()}; }

bool has_both_kinds(const LinearSystem& system) {
  bool bulk = false, local = false;
  for (const UnknownBlock& block : system.blocks)
    (block.kind == BlockKind::interface ? local : bulk) |= block.entities > 0;
  return bulk && local;
}

/// Entries of A_FF, and in interface rows those of all interface columns.
SparseMatrix pattern_of_reduced(const BulkSplitting& split) {
  std::vector<Triplet> entries;
  for (int row = 0; row < split.local_size(); ++row) {
    for (SparseMatrix::InnerIterator entry(split.ff.matrix, row); entry; ++entry)
      entries.emplace_back(row, static_cast<int>(entry.col()), 0.0);
    if (split.fb.has_row(row))
      for (const int column : split.interface_columns) entries.emplace_back(row, column, 0.0);
  }
  return matrix_of(split.local_size(), split.local_size(), entries);
}

/// A_FF - A_FB X.
SparseMatrix reduced_matrix(const BulkSplitting& split, const SparseMatrix& pattern,
                            const BulkSchurComplement::RowMatrix& schur_rows) {
  SPREKK_EXPECT(schur_rows.cols() == static_cast<Eigen::Index>(split.interface_columns.size()), schur_rows.cols(),
                split.interface_columns.size());
  SPREKK_EXPECT(schur_rows.rows() == static_cast<Eigen::Index>(split.interface_rows.size()), schur_rows.rows());
  SPREKK_EXPECT(pattern.rows() == split.local_size(), pattern.rows(), split.local_size());
  SparseMatrix reduced = pattern;
  int schur_row = 0;
  for (int row = 0; row < split.local_size(); ++row) {
    SparseMatrix::InnerIterator kept(split.ff.matrix, row);
    const bool has_schur_row = split.fb.has_row(row);
    const double* const by_bulk = has_schur_row ? schur_rows.row(schur_row++).data() : nullptr;
    std::size_t c = 0;
    for (SparseMatrix::InnerIterator entry(reduced, row); entry; ++entry) {
      double value = 0;
      if (kept && kept.col() == entry.col()) {
        value = kept.value();
        ++kept;
      }
      if (has_schur_row) {
        while (c < split.interface_columns.size() && split.interface_columns[c] < entry.col()) ++c;
        if (c < split.interface_columns.size() && split.interface_columns[c] == entry.col()) value -= by_bulk[c];
      }
      entry.valueRef() = value;
    }
  }
  SPREKK_ASSERT(schur_row == static_cast<int>(split.interface_rows.size()), schur_row, split.interface_rows.size());
  return reduced;
}

/// Whether no equation on interfaces responds to an unknown of the bulk that was left to them, except for the round-off
/// of what its cell exchanges with the rest of its bulk: then neither the fractures nor what is stored hold that part
/// of the bulk, or too weakly to be seen after the elimination.
bool is_lost(const BulkSplitting& split, const SparseMatrix& reduced,
             const BulkSchurComplement::RowMatrix& schur_rows) {
  std::vector<char> is_felt(split.local_size(), 0);
  int schur_row = 0;
  for (int row = 0; row < reduced.rows(); ++row) {
    const int k = split.fb.has_row(row) ? schur_row++ : -1;
    std::size_t c = 0;
    for (SparseMatrix::InnerIterator entry(reduced, row); entry; ++entry) {
      const int column = static_cast<int>(entry.col());
      if (!split.is_held(column)) continue;
      while (c < split.interface_columns.size() && split.interface_columns[c] < column) ++c;
      double terms = std::abs(split.ff.matrix.coeff(row, column));
      if (k >= 0 && c < split.interface_columns.size() && split.interface_columns[c] == column)
        terms += std::abs(schur_rows(k, static_cast<Eigen::Index>(c)));
      is_felt[column] |= std::abs(entry.value()) > rounding::of_terms * terms;
    }
  }
  for (int column = 0; column < split.local_size(); ++column)
    if (split.is_held(column) && !is_felt[column]) return true;
  return false;
}

/// The number of systems for which a bulk has to stay until condensing has paid for the columns of X, or infinity. The
/// unit of cost is a factorization of the bulk, with its ordering. Then the columns cost C, and the dense part of a
/// reduced system R (CondensingCosts); so m systems cost 1 + C + m R instead of m.
double cost_of_columns(const BulkSplitting& split, const LinearOptions& options) {
  const CondensingCosts& costs = options.condensing;
  const double f = split.interface_columns.size();
  const double reduced = std::pow(f / (costs.width * std::pow(split.bulk_size(), costs.power)), 3);
  return reduced < 1 ? f / (options.bulk_changes_often ? costs.columns_at_once : costs.columns) / (1 - reduced)
                     : HUGE_VAL;
}

}  // namespace

struct CondensedSolver::Bulk {
  explicit Bulk(const LinearOptions& options) : solver(make_linear_solver(options)) {}
  std::unique_ptr<LinearSolver> solver;
  std::uint64_t number = 0;             ///< of A_BB (BulkSplitting::number_bulk)
  std::vector<double> values, columns;  ///< of A_BB and A_BF, where another bulk has come since
  int systems = 0;                      ///< number of systems with this bulk
  bool is_tried = false;                ///< whether it has been factorized, successfully or not
  bool is_verified = false;             ///< whether the first solution was accurate
  LinearReport report;
  BulkSchurComplement schur;
};

CondensedSolver::CondensedSolver(const LinearOptions& options) : options_(options) {}
CondensedSolver::~CondensedSolver() = default;

LinearReport CondensedSolver::factor(const LinearSystem& system) {
  expect_sound(system);
  is_condensed_ = false;
  const bool is_whole_direct = is_direct(options_, static_cast<int>(system.local.cols()));
  if (is_whole_direct && has_both_kinds(system) && all_say(system.local.isCompressed())) {
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
  const auto is_same = [](std::uint64_t number, std::uint64_t last) { return all_say(number != 0 && number == last); };
  const bool fits = splitting_ && (is_same(system.pattern_number, pattern_number_) || splitting_->fits(system.local));
  if (!fits) split_anew(system, unknowns_held_by_fractures(system));
  bool has_changed = false;
  if (!is_same(system.number, number_)) {
    has_changed = parallel::any(splitting_->has_other_bulk(system.local));
    if (has_changed) remember_bulk();
    splitting_->update(system.local, has_changed ? BulkSplitting::Bulk::changes : BulkSplitting::Bulk::stays);
    if (has_changed && fits) {
      std::vector<char> held = unknowns_held_by_fractures(system);
      if (held != splitting_->held()) {
        split_anew(system, std::move(held));
        splitting_->update(system.local);
      }
    }
  }
  BulkSplitting& split = *splitting_;
  SPREKK_ASSERT(split.bulk_size() + split.local_size() == system.local.cols(), split.bulk_size(), split.local_size());
  split.take_sums(system.sums);
  // The entries to be kept: for each bulk the rows of X that are read and their products; the triplets of the reduced
  // pattern.
  const double width = split.interface_columns.size();
  if ((kept_bulks * split.near.size() + 6 * width) * width > most_schur_entries)
    return LinearReport::failure("too many unknowns on fractures to condense the bulk");
  if (has_changed) choose_bulk();
  pattern_number_ = system.pattern_number;
  number_ = system.number;
  Bulk& bulk = bulks_.front();
  ++bulk.systems;
  if (!bulk.is_tried) {
    const double cost = cost_of_columns(split, options_);
    if (cost > options_.condensing.worth_at_once && bulk.systems <= cost)
      return LinearReport::failure("condensing costs more than the few systems that the bulk has had so far");
    bulk.report = bulk.schur.compute(split, *bulk.solver, options_.bulk_changes_often);
    bulk.is_tried = true;
    bulk.is_verified = false;
  }
  if (!bulk.report.solved) return bulk.report;
  if (is_same(system.number, reduced_number_)) return reduced_report_;
  if (reduced_pattern_.rows() == 0) reduced_pattern_ = pattern_of_reduced(split);
  const BulkSchurComplement::RowMatrix* const schur_rows = bulk.schur.schur_rows(split, *bulk.solver);
  if (!schur_rows)
    return bulk.report =
               LinearReport::failure("the bulk could not be factorized for equations on fractures that have changed");
  reduced_number_ = system.number;
  SparseMatrix reduced = reduced_matrix(split, reduced_pattern_, *schur_rows);
  if (split.has_held() && is_lost(split, reduced, *schur_rows))
    return reduced_report_ = LinearReport::failure("a part of the bulk is not held by its fractures");
  const parallel::Alone on_every_process;
  return reduced_report_ = reduced_.factor(split.local_system(std::move(reduced)));
}

void CondensedSolver::split_anew(const LinearSystem& system, std::vector<char> held) {
  for (const Bulk& bulk : bulks_) retired_ += bulk.solver->counts();
  bulks_.clear();
  splitting_ = std::make_unique<BulkSplitting>(system, std::move(held));
  reduced_pattern_ = SparseMatrix();
  number_ = reduced_number_ = 0;
}

/// Keeps the values of the bulk in use, before others take their place in the splitting.
void CondensedSolver::remember_bulk() {
  if (bulks_.empty() || !bulks_.front().values.empty()) return;
  bulks_.front().values = values_of(splitting_->bb());
  bulks_.front().columns = values_of(splitting_->bf.matrix);
}

/// Takes the bulk that has the values of the splitting, or a new one, in place of the one in use, which differs.
void CondensedSolver::choose_bulk() {
  SPREKK_ASSERT(bulks_.size() <= kept_bulks, bulks_.size());
  const auto known = std::find_if(bulks_.begin(), bulks_.end(), [this](const Bulk& bulk) {
    return all_say(same_values(splitting_->bb(), bulk.values) && same_values(splitting_->bf.matrix, bulk.columns));
  });
  if (known != bulks_.end()) {
    bulks_.splice(bulks_.begin(), bulks_, known);
    splitting_->number_bulk(known->number);
    return;
  }
  if (bulks_.size() < kept_bulks)
    bulks_.emplace_front(options_);
  else
    bulks_.splice(bulks_.begin(), bulks_, std::prev(bulks_.end()));  // the oldest; its ordering stays
  Bulk& bulk = bulks_.front();
  const bool has_other_columns_only = bulk.number != 0 && all_say(same_values(splitting_->bb(), bulk.values));
  if (!has_other_columns_only) bulk.number = new_telling_number();
  splitting_->number_bulk(bulk.number);
  bulk.values = std::vector<double>();
  bulk.columns = std::vector<double>();
  bulk.systems = 0;
  bulk.is_tried = false;
}

LinearReport CondensedSolver::solve_condensed(const Vector& b_bulk, const Vector& b_local, Vector& bulk,
                                              Vector& local) {
  const BulkSplitting& split = *splitting_;
  SPREKK_EXPECT(b_bulk.size() == static_cast<Eigen::Index>(split.bulk_rows.size()), b_bulk.size());
  SPREKK_EXPECT(b_local.size() == split.local_size(), b_local.size(), split.local_size());
  SPREKK_ASSERT(!bulks_.empty());
  bulk = Vector::Zero(split.bulk_size());
  if (parallel::any(!b_bulk.isZero(0))) {
    const LinearReport report = bulks_.front().solver->solve(b_bulk, bulk);
    if (!report.solved) return report;
  }
  const LinearReport report = solve_reduced(b_local - split.fb.matrix * bulk, local);
  if (!report.solved) return report;
  bulks_.front().schur.subtract(split, *bulks_.front().solver, local, bulk);
  return report;
}

/// Every process solves for all unknowns on fractures, and takes the answer of the first: another machine may round
/// otherwise.
LinearReport CondensedSolver::solve_reduced(const Vector& b, Vector& x) {
  LinearReport report;
  {
    const parallel::Alone on_every_process;
    report = reduced_.solve(b, x);
  }
  if (parallel::size() == 1) return report;
  if (!all_say(report.solved))
    return report.solved ? LinearReport::failure("another process could not solve for the unknowns on fractures")
                         : report;
  parallel::broadcast(x);
  return report;
}

LinearReport CondensedSolver::solve(const Vector& b_rows, Vector& x) {
  if (is_condensed_) {
    const BulkSplitting& split = *splitting_;
    const Vector b_bulk = split.bulk_part(b_rows), b_local = split.local_part(b_rows);
    Vector bulk, local;
    LinearReport report = solve_condensed(b_bulk, b_local, bulk, local);
    Bulk& used = bulks_.front();
    used.is_verified = used.is_verified || (report.solved && verifies(b_bulk, b_local, bulk, local));
    if (report.solved && used.is_verified) {
      x = split.joined(bulk, local);
      return report;
    }
    if (report.solved) used.report = LinearReport::failure("the first solution with this bulk was inaccurate");
    report = factor_whole(split.whole_system());
    if (!report.solved) return report;
  }
  return whole_ ? whole_->solve(b_rows, x) : LinearReport::failure("solve was called before factor");
}

/// Whether this solution is accurate, or would be after one step of refinement. The refined solution is not used: later
/// solutions are not refined either, and a run that is continued from a checkpoint, whose first solution comes later,
/// must have the same bits as a run without interruption.
bool CondensedSolver::verifies(const Vector& b_bulk, const Vector& b_local, const Vector& bulk, const Vector& local) {
  constexpr double acceptable = 1e-9;  // ten times what a whole solve may have
  const BulkSplitting& split = *splitting_;
  const double error = split.backward_error(bulk, local, b_bulk, b_local);
  if (error <= acceptable || !std::isfinite(error)) return error <= acceptable;
  Vector more_bulk, more_local;
  const Vector r_bulk = b_bulk - split.bb() * bulk - split.bf.matrix * local;
  const Vector r_local = b_local - split.fb.matrix * bulk - split.ff.matrix * local;
  return solve_condensed(r_bulk, r_local, more_bulk, more_local).solved &&
         split.backward_error(bulk + more_bulk, local + more_local, b_bulk, b_local) <= acceptable;
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
