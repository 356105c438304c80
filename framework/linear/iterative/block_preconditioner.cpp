#include "framework/linear/iterative/block_preconditioner.hpp"

#include <stdexcept>

#include "framework/invariants.hpp"
#include "framework/linear/iterative/cycle_with_zone.hpp"
#include "framework/linear/iterative/sparse_sum.hpp"
#include "framework/linear/iterative/without_small_entries.hpp"
#include "framework/parallel/parallel.hpp"

namespace sprekk {

BlockPreconditioner::BlockPreconditioner(const LinearSystem& system) {
  const Partition partition(system);
  const int parts = static_cast<int>(partition.parts.size());
  const int local = parts - 1;
  elimination_.emplace(system, partition);
  local_owned_ = partition.local().owned;
  local_unknowns_ = static_cast<int>(partition.local().unknowns.size());
  whole_local_ = parallel::WholeVectors(local_owned_, local_unknowns_);

  couplings_.resize(parts);
  for (int row_part = 0; row_part < parts; ++row_part) {
    owned_rows_.push_back(partition.parts[row_part].owned_rows);
    for (int column_part = 0; column_part < parts; ++column_part) {
      // A sweep needs only the couplings to bulk parts that come earlier in the sweep.
      const bool is_needed = row_part == local ? column_part != local : column_part < row_part || column_part == local;
      if (!is_needed || partition.parts[row_part].unknowns.empty()) continue;
      const SparseMatrix block = sub_matrix(system.local, partition, row_part, column_part);
      if (!parallel::any(block.nonZeros() > 0)) continue;
      couplings_[row_part].push_back(
          {column_part, trilinos().matrix(block, partition.parts[row_part].owned, partition.parts[column_part].owned,
                                          static_cast<int>(partition.parts[row_part].unknowns.size()))});
    }
  }

  std::vector<Vector> diagonals;
  for (int part = 0; part < local; ++part) {
    UnknownBlock block = partition.parts[part].block;
    SparseMatrix a =
        sparse_sum(sub_matrix(system.local, partition, part, part), elimination_->correction(system, partition, part));
    const std::vector<int>& owned = partition.parts[part].owned;
    const bool has_fractures = partition.parts[part].has_fractures;
    // Multi-point fluxes reach far, by entries that cost a multigrid more than they help it. With a stabilization the
    // block stands for a Schur complement, unless it has the potentials on fractures as well.
    if (block.kind == BlockKind::bulk_elliptic && (block.stabilization.size() == 0 || has_fractures))
      a = without_small_entries(a, owned);
    if (block.stabilization.size() > 0) {
      SparseMatrix diagonal(a.rows(), a.cols());
      diagonal.reserve(Eigen::VectorXi::Ones(a.rows()));
      for (std::size_t k = 0; k < owned.size(); ++k)
        diagonal.insert(static_cast<int>(k), owned[k]) = block.stabilization[owned[k]];
      a = sparse_sum(a, diagonal);
      // Fractures that conduct well matter more to a multigrid than what the diagonal stands for.
      if (has_fractures) block.stabilization.resize(0);
    }
    Vector& own = diagonals.emplace_back(a.rows());
    for (int row = 0; row < a.rows(); ++row) own[row] = a.coeff(row, owned[row]);
    std::unique_ptr<Multigrid> cycle = trilinos().multigrid(a, owned, block);
    std::vector<int> zone;
    if (block.kind == BlockKind::bulk_elastic && block.components == 3) zone = elimination_->beside(partition, part);
    cycles_.push_back(zone.empty() ? std::move(cycle)
                                   : std::make_unique<CycleWithZone>(a, owned, std::move(zone), std::move(cycle)));
  }
  const LinearReport report = elimination_->factor(system, partition, diagonals);
  if (!report.solved) throw std::invalid_argument(report.reason);
}

// Every process has A_FF^-1, so the right-hand side is gathered first.
Vector BlockPreconditioner::solve_local(Vector owned) const {
  SPREKK_EXPECT(owned.size() == static_cast<Eigen::Index>(local_owned_.size()), owned.size(), local_owned_.size());
  Vector whole = whole_local_.whole(owned);
  elimination_->solve(whole);
  for (std::size_t k = 0; k < local_owned_.size(); ++k) owned[k] = whole[local_owned_[k]];
  return owned;
}

// The rows of `part` of r - A z, over the parts that have a solution so far.
Vector BlockPreconditioner::without_couplings(int part, const Vector& r, const std::vector<Vector>& solutions) const {
  Vector rest(owned_rows_[part].size());
  SPREKK_EXPECT(are_indices(owned_rows_[part], r.size()), part, r.size());
  for (Eigen::Index k = 0; k < rest.size(); ++k) rest[k] = r[owned_rows_[part][k]];
  for (const Coupling& coupling : couplings_[part])
    if (coupling.column_part < static_cast<int>(solutions.size()))
      coupling.matrix->subtract_product(solutions[coupling.column_part], rest);
  return rest;
}

void BlockPreconditioner::apply(const Vector& r, Vector& z) const {
  SPREKK_EXPECT(is_finite(r), r.size());
  const int local = static_cast<int>(cycles_.size());
  std::vector<Vector> solutions;
  for (int part = 0; part < local; ++part) {
    // The correction of the local unknowns, as it acts on the rows of this part.
    const Vector rest_local = without_couplings(local, r, solutions);
    Vector rest = without_couplings(part, r, solutions);
    if (local_unknowns_ > 0) {
      const Vector response = solve_local(rest_local);
      for (const Coupling& coupling : couplings_[part])
        if (coupling.column_part == local) coupling.matrix->subtract_product(response, rest);
    }
    solutions.emplace_back(rest.size());
    cycles_[part]->apply(rest, solutions.back());
  }
  Vector last = without_couplings(local, r, solutions);
  if (local_unknowns_ > 0) last = solve_local(std::move(last));
  solutions.push_back(std::move(last));

  z.resize(r.size());
  for (int part = 0; part <= local; ++part)
    for (std::size_t k = 0; k < owned_rows_[part].size(); ++k) z[owned_rows_[part][k]] = solutions[part][k];
}

}  // namespace sprekk
