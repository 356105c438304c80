#include "framework/linear/reduction/floating_parts.hpp"

#include <Eigen/QR>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

#include "framework/invariants.hpp"
#include "framework/joined_sets.hpp"
#include "framework/linear/expect_sound.hpp"
#include "framework/linear/rigid_rotations.hpp"
#include "framework/parallel/parallel.hpp"
#include "framework/round_off.hpp"

namespace sprekk {
namespace {

constexpr int most_modes = most_axes + most_rotations;
using Modes = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, most_modes, most_modes>;
using OfMode = Eigen::Matrix<double, 1, Eigen::Dynamic, Eigen::RowMajor, 1, most_modes>;

/// A connected set of entities, and the null space that it may have: a constant, or rigid motions.
struct Part {
  std::vector<int> entities;
  Coordinates centre;
  double radius = 0;  ///< largest distance from the centre; 0 where nothing can turn
  int modes = 0;
  Modes triangle;  ///< R^T R = sum of w^T w over the balances, w = residuals of the modes over the size of the terms
  int balances = 0;
  bool is_held = false;  ///< the balances so far resist all modes, and further ones cannot change that
};

class Parts {
 public:
  Parts(const LinearSystem& system, const UnknownBlock& block, const std::vector<char>& is_balance)
      : block_(block),
        a_(system.local),
        rows_(system.rows),
        entity_of_(system.local.cols(), -1),
        part_of_(block.entities, -1) {
    for (int entity = 0; entity < block.entities; ++entity)
      std::fill_n(entity_of_.begin() + block.first + entity * block.components, block.components, entity);
    find(is_balance);
    for (Part& part : parts_) prepare(part);
    for (int row = 0; row < a_.rows(); ++row)
      if (is_balance[rows_[row]]) take(row);
    if (parallel::size() > 1) take_those_of_all();
  }

  /// Entities that have to be fixed to remove all modes that no balance resists; `preferred` ones first.
  std::vector<int> to_fix(const std::vector<char>& preferred) const {
    SPREKK_EXPECT(static_cast<int>(preferred.size()) == block_.entities, preferred.size(), block_.entities);
    std::vector<int> chosen;
    for (const Part& part : parts_) {
      if (part.is_held) continue;
      constexpr double much_preferred = 1e3;  // larger than ratios of motions by the shapes of parts
      constexpr double is_fixed = 0.1;        // of the largest singular value of an entity's motions
      const Eigen::JacobiSVD<Modes> svd(part.triangle, Eigen::ComputeFullU | Eigen::ComputeFullV);
      const int held = static_cast<int>((svd.singularValues().array() > rounding::half_of_digits).count());
      Modes left = svd.matrixV().rightCols(part.modes - held);
      while (left.cols() > 0) {
        int best = -1;
        double most = rounding::far_above;
        for (const int entity : part.entities) {
          const double moves = (motion(part, entity) * left).norm() * (preferred[entity] ? much_preferred : 1);
          if (moves > most) {
            most = moves;
            best = entity;
          }
        }
        if (best < 0) break;
        chosen.push_back(best);
        const Modes fixed = motion(part, best) * left;
        const Eigen::JacobiSVD<Modes> of_fixed(fixed, Eigen::ComputeFullU | Eigen::ComputeFullV);
        const auto& sizes = of_fixed.singularValues();
        const int rank = static_cast<int>((sizes.array() > is_fixed * sizes[0]).count());
        left = Modes(left * of_fixed.matrixV().rightCols(left.cols() - rank));
      }
    }
    return chosen;
  }

 private:
  /// Joins the entities that have entries in one row.
  void find(const std::vector<char>& is_balance) {
    JoinedSets sets(block_.entities);
    for (int row = 0; row < a_.rows(); ++row) {
      if (!is_balance[rows_[row]]) continue;
      int joined = entity_of_[rows_[row]];
      for (SparseMatrix::InnerIterator entry(a_, row); entry; ++entry) {
        const int entity = entry.value() == 0 ? -1 : entity_of_[entry.col()];
        if (entity < 0) continue;
        if (joined >= 0) sets.join(entity, joined);
        joined = entity;
      }
    }
    join_those_of_all(sets);
    for (int entity = 0; entity < block_.entities; ++entity) {
      int& number = part_of_[sets.root(entity)];
      if (number < 0) {
        number = static_cast<int>(parts_.size());
        parts_.emplace_back();
      }
      part_of_[entity] = number;
      parts_[number].entities.push_back(entity);
    }
  }

  /// Joins what rows of other processes join.
  void join_those_of_all(JoinedSets& sets) const {
    if (parallel::size() == 1) return;
    std::vector<int> pairs;
    for (int entity = 0; entity < block_.entities; ++entity)
      if (sets.root(entity) != entity) pairs.insert(pairs.end(), {entity, sets.root(entity)});
    pairs = parallel::gather(pairs);
    for (std::size_t k = 0; k < pairs.size(); k += 2) sets.join(pairs[k], pairs[k + 1]);
  }

