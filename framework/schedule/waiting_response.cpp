#include "framework/schedule/waiting_response.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "framework/assembly/assemble_all.hpp"
#include "framework/invariants.hpp"
#include "framework/parallel/parallel.hpp"

namespace sprekk {

WaitingResponse::WaitingResponse(const Mesh& mesh, std::vector<const Field*> waiting, std::vector<Part*> parts,
                                 std::vector<Following> pairs, const LinearOptions& linear)
    : mesh_(mesh),
      waiting_(std::move(waiting)),
      parts_(std::move(parts)),
      pairs_(std::move(pairs)),
      system_(mesh, waiting_),
      linear_(make_condensing_solver(linear)) {}

const std::vector<ResponseTerm>& WaitingResponse::update(const StepTime& step) {
  SPREKK_EXPECT(step.dt > 0, step.dt);
  products_.forget_unused();
  Assembly assembly(waiting_, Assembly::Request::residual_and_derivatives, &products_);
  assemble_all(assembly, parts_, step);
  const LinearSystem& system = system_.matrix(assembly);
  if (!has_changed(system) && step.dt == known_dt_) return terms_;
  known_ = Eigen::Map<const Vector>(system.local.valuePtr(), system.local.nonZeros());
  known_dt_ = step.dt;
  terms_.clear();
  if (!linear_->factor(system).solved) return terms_;
  for (const Following& pair : pairs_) {
    ResponseTerm term = respond(pair, step);
    if (parallel::sum(static_cast<double>(term.matrix.nonZeros())) > 0) terms_.push_back(std::move(term));
  }
  return terms_;
}

bool WaitingResponse::has_changed(const LinearSystem& system) {
  constexpr double much = 0.01;  // of the largest entry of the row
  const SparseMatrix& matrix = system.local;
  double largest_change = 0;
  if (known_.size() != matrix.nonZeros()) {
    largest_change = 1;
  } else {
    for (int row = 0; row < matrix.outerSize(); ++row) {
      double change = 0, largest = 0;
      for (int k = matrix.outerIndexPtr()[row]; k < matrix.outerIndexPtr()[row + 1]; ++k) {
        change = std::max(change, std::abs(matrix.valuePtr()[k] - known_[k]));
        largest = std::max({largest, std::abs(matrix.valuePtr()[k]), std::abs(known_[k])});
      }
      if (change > 0) largest_change = std::max(largest_change, change / largest);
    }
  }
  return parallel::max(largest_change) > much;
}

ResponseTerm WaitingResponse::respond(const Following& pair, const StepTime& step) {
  const int waiting = static_cast<int>(waiting_.size()), column_field = waiting, row_field = waiting + 1;
  std::vector<const Field*> all = waiting_;
  all.push_back(pair.column);
  all.push_back(pair.row);
  Assembly assembly(all, Assembly::Request::residual_and_derivatives, &products_);
  assemble_all(assembly, parts_, step);

  std::set<int> fixed;
  for (const Assembly::Fixed& row : assembly.fixed())
    if (row.unknown < waiting) fixed.insert(system_.first(row.unknown) + row.row);
  std::vector<Triplet> by_column, by_waiting;
  for (const Assembly::Block& block : assembly.blocks()) {
    const bool drives = block.row < waiting && block.column == column_field;
    const bool answers = block.row == row_field && block.column < waiting;
    if (!drives && !answers) continue;
    for (int r = 0; r < block.matrix->outerSize(); ++r) {
      const double scale = block.weights ? block.factor * (*block.weights)[r] : block.factor;
      for (SparseMatrix::InnerIterator entry(*block.matrix, r); entry; ++entry) {
        const int column = static_cast<int>(entry.col());
        if (drives && fixed.count(system_.first(block.row) + r) == 0)
          by_column.emplace_back(column, system_.first(block.row) + r, scale * entry.value());
        if (answers) by_waiting.emplace_back(r, system_.first(block.column) + column, scale * entry.value());
      }
    }
  }
  SparseMatrix driving(pair.column->size(), system_.size()), answering(pair.row->size(), system_.size());
  driving.setFromTriplets(by_column.begin(), by_column.end());  // transposed: a row for each value of the column field
  answering.setFromTriplets(by_waiting.begin(), by_waiting.end());

  constexpr double negligible = 1e-6;  // of the largest entry of the column
  std::vector<Triplet> response;
  const std::vector<int>& rows = system_.rows();
  for (int c = 0; c < pair.column->size(); ++c) {
    Vector load = Vector::Zero(static_cast<Eigen::Index>(rows.size())), follows;
    for (SparseMatrix::InnerIterator entry(driving, c); entry; ++entry) {
      const auto place = std::lower_bound(rows.begin(), rows.end(), static_cast<int>(entry.col()));
      if (place != rows.end() && *place == entry.col()) load[place - rows.begin()] = -entry.value();
    }
    if (parallel::sum(load.squaredNorm()) == 0) continue;
    if (!linear_->solve(load, follows).solved)
      return {pair.row, pair.column, SparseMatrix(pair.row->size(), pair.column->size())};
    const Vector answer = answering * follows;
    if (parallel::max(is_finite(answer) ? 0.0 : 1.0) > 0)
      return {pair.row, pair.column, SparseMatrix(pair.row->size(), pair.column->size())};
    const double least = negligible * (answer.size() > 0 ? answer.lpNorm<Eigen::Infinity>() : 0);
    for (int r = 0; r < answer.size(); ++r)
      if (std::abs(answer[r]) > least) response.emplace_back(r, c, answer[r]);
  }
  SparseMatrix matrix(pair.row->size(), pair.column->size());
  matrix.setFromTriplets(response.begin(), response.end());
  return {pair.row, pair.column, std::move(matrix)};
}

LinearCounts WaitingResponse::counts() const {
  LinearCounts counts = linear_->counts();
  counts.patterns = system_.patterns_built();
  return counts;
}

}  // namespace sprekk
