#include "framework/linear/iterative/local_elimination.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <stdexcept>
#include <string>
#include <vector>

#include "framework/dense/lu.hpp"
#include "framework/invariants.hpp"
#include "framework/linear/expect_sound.hpp"
#include "framework/linear/gather_entries.hpp"
#include "framework/linear/iterative/sparse_product.hpp"
#include "framework/matrix_of.hpp"
#include "framework/parallel/parallel.hpp"
#include "framework/round_off.hpp"

namespace sprekk {
namespace {

// Local unknowns of one fracture cell share a key: its centre (to a small part of the fractures' extent), or for blocks
// without coordinates the number of the entity among blocks of the same length.
using CellKey = std::vector<long long>;

std::vector<std::vector<int>> unknowns_by_cell(const LinearSystem& system, const Partition& partition) {
  Vector low, high;
  for (const UnknownBlock& block : system.blocks) {
    if (!block.has_coordinates()) continue;
    const Vector lowest = block.coordinates.rowwise().minCoeff(), highest = block.coordinates.rowwise().maxCoeff();
    low = low.size() == 0 ? lowest : low.cwiseMin(lowest);
    high = high.size() == 0 ? highest : high.cwiseMax(highest);
  }
  const double spacing = low.size() == 0 ? 0 : (high - low).maxCoeff() * rounding::half_of_digits;

  std::map<CellKey, std::vector<int>> cells;
  const int local = static_cast<int>(partition.parts.size()) - 1;
  const std::vector<int>& unknowns = partition.local().unknowns;
  std::vector<bool> is_placed(unknowns.size(), false);
  for (const UnknownBlock& block : system.blocks) {
    if (block.kind != BlockKind::interface) continue;
    const bool has_places = block.has_coordinates() && spacing > 0;
    for (int entity = 0; entity < block.entities; ++entity) {
      CellKey key{-1, block.entities, entity};
      if (has_places) {
        key = {0};
        for (int axis = 0; axis < low.size(); ++axis)
          key.push_back(std::llround((block.coordinates(axis, entity) - low[axis]) / spacing));
      }
      for (int c = 0; c < block.components; ++c) {
        const int unknown = block.first + entity * block.components + c;
        if (partition.part_of[unknown] != local) continue;
        const int place = partition.place_of[unknown];
        cells[key].push_back(place);
        is_placed[place] = true;
      }
    }
  }
  std::vector<std::vector<int>> groups;
  for (auto& [key, members] : cells) groups.push_back(std::move(members));
  for (int place = 0; place < static_cast<int>(unknowns.size()); ++place)
    if (!is_placed[place]) groups.push_back({place});
  return groups;
}

// The inverse of a small matrix whose rows and columns have different units; zero if it is singular.
Eigen::MatrixXd inverse_or_zero(Eigen::MatrixXd a) {
  SPREKK_EXPECT(a.rows() == a.cols() && a.rows() > 0, a.rows(), a.cols());
  const Vector row_size = a.cwiseAbs().rowwise().maxCoeff();
  if (row_size.minCoeff() == 0) return Eigen::MatrixXd::Zero(a.rows(), a.cols());
  a = row_size.cwiseInverse().asDiagonal() * a;
  const Vector column_size = a.cwiseAbs().colwise().maxCoeff();
  if (column_size.minCoeff() == 0) return Eigen::MatrixXd::Zero(a.rows(), a.cols());
  a = a * column_size.cwiseInverse().asDiagonal();
  const FullPivotingLu lu(a);
  if (!lu.is_invertible()) return Eigen::MatrixXd::Zero(a.rows(), a.cols());
  return column_size.cwiseInverse().asDiagonal() * lu.inverse() * row_size.cwiseInverse().asDiagonal();
}

// The rows of the local unknowns of all processes.
SparseMatrix gather_local_rows(const LinearSystem& system, const Partition& partition) {
  const SystemPart& local = partition.local();
  std::vector<Triplet> entries;
  for (std::size_t k = 0; k < local.owned.size(); ++k)
    for (SparseMatrix::InnerIterator entry(system.local, local.owned_rows[k]); entry; ++entry)
      entries.emplace_back(local.owned[k], static_cast<int>(entry.col()), entry.value());
  return gather_entries(entries, static_cast<int>(local.unknowns.size()), static_cast<int>(system.local.cols()));
}

// The columns of rows that belong to a part. Unknowns of a part are in ascending order, and so are their places.
SparseMatrix columns_of_part(const SparseMatrix& rows, const std::vector<int>& wanted, const Partition& partition,
                             int part) {
  const auto is_of_part = [&](Eigen::Index column) { return partition.part_of[column] == part; };
  Eigen::VectorXi lengths(wanted.size());
  for (std::size_t k = 0; k < wanted.size(); ++k) {
    lengths[k] = 0;
    for (SparseMatrix::InnerIterator entry(rows, wanted[k]); entry; ++entry) lengths[k] += is_of_part(entry.col());
  }
  SparseMatrix result(static_cast<int>(wanted.size()), static_cast<int>(partition.parts[part].unknowns.size()));
  result.reserve(lengths.sum());
  for (std::size_t k = 0; k < wanted.size(); ++k) {
    result.startVec(static_cast<int>(k));
    for (SparseMatrix::InnerIterator entry(rows, wanted[k]); entry; ++entry)
      if (is_of_part(entry.col()))
        result.insertBack(static_cast<int>(k), partition.place_of[entry.col()]) = entry.value();
  }
  result.finalize();
  return result;
}

std::vector<int> all_rows(const SparseMatrix& rows) {
  std::vector<int> all(rows.rows());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

using Blocks = std::vector<const UnknownBlock*>;

std::string owner_of(const UnknownBlock& block) { return block.name.substr(0, block.name.find('.')); }

bool is_kind(const UnknownBlock& block, BlockKind kind) { return block.kind == kind && block.entities > 0; }

/// Whether displacements have three components. In a plane there are few unknowns on fractures, and to eliminate them
/// is as good as a multigrid that has them, at less cost.
bool are_in_space(const UnknownBlock& block) {
  return is_kind(block, BlockKind::bulk_elastic) && block.components == 3;
}

/// Whether the translations of `moving` leave the unknowns of `other` at zero, as those of middles of edges that are
/// counted from the mean of their ends: the rows of `other` then have no force from them. Collective.
bool rests_with(const LinearSystem& system, const UnknownBlock& moving, const UnknownBlock& other) {
  const int components = other.components;
  const auto is_of = [](const UnknownBlock& block, Eigen::Index unknown) {
    return unknown >= block.first && unknown < block.first + block.entities * block.components;
  };
  Vector forces = Vector::Zero(2);  // where `other` rests, and where it moves along
  for (std::size_t row = 0; row < system.rows.size(); ++row) {
    if (!is_of(other, system.rows[row])) continue;
    Vector resting = Vector::Zero(components), along = resting;
    for (SparseMatrix::InnerIterator entry(system.local, static_cast<int>(row)); entry; ++entry) {
      if (is_of(moving, entry.col())) resting[(entry.col() - moving.first) % components] += entry.value();
      if (is_of(other, entry.col())) along[(entry.col() - other.first) % components] += entry.value();
    }
    forces[0] += resting.lpNorm<1>();
    forces[1] += (resting + along).lpNorm<1>();
  }
  parallel::sum(forces);
  return forces[0] < forces[1];
}

/// Whether a block of displacements refines an earlier block of the same owner at a few places, such as tips. Such a
/// block is eliminated together with the unknowns on fractures.
bool refines_few(const LinearSystem& system, const UnknownBlock& block) {
  if (!are_in_space(block)) return false;
  for (const UnknownBlock& first : system.blocks) {
    if (&first == &block) return false;
    if (is_kind(first, BlockKind::bulk_elastic) && owner_of(first) == owner_of(block) &&
        first.components == block.components)
      return block.entities < first.entities && rests_with(system, first, block);
  }
  return false;
}

// The blocks of each part of the bulk: elliptic ones first. A multigrid has the potentials of one owner with those on
// fractures, but beside deformation in a plane.
std::vector<Blocks> blocks_of_parts(const LinearSystem& system) {
  std::vector<Blocks> parts;
  for (const UnknownBlock& block : system.blocks)
    if (is_kind(block, BlockKind::bulk_elliptic)) parts.push_back({&block});
  const bool is_of_one_owner =
      std::ranges::all_of(parts, [&](const Blocks& part) { return owner_of(*part[0]) == owner_of(*parts[0][0]); });
  const bool deforms_in_plane = std::ranges::any_of(system.blocks, [](const UnknownBlock& block) {
    return is_kind(block, BlockKind::bulk_elastic) && !are_in_space(block);
  });
  if (!parts.empty() && is_of_one_owner && !deforms_in_plane) {
    Blocks potentials;
    for (const Blocks& part : parts) potentials.push_back(part[0]);
    for (const UnknownBlock& block : system.blocks)
      if (is_kind(block, BlockKind::interface) && block.components == 1 && block.may_store)
        potentials.push_back(&block);
    parts = {potentials};
  }
  for (const UnknownBlock& block : system.blocks)
    if (is_kind(block, BlockKind::bulk_elastic) && !refines_few(system, block)) parts.push_back({&block});
  return parts;
}

// What a multigrid may know of a part.
UnknownBlock joined(const Blocks& blocks, const std::vector<int>& place_of) {
  if (blocks.size() == 1) return *blocks[0];
  UnknownBlock whole;
  whole.kind = blocks[0]->kind;
  for (const UnknownBlock* block : blocks) {
    whole.name += (whole.name.empty() ? "" : ", ") + block->name;
    whole.entities += block->entities;
  }
  const Eigen::Index axes = blocks[0]->coordinates.rows();
  const bool have_places = std::ranges::all_of(
      blocks, [&](const UnknownBlock* block) { return block->has_coordinates() && block->coordinates.rows() == axes; });
  if (have_places) whole.coordinates.resize(axes, whole.entities);
  if (std::ranges::any_of(blocks, [](const UnknownBlock* block) { return block->stabilization.size() > 0; }))
    whole.stabilization = Vector::Zero(whole.entities);
  for (const UnknownBlock* block : blocks)
    for (int entity = 0; entity < block->entities; ++entity) {
      const int place = place_of[block->first + entity];
      if (have_places) whole.coordinates.col(place) = block->coordinates.col(entity);
      if (block->stabilization.size() > 0) whole.stabilization[place] = block->stabilization[entity];
    }
  return whole;
}

}  // namespace

Partition::Partition(const LinearSystem& system) : part_of(system.local.cols(), -1), place_of(system.local.cols(), 0) {
  expect_sound(system);
  const std::vector<Blocks> blocks = blocks_of_parts(system);
  for (std::size_t part = 0; part < blocks.size(); ++part)
    for (const UnknownBlock* block : blocks[part])
      std::fill_n(part_of.begin() + block->first, block->entities * block->components, part);
  parts.resize(blocks.size() + 1);
  for (std::size_t unknown = 0; unknown < part_of.size(); ++unknown) {
    if (part_of[unknown] < 0) part_of[unknown] = static_cast<int>(blocks.size());
    std::vector<int>& members = parts[part_of[unknown]].unknowns;
    place_of[unknown] = static_cast<int>(members.size());
    members.push_back(static_cast<int>(unknown));
  }
  for (std::size_t part = 0; part < blocks.size(); ++part) {
    parts[part].block = joined(blocks[part], place_of);
    parts[part].has_fractures = blocks[part].back()->kind == BlockKind::interface;
  }
  for (std::size_t row = 0; row < system.rows.size(); ++row) {
    SystemPart& part = parts[part_of[system.rows[row]]];
    part.owned.push_back(place_of[system.rows[row]]);
    part.owned_rows.push_back(static_cast<int>(row));
  }
}

SparseMatrix sub_matrix(const SparseMatrix& owned_rows, const Partition& partition, int rows, int columns) {
  SPREKK_EXPECT(is_index(rows, static_cast<long>(partition.parts.size())), rows);
  SPREKK_EXPECT(is_index(columns, static_cast<long>(partition.parts.size())), columns);
  SPREKK_EXPECT(are_indices(partition.parts[rows].owned_rows, owned_rows.rows()), owned_rows.rows());
  return columns_of_part(owned_rows, partition.parts[rows].owned_rows, partition, columns);
}

LocalElimination::LocalElimination(const LinearSystem& system, const Partition& partition) {
  const int unknowns = static_cast<int>(partition.local().unknowns.size());
  if (unknowns == 0) return;
  rows_ = gather_local_rows(system, partition);
  local_ = columns_of_part(rows_, all_rows(rows_), partition, static_cast<int>(partition.parts.size()) - 1);
  std::vector<Triplet> inverses;
  const std::vector<char> is_with_refining = with_refining(system, partition);
  for (const std::vector<int>& cell : unknowns_by_cell(system, partition)) {
    if (std::ranges::any_of(cell, [&](int place) { return is_with_refining[place] != 0; })) {
      together_.insert(together_.end(), cell.begin(), cell.end());
      continue;
    }
    const int size = static_cast<int>(cell.size());
    Eigen::MatrixXd block(size, size);
    for (int i = 0; i < size; ++i)
      for (int j = 0; j < size; ++j) block(i, j) = local_.coeff(cell[i], cell[j]);
    block = inverse_or_zero(block);
    for (int i = 0; i < size; ++i)
      for (int j = 0; j < size; ++j)
        if (block(i, j) != 0) inverses.emplace_back(cell[i], cell[j], block(i, j));
  }
  cell_inverses_ = matrix_of(unknowns, unknowns, inverses);
  std::sort(together_.begin(), together_.end());
}

// Of local unknowns: those that refine displacements of the bulk, and those whose rows have one.
std::vector<char> LocalElimination::with_refining(const LinearSystem& system, const Partition& partition) const {
  const int unknowns = static_cast<int>(partition.local().unknowns.size());
  const int local = static_cast<int>(partition.parts.size()) - 1;
  std::vector<char> refines(unknowns, 0);
  for (const UnknownBlock& block : system.blocks) {
    if (!is_kind(block, BlockKind::bulk_elastic) || partition.part_of[block.first] < local) continue;
    for (int k = 0; k < block.entities * block.components; ++k) refines[partition.place_of[block.first + k]] = 1;
  }
  std::vector<char> with = refines;
  for (int row = 0; row < unknowns; ++row)
    for (SparseMatrix::InnerIterator entry(local_, row); entry; ++entry)
      if (refines[entry.col()] && entry.value() != 0) with[row] = 1;
  return with;
}

// Of A_FB, rows of `together_`: the answers of these unknowns, and of no others, to each column.
std::vector<Triplet> LocalElimination::answers_together(const SparseMatrix& columns) {
  std::vector<Triplet> answers;
  if (together_.empty()) return answers;
  const int size = static_cast<int>(together_.size());
  if (!has_factors_) {
    std::vector<int> place(local_.cols(), -1);
    for (int k = 0; k < size; ++k) place[together_[k]] = k;
    std::vector<Triplet> entries;
    for (int k = 0; k < size; ++k)
      for (SparseMatrix::InnerIterator entry(local_, together_[k]); entry; ++entry)
        if (place[entry.col()] >= 0) entries.emplace_back(k, place[entry.col()], entry.value());
    LinearSystem alone;
    alone.local = matrix_of(size, size, entries);
    alone.rows.resize(size);
    std::iota(alone.rows.begin(), alone.rows.end(), 0);
    const LinearReport report = together_solver_.factor(alone);
    if (!report.solved)
      throw std::invalid_argument("the preconditioner cannot eliminate the unknowns at tips (" + report.reason + ")");
    has_factors_ = true;
  }
  std::vector<Triplet> sources;
  for (int k = 0; k < size; ++k)
    for (SparseMatrix::InnerIterator entry(columns, together_[k]); entry; ++entry)
      sources.emplace_back(static_cast<int>(entry.col()), k, entry.value());
  const SparseMatrix by_column = matrix_of(columns.cols(), size, sources);
  for (int column = 0; column < by_column.rows(); ++column) {
    if (by_column.outerIndexPtr()[column] == by_column.outerIndexPtr()[column + 1]) continue;
    Vector answer = Vector::Zero(size);
    for (SparseMatrix::InnerIterator entry(by_column, column); entry; ++entry) answer[entry.col()] = entry.value();
    together_solver_.solve_unchecked(answer);
    for (int k = 0; k < size; ++k)
      if (answer[k] != 0) answers.emplace_back(together_[k], column, answer[k]);
  }
  return answers;
}

LinearReport LocalElimination::factor(const LinearSystem& system, const Partition& partition,
                                      const std::vector<Vector>& diagonals) {
  const int unknowns = static_cast<int>(partition.local().unknowns.size());
  if (unknowns == 0) return LinearReport::success();
  const int local = static_cast<int>(partition.parts.size()) - 1;
  const Vector sizes = local_.cwiseAbs() * Vector::Ones(unknowns);
  std::vector<char> is_missing(unknowns);
  for (int row = 0; row < unknowns; ++row) is_missing[row] = sizes[row] == 0;
  Vector of_schur = Vector::Zero(unknowns);
  for (int part = 0; part < local; ++part) {
    const SparseMatrix from_local = sub_matrix(system.local, partition, part, local);
    const SystemPart& of = partition.parts[part];
    for (int k = 0; k < from_local.rows(); ++k)
      for (SparseMatrix::InnerIterator entry(from_local, k); entry; ++entry) {
        if (!is_missing[entry.col()]) continue;
        const double own = diagonals[part][k];
        if (own != 0) of_schur[entry.col()] -= rows_.coeff(entry.col(), of.unknowns[of.owned[k]]) * entry.value() / own;
      }
  }
  parallel::sum(of_schur);

  LinearSystem alone;
  alone.local = local_;
  for (int row = 0; row < unknowns; ++row)
    if (of_schur[row] != 0) alone.local.coeffRef(row, row) = of_schur[row];
  alone.local.makeCompressed();
  alone.rows.resize(unknowns);
  for (int place = 0; place < unknowns; ++place) alone.rows[place] = place;
  LinearReport report = solver_.factor(alone);
  if (!report.solved)
    report.reason = "the preconditioner cannot eliminate the unknowns on the fractures (" + report.reason + ")";
  return report;
}

SparseMatrix LocalElimination::correction(const LinearSystem& system, const Partition& partition, int bulk) {
  const int local = static_cast<int>(partition.parts.size()) - 1;
  const SparseMatrix bulk_from_local = sub_matrix(system.local, partition, bulk, local);
  if (partition.local().unknowns.empty())
    return SparseMatrix(bulk_from_local.rows(), static_cast<int>(partition.parts[bulk].unknowns.size()));
  const SparseMatrix from_bulk = columns_of_part(rows_, all_rows(rows_), partition, bulk);
  SparseMatrix product = sparse_product(bulk_from_local, sparse_product(cell_inverses_, from_bulk));
  const std::vector<Triplet> answers = answers_together(from_bulk);
  if (!answers.empty()) {
    const SparseMatrix together = matrix_of(from_bulk.rows(), from_bulk.cols(), answers);
    product += SparseMatrix(bulk_from_local * together);
  }
  product *= -1.0;
  return product;
}

std::vector<int> LocalElimination::beside(const Partition& partition, int bulk) const {
  std::vector<char> is_beside(partition.parts[bulk].unknowns.size(), 0);
  for (int row = 0; row < rows_.rows(); ++row)
    for (SparseMatrix::InnerIterator entry(rows_, row); entry; ++entry)
      if (partition.part_of[entry.col()] == bulk && entry.value() != 0) is_beside[partition.place_of[entry.col()]] = 1;
  std::vector<int> places;
  for (int place = 0; place < static_cast<int>(is_beside.size()); ++place)
    if (is_beside[place]) places.push_back(place);
  return places;
}

}  // namespace sprekk
