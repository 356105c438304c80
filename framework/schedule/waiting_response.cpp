#include "framework/schedule/waiting_response.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "framework/assembly/assemble_all.hpp"
#include "framework/assembly/balance_sums.hpp"
#include "framework/invariants.hpp"
#include "framework/matrix_of.hpp"
#include "framework/parallel/parallel.hpp"
#include "framework/round_off.hpp"
#include "framework/schedule/residual_check.hpp"

namespace sprekk {

WaitingResponse::WaitingResponse(const Mesh& mesh, std::vector<const Field*> waiting, std::vector<Part*> parts,
                                 ResponseOptions options, const LinearOptions& linear)
    : mesh_(mesh),
      waiting_(std::move(waiting)),
      parts_(std::move(parts)),
      options_(std::move(options)),
      all_(waiting_),
      system_(mesh, waiting_),
      linear_(make_condensing_solver(linear)) {
  for (const Following& pair : options_.pairs)
    for (const Field* field : {pair.row, pair.column}) {
      SPREKK_EXPECT(std::ranges::count(waiting_, field) == 0, field->name());
      if (std::ranges::count(all_, field) == 0) all_.push_back(field);
    }
}

const std::vector<std::unique_ptr<Field>>& WaitingResponse::copies(const StepTime& step) {
  if (std::exchange(has_looked_for_copies_, true) || options_.is_named) return copies_;
  const std::unique_ptr<Assembly> all = assemble_with_solved(step);
  for (std::size_t w = 0; w < waiting_.size(); ++w) {
    if (is_bulk(waiting_[w]->spec().role.kind())) continue;
    const bool stands_in_rows = std::ranges::any_of(all->blocks(), [&](const Assembly::Block& block) {
      return block.column == static_cast<int>(w) && block.row >= static_cast<int>(waiting_.size()) &&
             all->balances().are_rows_of(block.row) && block.matrix->nonZeros() > 0;
    });
    if (!parallel::any(stands_in_rows)) continue;
    copied_.push_back(waiting_[w]);
    copies_.push_back(std::make_unique<Field>(waiting_[w]->spec(), waiting_[w]->entities()));
  }
  return copies_;
}

int WaitingResponse::copy_of(int waiting) const {
  const auto found = std::ranges::find(copied_, waiting_[waiting]);
  return found == copied_.end() ? -1 : static_cast<int>(found - copied_.begin());
}

void WaitingResponse::set_bounds() {
  if (!options_.is_named) return;
  for (ResponseTerm& term : responses_.terms)
    for (const Part* part : parts_)
      if (const auto* follows = dynamic_cast<const FollowsWaiting*>(part))
        if (Vector least = follows->least_change(*term.row); least.size() > 0) term.least = std::move(least);
}

const Responses& WaitingResponse::update(const StepTime& step) {
  SPREKK_EXPECT(step.dt > 0, step.dt);
  products_.forget_unused();
  responses_.pending.clear();
  for (std::size_t k = 0; k < copies_.size(); ++k) {
    copies_[k]->set_both(copied_[k]->accepted());
    copies_[k]->set(copied_[k]->now());
  }
  Assembly assembly(waiting_, Assembly::Request::residual_and_derivatives, &products_);
  assemble_all(assembly, parts_, step);
  const LinearSystem& system = system_.matrix(assembly);
  const bool is_new = has_changed(system) || step.dt != known_dt_;
  if (!is_new && !options_.has_pending) set_bounds();
  if (!is_new && (!is_determined_ || !options_.has_pending)) return responses_;
  if (is_new) {
    known_ = Eigen::Map<const Vector>(system.local.valuePtr(), system.local.nonZeros());
    known_dt_ = step.dt;
    responses_.terms.clear();
    is_determined_ = linear_->factor(system).solved;
    if (!is_determined_) return responses_;
  }
  const std::unique_ptr<Assembly> all = assemble_with_solved(step);
  const std::map<const Field*, SparseMatrix> answers = answering(*all);
  if (is_new) {
    respond(*all, answers);
    if (is_determined_) add_copies(*all);
    set_bounds();
  }
  if (!is_determined_ || !options_.has_pending) return responses_;
  const ResidualCheck check = check_residual(assembly, system_, options_.settled);
  if (!check.finite || check.rows_hold) return responses_;
  Vector load = -system_.residual(assembly), change;
  for (std::size_t u = 0; u < waiting_.size(); ++u) {  // residuals that are round-off cause no change
    if (!check.is_round_off[u]) continue;
    const int first = system_.first(static_cast<int>(u));
    const auto begin = std::ranges::lower_bound(system_.rows(), first);
    const auto end = std::ranges::lower_bound(system_.rows(), first + waiting_[u]->size());
    load.segment(begin - system_.rows().begin(), end - begin).setZero();
  }
  if (!linear_->solve(load, change).solved) return responses_;
  if (parallel::max(is_finite(change) ? 0.0 : 1.0) > 0) return responses_;
  for (const WaitingBalance& balance : balances(*all)) hold(balance, balance.residual, change);
  for (const auto& [row, answer] : answers) responses_.pending[row] = answer * change;
  for (std::size_t w = 0; w < waiting_.size(); ++w)
    if (const int k = copy_of(static_cast<int>(w)); k >= 0)
      responses_.pending[copies_[k].get()] = -change.segment(system_.first(static_cast<int>(w)), waiting_[w]->size());
  return responses_;
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

std::unique_ptr<Assembly> WaitingResponse::assemble_with_solved(const StepTime& step) {
  auto assembly = std::make_unique<Assembly>(all_, Assembly::Request::residual_and_derivatives, &products_);
  assemble_all(*assembly, parts_, step);
  return assembly;
}

int WaitingResponse::place_in_all(const Field& field) const {
  return static_cast<int>(std::ranges::find(all_, &field) - all_.begin());
}

namespace {

/// Calls `add` with row, column and value of each entry of a block.
template <class Add>
void each_entry(const Assembly::Block& block, const Add& add) {
  for (int r = 0; r < block.matrix->outerSize(); ++r) {
    const double scale = block.weights ? block.factor * (*block.weights)[r] : block.factor;
    for (SparseMatrix::InnerIterator entry(*block.matrix, r); entry; ++entry)
      add(r, static_cast<int>(entry.col()), scale * entry.value());
  }
}

}  // namespace

std::map<const Field*, SparseMatrix> WaitingResponse::answering(const Assembly& assembly) const {
  std::map<const Field*, SparseMatrix> answers;
  for (const Following& pair : options_.pairs) {
    if (answers.count(pair.row) > 0) continue;
    const int row = place_in_all(*pair.row);
    std::vector<Triplet> entries;
    for (const Assembly::Block& block : assembly.blocks()) {
      if (block.row != row || block.column >= static_cast<int>(waiting_.size()) || copy_of(block.column) >= 0) continue;
      const int first = system_.first(block.column);
      each_entry(block, [&](int r, int column, double value) { entries.emplace_back(r, first + column, value); });
    }
    answers.emplace(pair.row, matrix_of(pair.row->size(), system_.size(), entries));
  }
  return answers;
}

SparseMatrix WaitingResponse::driving(const Assembly& assembly, const Field& column) const {
  const int waiting = static_cast<int>(waiting_.size()), place = place_in_all(column);
  std::set<int> fixed;
  for (const Assembly::Fixed& row : assembly.fixed())
    if (row.unknown < waiting) fixed.insert(system_.first(row.unknown) + row.row);
  std::vector<Triplet> entries;
  for (const Assembly::Block& block : assembly.blocks()) {
    if (block.row >= waiting || block.column != place) continue;
    const int first = system_.first(block.row);
    each_entry(block, [&](int r, int by, double value) {
      if (fixed.count(first + r) == 0) entries.emplace_back(by, first + r, value);
    });
  }
  return matrix_of(column.size(), system_.size(), entries);
}

void WaitingResponse::respond(const Assembly& assembly, const std::map<const Field*, SparseMatrix>& answers) {
  std::vector<const Field*> columns;
  for (const Following& pair : options_.pairs)
    if (std::ranges::count(columns, pair.column) == 0) columns.push_back(pair.column);
  const std::vector<int>& rows = system_.rows();
  const std::vector<WaitingBalance> sums = balances(assembly);
  for (const Field* column : columns) {
    std::vector<const Field*> followers;
    for (const Following& pair : options_.pairs)
      if (pair.column == column && parallel::sum(static_cast<double>(answers.at(pair.row).nonZeros())) > 0)
        followers.push_back(pair.row);
    if (followers.empty() && copies_.empty()) continue;
    const SparseMatrix drives = driving(assembly, *column);
    std::vector<std::vector<Triplet>> response(followers.size()), of_copies(copies_.size());
    for (int c = 0; c < column->size(); ++c) {
      Vector load = Vector::Zero(static_cast<Eigen::Index>(rows.size())), follows;
      for (SparseMatrix::InnerIterator entry(drives, c); entry; ++entry) {
        const auto place = std::lower_bound(rows.begin(), rows.end(), static_cast<int>(entry.col()));
        if (place != rows.end() && *place == entry.col()) load[place - rows.begin()] = -entry.value();
      }
      if (parallel::sum(load.squaredNorm()) == 0) continue;
      is_determined_ = linear_->solve(load, follows).solved && parallel::max(is_finite(follows) ? 0.0 : 1.0) == 0;
      if (!is_determined_) {
        responses_.terms.clear();
        return;
      }
      for (const WaitingBalance& balance : sums) hold(balance, balance.of_columns.at(column)[c], follows);
      for (std::size_t f = 0; f < followers.size(); ++f) {
        const Vector answer = answers.at(followers[f]) * follows;
        const double least = rounding::far_above * (answer.size() > 0 ? answer.lpNorm<Eigen::Infinity>() : 0);
        for (int r = 0; r < answer.size(); ++r)
          if (std::abs(answer[r]) > least) response[f].emplace_back(r, c, answer[r]);
      }
      for (std::size_t k = 0; k < copies_.size(); ++k) {
        const auto w = std::ranges::find(waiting_, copied_[k]) - waiting_.begin();
        const int first = system_.first(static_cast<int>(w));
        for (int r = 0; r < copied_[k]->size(); ++r)
          if (follows[first + r] != 0) of_copies[k].emplace_back(r, c, -follows[first + r]);
      }
    }
    for (std::size_t k = 0; k < copies_.size(); ++k) {
      responses_.terms.push_back(
          {copies_[k].get(), column, matrix_of(copied_[k]->size(), column->size(), of_copies[k])});
    }
    for (std::size_t f = 0; f < followers.size(); ++f) {
      if (parallel::sum(static_cast<double>(response[f].size())) == 0) continue;
      responses_.terms.push_back({followers[f], column, matrix_of(followers[f]->size(), column->size(), response[f])});
    }
  }
}

std::vector<WaitingResponse::WaitingBalance> WaitingResponse::balances(const Assembly& assembly) const {
  std::vector<WaitingBalance> found;
  if (copies_.empty()) return found;
  const int waiting = static_cast<int>(waiting_.size());
  for (const Balances::Quantity& quantity : assembly.balances().quantities()) {
    const auto is_in = [&](int row) { return row < waiting && quantity.has(row); };
    const bool is_fixed =
        std::ranges::any_of(assembly.fixed(), [&](const Assembly::Fixed& row) { return is_in(row.unknown); });
    if (parallel::any(is_fixed)) continue;
    WaitingBalance sum;
    sum.of_waiting = Vector::Zero(system_.size());
    for (const Following& pair : options_.pairs) sum.of_columns[pair.column] = Vector::Zero(pair.column->size());
    for (const Assembly::Block& block : assembly.blocks()) {
      if (!is_in(block.row)) continue;
      const auto column = sum.of_columns.find(all_[block.column]);
      if (block.column >= waiting && column == sum.of_columns.end()) continue;
      const std::vector<char>& owned = system_.owned(block.row);
      for (int r = 0; r < block.in_sum->outerSize(); ++r) {
        if (!owned[r]) continue;
        const double scale = block.weights ? block.factor * (*block.weights)[r] : block.factor;
        for (SparseMatrix::InnerIterator entry(*block.in_sum, r); entry; ++entry) {
          if (block.column < waiting)
            sum.of_waiting[system_.first(block.column) + entry.col()] += scale * entry.value();
          else
            column->second[entry.col()] += scale * entry.value();
        }
      }
    }
    for (const int u : quantity.unknowns)
      if (is_in(u)) sum.residual += sum_of_residuals(assembly, u, system_.owned(u));
    parallel::sum(sum.of_waiting);
    // In the order of `all_`: the map is ordered by address, which differs between processes.
    for (const Field* field : all_)
      if (const auto column = sum.of_columns.find(field); column != sum.of_columns.end()) parallel::sum(column->second);
    for (int w = 0; w < waiting; ++w)
      if (copy_of(w) >= 0) sum.of_copies += sum.of_waiting.segment(system_.first(w), waiting_[w]->size()).squaredNorm();
    if (sum.of_copies > 0) found.push_back(std::move(sum));
  }
  return found;
}

void WaitingResponse::hold(const WaitingBalance& balance, double rest, Vector& solution) const {
  // Of what is stored and what passes, the smaller one has the smaller round-off.
  double passing = 0;
  for (std::size_t w = 0; w < waiting_.size(); ++w) {
    if (copy_of(static_cast<int>(w)) < 0) continue;
    const int first = system_.first(static_cast<int>(w)), size = waiting_[w]->size();
    passing += balance.of_waiting.segment(first, size).cwiseProduct(solution.segment(first, size)).lpNorm<1>();
  }
  const double stored = balance.of_waiting.cwiseProduct(solution).lpNorm<1>() - passing + std::abs(rest);
  if (stored >= passing) return;
  const double wrong = balance.of_waiting.dot(solution) + rest;
  for (std::size_t w = 0; w < waiting_.size(); ++w) {
    if (copy_of(static_cast<int>(w)) < 0) continue;
    const int first = system_.first(static_cast<int>(w)), size = waiting_[w]->size();
    solution.segment(first, size) -= wrong / balance.of_copies * balance.of_waiting.segment(first, size);
  }
}

void WaitingResponse::add_copies(const Assembly& assembly) {
  for (std::size_t k = 0; k < copies_.size(); ++k) {
    SparseMatrix one(copies_[k]->size(), copies_[k]->size());
    one.setIdentity();
    responses_.terms.push_back({copies_[k].get(), copies_[k].get(), std::move(one)});
  }
  for (const Assembly::Block& block : assembly.blocks()) {
    const int waiting = static_cast<int>(waiting_.size());
    const int k = block.column < waiting && block.row >= waiting ? copy_of(block.column) : -1;
    if (k < 0) continue;
    std::vector<Triplet> entries;
    each_entry(block, [&](int r, int c, double value) { entries.emplace_back(r, c, value); });
    responses_.terms.push_back(
        {all_[block.row], copies_[k].get(), matrix_of(all_[block.row]->size(), copies_[k]->size(), entries)});
  }
}

LinearCounts WaitingResponse::counts() const {
  LinearCounts counts = linear_->counts();
  counts.patterns = system_.patterns_built();
  return counts;
}

void add_responses(Assembly& assembly, const Responses& responses, const std::map<const Field*, Vector>& start) {
  for (const auto& [row, values] : responses.pending) assembly.add(*row, values);
  for (const ResponseTerm& response : responses.terms) {
    if (!assembly.has_row(*response.row)) continue;
    SPREKK_EXPECT(response.matrix.cols() == response.column->size(), response.column->name());
    const Vector &now = response.column->now(), &first = start.at(response.column);
    Vector term = response.matrix * (now - first);
    Vector follows;  // 1 where the change is not at its bound
    if (response.least.size() > 0) {
      SPREKK_EXPECT(response.least.size() == term.size(), response.row->name(), term.size());
      follows = (term.array() < -response.least.array()).cast<double>();
      term = term.cwiseMin(-response.least);
    }
    assembly.add(*response.row, term);
    const bool is_copy = !response.row->is_solved();  // by a part: it follows from differences of larger numbers
    if (is_copy && now.size() > 0)
      assembly.compare_round_off(*response.row,
                                 (response.matrix.cwiseAbs() * now.cwiseAbs().cwiseMax(first.cwiseAbs())).maxCoeff());
    if (follows.size() == 0 || follows.minCoeff() == 1)
      assembly.derivative(*response.row, *response.column, response.matrix);
    else
      assembly.derivative(*response.row, *response.column, SparseMatrix(follows.asDiagonal() * response.matrix));
  }
}

}  // namespace sprekk
