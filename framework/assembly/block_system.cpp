#include "framework/assembly/block_system.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "framework/field/ownership.hpp"
#include "framework/invariants.hpp"
#include "framework/mesh/geometry.hpp"
#include "framework/parallel/parallel.hpp"

namespace sprekk {

namespace {

/// The positions of entities, m. All entities of one fracture cell are at one point, by which preconditioners group
/// them.
std::vector<Point> places(const Mesh& mesh, Location location) {
  if (location == Location::cell) return mesh.cell_center;
  if (location == Location::face) return mesh.face_center;
  if (location == Location::node) return mesh.nodes;
  std::vector<Point> points;
  if (location == Location::fracture_cell || location == Location::wall)
    for (const FractureCell& cell : mesh.fracture_cells)
      points.insert(points.end(), location == Location::wall ? 2 : 1, cell.center);
  if (location == Location::ridge)
    for (const Ridge& point : mesh.ridges) points.push_back(mesh.fracture_cells[point.cells[0]].center);
  return points;
}

UnknownBlock describe(const Mesh& mesh, const Field& field, int first) {
  UnknownBlock block;
  block.name = field.name();
  block.first = first;
  block.entities = field.entities();
  block.components = field.spec().components;
  block.kind = field.spec().role.kind();
  const std::vector<Point> at = places(mesh, field.spec().location);
  SPREKK_ASSERT(at.empty() || static_cast<int>(at.size()) == block.entities, block.name);
  block.coordinates.resize(dimension, static_cast<Eigen::Index>(at.size()));
  for (std::size_t i = 0; i < at.size(); ++i) block.coordinates.col(static_cast<Eigen::Index>(i)) = at[i];
  return block;
}

template <class T>
bool same_bits(const T* a, const T* b, std::size_t count) {
  return count == 0 || std::memcmp(a, b, count * sizeof(T)) == 0;
}

}  // namespace

BlockSystem::BlockSystem(const Mesh& mesh, std::vector<const Field*> unknowns) : unknowns_(std::move(unknowns)) {
  SPREKK_EXPECT(static_cast<int>(mesh.cell_rank.size()) == mesh.cell_count(), mesh.cell_rank.size(), mesh.cell_count());
  const bool alone = parallel::size() == 1;
  for (const Field* field : unknowns_) {
    first_.push_back(size_);
    first_row_.push_back(static_cast<int>(system_.rows.size()));

    system_.blocks.push_back(describe(mesh, *field, size_));
    const int components = field->spec().components;
    std::vector<char> owned(field->size(), 1);
    if (!alone)
      for (int entity = 0; entity < field->entities(); ++entity)
        if (!is_owned(mesh, field->spec().location, entity))
          for (int c = 0; c < components; ++c) owned[entity * components + c] = 0;
    for (int i = 0; i < field->size(); ++i)
      if (owned[i]) system_.rows.push_back(size_ + i);
    owned_.push_back(std::move(owned));
    size_ += field->size();
  }
  first_row_.push_back(static_cast<int>(system_.rows.size()));
}

bool BlockSystem::Known::has_pattern_of(const Assembly::Block& block) const {
  if (block.row != row || block.column != column || block.number != number) return false;
  if (number != 0) return true;
  const SparseMatrix& other = *block.matrix;
  return entries.nonZeros() == other.nonZeros() &&
         same_bits(entries.outerIndexPtr(), other.outerIndexPtr(), other.outerSize() + 1) &&
         same_bits(entries.innerIndexPtr(), other.innerIndexPtr(), other.nonZeros());
}

bool BlockSystem::Known::has_values_of(const Assembly::Block& block) const {
  const Eigen::Index count = block.weights ? block.weights->size() : 0;
  if (block.factor != factor || count != weights.size()) return false;
  if (count > 0 && !same_bits(weights.data(), block.weights->data(), count)) return false;
  return number != 0 || same_bits(entries.valuePtr(), block.matrix->valuePtr(), entries.nonZeros());
}

void BlockSystem::remember(const Assembly& assembly) {
  known_.clear();
  for (const Assembly::Block& block : assembly.blocks())
    known_.push_back({block.row, block.column, block.factor, block.weights ? *block.weights : Vector(), block.number,
                      block.number == 0 ? *block.matrix : SparseMatrix()});
  fixed_.clear();
  for (const Assembly::Fixed& fixed : assembly.fixed())
    fixed_.emplace_back(first_[fixed.unknown] + fixed.row, fixed.scale);
}

bool BlockSystem::has_same_fixed(const Assembly& assembly) const {
  return std::equal(fixed_.begin(), fixed_.end(), assembly.fixed().begin(), assembly.fixed().end(),
                    [this](const auto& known, const Assembly::Fixed& fixed) {
                      return known.first == first_[fixed.unknown] + fixed.row && known.second == fixed.scale;
                    });
}

/// Marks the blocks whose rows may be balances: the declared ones, or all where no part declares balances.
void BlockSystem::mark_balances(const Assembly& assembly) {
  const std::vector<Balances::Quantity>& quantities = assembly.balances().quantities();
  for (UnknownBlock& block : system_.blocks) block.may_store = quantities.empty();
  for (const Balances::Quantity& quantity : quantities)
    for (const int unknown : quantity.unknowns) system_.blocks[unknown].may_store = true;
}

void BlockSystem::build_pattern(const Assembly& assembly) {
  ++patterns_built_;
  mark_balances(assembly);
  /// A block of a row, with the place of its next entry among all destinations.
  struct Source {
    const Assembly::Block* block;
    std::size_t next;
  };
  std::vector<std::vector<Source>> by_row(unknowns_.size());
  std::size_t entries = 0;
  first_destinations_.clear();
  for (const Assembly::Block& block : assembly.blocks()) {
    first_destinations_.push_back(entries);
    by_row[block.row].push_back({&block, entries});
    for (int r = 0; r < block.matrix->outerSize(); ++r)
      if (owned_[block.row][r]) entries += block.matrix->outerIndexPtr()[r + 1] - block.matrix->outerIndexPtr()[r];
  }
  destinations_.resize(entries);

  const int local_rows = static_cast<int>(system_.rows.size());
  SPREKK_EXPECT(assembly.unknowns().size() == unknowns_.size(), assembly.unknowns().size(), unknowns_.size());
  std::vector<int> outer{0}, inner, place(size_);
  std::vector<int> seen_in(size_, -1);
  outer.reserve(local_rows + 1);
  inner.reserve(entries);
  for (std::size_t u = 0; u < unknowns_.size(); ++u) {
    std::vector<Source>& sources = by_row[u];
    // Takes the column fields from left to right: then only the entries of one field need sorting, and most of them are
    // sorted already.
    std::vector<Source*> ordered;
    for (Source& source : sources) ordered.push_back(&source);
    std::stable_sort(ordered.begin(), ordered.end(),
                     [](const Source* a, const Source* b) { return a->block->column < b->block->column; });
    for (int r = 0; r < unknowns_[u]->size(); ++r) {
      if (!owned_[u][r]) continue;
      const int local = static_cast<int>(outer.size()) - 1;
      for (std::size_t i = 0; i < ordered.size();) {
        const int field = ordered[i]->block->column, start = static_cast<int>(inner.size());
        for (; i < ordered.size() && ordered[i]->block->column == field; ++i)
          for (SparseMatrix::InnerIterator entry(*ordered[i]->block->matrix, r); entry; ++entry) {
            const int column = first_[field] + static_cast<int>(entry.col());
            if (seen_in[column] == local) continue;
            seen_in[column] = local;
            inner.push_back(column);
          }
        if (!std::is_sorted(inner.begin() + start, inner.end())) std::sort(inner.begin() + start, inner.end());
      }
      for (std::size_t k = outer.back(); k < inner.size(); ++k) place[inner[k]] = static_cast<int>(k);
      outer.push_back(static_cast<int>(inner.size()));
      for (Source& source : sources)
        for (SparseMatrix::InnerIterator entry(*source.block->matrix, r); entry; ++entry)
          destinations_[source.next++] = place[first_[source.block->column] + static_cast<int>(entry.col())];
    }
  }
  SparseMatrix& local = system_.local;
  SPREKK_ASSERT(static_cast<int>(outer.size()) == local_rows + 1, outer.size(), local_rows);
  SPREKK_ASSERT(are_indices(inner, size_), size_);
  SPREKK_ASSERT(are_indices(destinations_, static_cast<long>(inner.size())), inner.size());
  local.resize(local_rows, size_);
  local.resizeNonZeros(inner.size());
  std::copy(outer.begin(), outer.end(), local.outerIndexPtr());
  std::copy(inner.begin(), inner.end(), local.innerIndexPtr());
}

std::vector<char> BlockSystem::known_rows(const Assembly& assembly) const {
  std::vector<char> known(unknowns_.size(), has_same_fixed(assembly));
  for (std::size_t i = 0; i < known_.size(); ++i)
    if (!known_[i].has_values_of(assembly.blocks()[i])) known[known_[i].row] = false;
  return known;
}

int BlockSystem::unknown_with_sum(const Assembly& assembly, const Balances::Quantity& quantity) const {
  const int row = row_to_replace(assembly, quantity, owned_, first_);
  SPREKK_ASSERT(is_index(row, size_), quantity.name, row, size_);
  return static_cast<int>(std::upper_bound(first_.begin(), first_.end(), row) - first_.begin()) - 1;
}

std::string BlockSystem::describe_floating(const Assembly& assembly, Floating told) const {
  const std::vector<FloatingBalances> all = floating_balances(assembly, owned_, first_, told);
  if (all.empty()) return "";
  const FloatingBalances& one = all.front();
  const auto block = std::ranges::find_if(system_.blocks, [&](const UnknownBlock& other) {
    return one.first >= other.first && one.first < other.first + other.entities * other.components;
  });
  SPREKK_ASSERT(block != system_.blocks.end(), one.first);
  const std::string where =
      block->has_coordinates() ? " around " + to_text(Point(block->coordinates.col(one.first - block->first))) : "";
  return fmt::format(
      "nothing holds {}{} ({} {} of {} store{} nothing, and nothing leads from there to a given value: any constant "
      "may "
      "be added) let something be stored there, or give a value to which it leads",
      block->name, where, one.balances, one.balances == 1 ? "balance" : "balances",
      assembly.balances().quantities()[one.quantity].name, one.balances == 1 ? "s" : "");
}

const LinearSystem& BlockSystem::matrix(const Assembly& assembly) {
  SPREKK_EXPECT(assembly.wants_derivatives());
  const std::vector<Assembly::Block>& blocks = assembly.blocks();
  const bool same_pattern =
      !parallel::any(patterns_built_ == 0 || !std::equal(known_.begin(), known_.end(), blocks.begin(), blocks.end(),
                                                         [](const Known& known, const Assembly::Block& block) {
                                                           return known.has_pattern_of(block);
                                                         }));
  std::vector<char> stays(unknowns_.size(), false);
  if (same_pattern) {
    stays = known_rows(assembly);
    // The rest is collective, and rows may change on some processes only (of a side that lets fluid out there).
    const bool one_changes = std::any_of(stays.begin(), stays.end(), [](char stay) { return !stay; });
    if (!parallel::any(one_changes || system_.number == 0)) return sums_.with_sums(system_);
  } else {
    build_pattern(assembly);
    system_.pattern_number = new_system_number();
  }
  remember(assembly);
  system_.number = new_system_number();
  double* values = system_.local.valuePtr();
  const int* outer = system_.local.outerIndexPtr();
  for (std::size_t u = 0; u < unknowns_.size(); ++u)
    if (!stays[u]) std::fill(values + outer[first_row_[u]], values + outer[first_row_[u + 1]], 0.0);
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    const Assembly::Block& block = blocks[b];
    if (stays[block.row]) continue;
    std::size_t k = first_destinations_[b];
    for (int r = 0; r < block.matrix->outerSize(); ++r) {
      if (!owned_[block.row][r]) continue;
      const double scale = block.weights ? block.factor * (*block.weights)[r] : block.factor;
      for (SparseMatrix::InnerIterator entry(*block.matrix, r); entry; ++entry)
        values[destinations_[k++]] += scale * entry.value();
    }
  }
  apply_fixed(assembly);
  SPREKK_ASSERT(is_well_formed(system_.local), system_.local.rows(), system_.local.cols());
  sums_.put_into(system_, assembly, owned_, first_);
  return sums_.with_sums(system_);
}

