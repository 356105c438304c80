// Solves systems that fall into decoupled parts, part by part.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "framework/linear/linear_solver.hpp"
#include "framework/linear/reduction/excerpt.hpp"

namespace sprekk {

/// Solves decoupled parts of a system apart, in one process. Parts are sets of blocks between which the matrix has no
/// entry: flow and deformation without a coupling, for example. Each part has a factorization of its own; a part whose
/// right-hand side is zero is not solved. A system of one part is passed to its solver as it is.
/// Many entities whose rows and columns have a diagonal entry alone, such as cells of rock in which nothing flows, are
/// left out of the parts: orderings would take more time for them than for others.
class SeparatedSolver final : public LinearSolver {
 public:
  using Maker = std::function<std::unique_ptr<LinearSolver>()>;
  explicit SeparatedSolver(Maker make) : make_(std::move(make)) {}

  LinearReport factor(const LinearSystem& system) override;
  LinearReport solve(const Vector& b_rows, Vector& x) override;
  std::string name() const override;
  const LinearCounts& counts() const override;

 private:
  struct Group {
    std::vector<int> unknowns;  ///< ascending
    Excerpt source;             ///< the places of the values of its matrix among those of the whole matrix
    LinearSystem system;
    std::unique_ptr<LinearSolver> solver;
  };
  bool fits(const LinearSystem& system) const;
  enum class Lone { apart, within };  ///< where unknowns with a diagonal entry alone are
  void separate(const LinearSystem& system, Lone lone);
  bool is_passed_on() const { return groups_.size() == 1 && lone_.empty(); }
  bool take_lone(const SparseMatrix& a);

  Maker make_;
  std::vector<int> outer_, inner_;
  std::uint64_t pattern_number_ = 0, number_ = 0;  ///< of the last system
  std::vector<Group> groups_;
  std::vector<int> lone_;  ///< ascending; in no group
  Vector of_lone_;         ///< diagonal entries of lone_
  LinearCounts retired_;
  mutable LinearCounts total_;
};

}  // namespace sprekk