  void prepare(Part& part) {
    part.modes = block_.components;
    if (block_.can_turn()) {
      part.centre = Coordinates::Zero(block_.components);
      for (const int entity : part.entities) part.centre += block_.coordinates.col(entity) / part.entities.size();
      for (const int entity : part.entities)
        part.radius = std::max(part.radius, (block_.coordinates.col(entity) - part.centre).norm());
    }
    if (part.entities.size() > 1 && part.radius > 0) part.modes += rigid_rotations(block_.components);
    part.triangle = Modes::Zero(part.modes, part.modes);
  }

  /// How the modes move an entity, a row for each component.
  Modes motion(const Part& part, int entity) const {
    Modes motion = Modes::Zero(block_.components, part.modes);
    motion.leftCols(block_.components).setIdentity();
    if (part.modes > block_.components) {
      const Rotations rotations = rotated((block_.coordinates.col(entity) - part.centre) / part.radius);
      motion.rightCols(rotations.cols()) = rotations;
    }
    return motion;
  }

  void take(int row) {
    OfMode w;
    double size = 0;
    Part* part = nullptr;
    SPREKK_EXPECT(is_index(row, a_.rows()), row, a_.rows());
    for (SparseMatrix::InnerIterator entry(a_, row); entry; ++entry) {
      const int entity = entry.value() == 0 ? -1 : entity_of_[entry.col()];
      if (entity < 0) continue;
      if (part == nullptr) {
        part = &parts_[part_of_[entity]];
        if (part->is_held) return;
        w = OfMode::Zero(part->modes);
      }
      const int component = static_cast<int>(entry.col()) - block_.first - entity * block_.components;
      w[component] += entry.value();
      if (part->modes > block_.components) {
        const Rotations motions = rotated(block_.coordinates.col(entity) - part->centre);
        for (int k = 0; k < motions.cols(); ++k)
          w[block_.components + k] += entry.value() * motions(component, k) / part->radius;
      }
      size += std::abs(entry.value());
    }
    if (part == nullptr || size == 0) return;
    add(w / size, part->triangle);
    constexpr int between_looks = 32;  // balances: a look is cheap beside them
    if (++part->balances % between_looks == 0)
      part->is_held = Eigen::JacobiSVD<Modes>(part->triangle).singularValues().minCoeff() > rounding::half_of_digits;
  }

  /// R^T R grows by w^T w. Givens rotations keep small motions apart from large ones, where a matrix of products would
  /// lose them.
  static void add(OfMode w, Modes& r) {
    for (Eigen::Index k = 0; k < r.rows(); ++k) {
      const double length = std::hypot(r(k, k), w[k]);
      if (length == 0) continue;
      const double c = r(k, k) / length, s = w[k] / length;
      for (Eigen::Index j = k; j < r.cols(); ++j) {
        const double upper = r(k, j), lower = w[j];
        r(k, j) = c * upper + s * lower;
        w[j] = c * lower - s * upper;
      }
    }
  }

  /// Adds the balances of all processes up, so that all choose the same entities.
  void take_those_of_all() {
    std::vector<double> mine;
    for (const Part& part : parts_)
      mine.insert(mine.end(), part.triangle.data(), part.triangle.data() + part.triangle.size());
    const std::vector<double> all = parallel::gather(mine);
    const double* place = all.data();
    for (Part& part : parts_) part.triangle.setZero();
    for (int process = 0; process < parallel::size(); ++process)
      for (Part& part : parts_) {
        const Modes theirs = Eigen::Map<const Modes>(place, part.modes, part.modes);
        for (int k = 0; k < part.modes; ++k) add(theirs.row(k), part.triangle);
        part.is_held = false;  // the sum says whether it is
        place += theirs.size();
      }
  }

  const UnknownBlock& block_;
  const SparseMatrix& a_;
  const std::vector<int>& rows_;  ///< the numbers of the rows of the matrix, which are those of this process
  std::vector<int> entity_of_;    ///< of every unknown; -1 for those of other blocks
  std::vector<int> part_of_;      ///< of every entity
  std::vector<Part> parts_;
};

bool are_at_the_same_places(const UnknownBlock& a, const UnknownBlock& b) { return &a == &b || a.is_at_places_of(b); }

}  // namespace

std::vector<char> unknowns_held_by_fractures(const LinearSystem& system) {
  const auto unknowns = static_cast<std::size_t>(system.local.cols());
  expect_sound(system);
  std::vector<char> is_balance(unknowns, 0), held(unknowns, 0);
  for (const UnknownBlock& block : system.blocks)
    if (is_bulk(block.kind)) std::fill_n(is_balance.begin() + block.first, block.entities * block.components, 1);
  for (const int sum : system.sums) is_balance[sum] = 0;
  for (const UnknownBlock& block : system.blocks) {
    if (!is_bulk(block.kind) || block.entities == 0 || block.components >= most_modes) continue;
    std::vector<char> is_sum(block.entities, 0);
    for (const int sum : system.sums)
      if (sum >= block.first && sum < block.first + block.entities * block.components)
        is_sum[(sum - block.first) / block.components] = 1;
    for (const int entity : Parts(system, block, is_balance).to_fix(is_sum))
      for (const UnknownBlock& other : system.blocks)
        if (is_bulk(other.kind) && are_at_the_same_places(block, other))
          std::fill_n(held.begin() + other.first + entity * other.components, other.components, 1);
  }
  return held;
}

}  // namespace sprekk