void BlockSystem::use_coupled_sums(bool wanted) {
  if (sums_.are_used_where_coupled == wanted) return;
  sums_.are_used_where_coupled = wanted;
  system_.number = 0;  // the next matrix differs from the last one even if its blocks are the same
}

void BlockSystem::apply_fixed(const Assembly& assembly) {
  for (const Assembly::Fixed& fixed : assembly.fixed()) {
    SPREKK_ASSERT(is_index(fixed.unknown, static_cast<long>(owned_.size())), fixed.unknown);
    SPREKK_ASSERT(is_index(fixed.row, static_cast<long>(owned_[fixed.unknown].size())), fixed.unknown, fixed.row);
    if (!owned_[fixed.unknown][fixed.row]) continue;
    const int unknown = first_[fixed.unknown] + fixed.row;
    const auto row = std::lower_bound(system_.rows.begin(), system_.rows.end(), unknown) - system_.rows.begin();
    for (SparseMatrix::InnerIterator entry(system_.local, row); entry; ++entry)
      entry.valueRef() = entry.col() == unknown ? fixed.scale : 0;
  }
}

Vector BlockSystem::residual(const Assembly& assembly) const {
  Vector residual(system_.rows.size());
  int next = 0;
  for (std::size_t u = 0; u < unknowns_.size(); ++u) {
    const Vector& values = assembly.residual(static_cast<int>(u));
    SPREKK_ASSERT(values.size() == unknowns_[u]->size(), unknowns_[u]->name(), values.size());
    if (residual.size() == size_) {
      residual.segment(first_[u], values.size()) = values;
      continue;
    }
    for (int r = 0; r < values.size(); ++r)
      if (owned_[u][r]) residual[next++] = values[r];
  }
  return residual;
}

void BlockSystem::set_stabilization(const Field& field, const Vector& diagonal) {
  SPREKK_EXPECT(diagonal.size() == field.size(), field.name(), diagonal.size(), field.size());
  SPREKK_EXPECT(is_finite(diagonal), field.name());
  for (UnknownBlock& block : system_.blocks) {
    if (block.name != field.name() ||
        (block.stabilization.size() == diagonal.size() && block.stabilization == diagonal))
      continue;
    block.stabilization = diagonal;
    system_.number = 0;
  }
}

}  // namespace sprekk
