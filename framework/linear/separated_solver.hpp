// Solves systems that fall into parts which do not feel one another, part by part.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "framework/linear/bulk_splitting.hpp"
#include "framework/linear/linear_solver.hpp"

namespace sprekk {

/// Parts are the sets of blocks that no entry of the matrix joins, in one process: flow and deformation without a
/// coupling, for example. Each has a factorization of its own, and one without load is not solved for. A system of one
/// part goes to its solver as it is.
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
    std::vector<int> source;    ///< of every value of its matrix: its place among those of the whole one
    LinearSystem system;
    std::unique_ptr<LinearSolver> solver;
  };
  bool fits(const LinearSystem& system) const;
  void separate(const LinearSystem& system);

  Maker make_;
  std::vector<int> outer_, inner_;
  std::uint64_t pattern_number_ = 0, number_ = 0;  ///< of the last system
  std::vector<Group> groups_;
  LinearCounts retired_;
  mutable LinearCounts total_;
};

}  // namespace sprekk
