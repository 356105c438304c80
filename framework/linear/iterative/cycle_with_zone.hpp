// A multigrid cycle between two exact solutions of a zone, such as what is beside fractures.
#pragma once

#include <memory>
#include <vector>

#include "framework/linear/direct/umfpack_solver.hpp"
#include "framework/linear/trilinos_module/trilinos_module.hpp"
#include "framework/parallel/gathered.hpp"

namespace sprekk {

/// Solves for the unknowns of a zone exactly before and after a cycle for all of them (multiplicative Schwarz). Walls
/// that stick are tied by entries as large as those of the rock: a smoother that takes one node after the other hardly
/// moves both walls together, and a coarse level does not have their short waves.
class CycleWithZone final : public Multigrid {
 public:
  /// Collective. `rows`: this process's rows of the matrix, `ids`: their numbers; `zone`: numbers, ascending, the same
  /// on every process. Throws std::invalid_argument if the zone alone is singular.
  CycleWithZone(const SparseMatrix& rows, const std::vector<int>& ids, std::vector<int> zone,
                std::unique_ptr<Multigrid> cycle);
  void apply(const Vector& b, Vector& x) const override;

 private:
  /// Adds the answer of the zone to the residual r, on this process's rows.
  void add_answer_of_zone(const Vector& r, Vector& x) const;

  std::unique_ptr<Multigrid> cycle_;
  std::unique_ptr<DistributedMatrix> matrix_;
  std::vector<int> owned_;   ///< places in the zone of those whose rows this process holds
  std::vector<int> owners_;  ///< their places among this process's rows
  int zone_size_;
  parallel::WholeVectors whole_zone_;
  UmfpackSolver zone_;
};

}  // namespace sprekk
