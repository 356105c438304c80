#include "framework/linear/iterative/local_elimination.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <string>
#include <vector>

#include "framework/dense/lu.hpp"
#include "framework/invariants.hpp"
#include "framework/linear/expect_sound.hpp"
#include "framework/linear/gather_entries.hpp"
#include "framework/parallel/parallel.hpp"

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
  constexpr double same_place = 1e-8;  // of the extent of the fractures: far below a cell
  const double spacing = low.size() == 0 ? 0 : (high - low).maxCoeff() * same_place;

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

// The blocks of each part of the bulk.
std::vector<Blocks> blocks_of_parts(const LinearSystem& system) {
  std::vector<Blocks> parts;
  for (const auto kind : {BlockKind::bulk_elliptic, BlockKind::bulk_elastic})
    for (const UnknownBlock& block : system.blocks)
      if (block.kind == kind && block.entities > 0) parts.push_back({&block});
  const auto is_of_first_owner = [&](const Blocks& part) {
    return part[0]->kind == BlockKind::bulk_elliptic && owner_of(*part[0]) == owner_of(*parts[0][0]);
  };
  if (parts.empty() || !std::ranges::all_of(parts, is_of_first_owner)) return parts;
  Blocks potentials;
  for (const Blocks& part : parts) potentials.push_back(part[0]);
  for (const UnknownBlock& block : system.blocks)
    if (block.kind == BlockKind::interface && block.components == 1 && block.may_store && block.entities > 0)
      potentials.push_back(&block);
  return {potentials};
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
  for (std::size_t part = 0; part < blocks.size(); ++part) parts[part].block = joined(blocks[part], place_of);
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
  for (const std::vector<int>& cell : unknowns_by_cell(system, partition)) {
    const int size = static_cast<int>(cell.size());
    Eigen::MatrixXd block(size, size);
    for (int i = 0; i < size; ++i)
      for (int j = 0; j < size; ++j) block(i, j) = local_.coeff(cell[i], cell[j]);
    block = inverse_or_zero(block);
    for (int i = 0; i < size; ++i)
      for (int j = 0; j < size; ++j)
        if (block(i, j) != 0) inverses.emplace_back(cell[i], cell[j], block(i, j));
  }
  cell_inverses_ = SparseMatrix(unknowns, unknowns);
  cell_inverses_.setFromTriplets(inverses.begin(), inverses.end());
}

LinearReport LocalElimination::factor(const LinearSystem& system, const Partition& partition,
                                      const std::vector<SparseMatrix>& bulk) {
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
        const double own = bulk[part].coeff(k, of.owned[k]);
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

SparseMatrix LocalElimination::correction(const LinearSystem& system, const Partition& partition, int bulk) const {
  const int local = static_cast<int>(partition.parts.size()) - 1;
  const SparseMatrix bulk_from_local = sub_matrix(system.local, partition, bulk, local);
  if (partition.local().unknowns.empty())
    return SparseMatrix(bulk_from_local.rows(), static_cast<int>(partition.parts[bulk].unknowns.size()));
  const SparseMatrix weighted = cell_inverses_ * columns_of_part(rows_, all_rows(rows_), partition, bulk);
  SparseMatrix product = bulk_from_local * weighted;
  product *= -1.0;
  return product;
}

}  // namespace sprekk
