// The equations of the bulk that bench_growth_event solves on each mesh, and a clock.
#pragma once

#include <Eigen/Core>
#include <ctime>
#include <memory>
#include <vector>

#include "framework/assembly/block_system.hpp"
#include "framework/linear/direct/umfpack_solver.hpp"
#include "framework/linear/reduction/bulk_splitting.hpp"
#include "framework/run/mesh_growth.hpp"

namespace sprekk::growth_event {

inline double seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

template <class Work>
inline double seconds_of(const Work& work) {
  const double start = seconds();
  work();
  return seconds() - start;
}

/// The equations of the bulk on one mesh, and the columns that they are to be solved for.
struct Bulk {
  LinearSystem system;
  Eigen::MatrixXd columns;
  std::vector<Point> place;  ///< of every unknown: its cell's centre
  std::vector<int> kind;     ///< of every unknown: field and component
  UmfpackSolver solver;

  int size() const { return static_cast<int>(place.size()); }
};

inline std::unique_ptr<Bulk> bulk_of(Model& model, const StepTime& step) {
  begin_step(model.parts(), step);
  const std::vector<const Field*> unknowns = model.schedule().unknowns();
  Assembly assembly(unknowns, Assembly::Request::residual_and_derivatives);
  for (const Part* part : model.parts()) part->assemble(assembly, step);
  for (const Part* part : model.parts()) part->constrain(assembly);
  BlockSystem whole(model.mesh(), unknowns);
  const LinearSystem& system = whole.matrix(assembly);
  BulkSplitting split(system);
  split.update(system.local);
  auto bulk = std::make_unique<Bulk>();
  bulk->system = split.bulk_system();
  bulk->columns = Eigen::MatrixXd(split.bf.matrix)(Eigen::all, split.interface_columns);
  for (const UnknownBlock& block : bulk->system.blocks)
    for (int i = 0; i < block.entities * block.components; ++i) {
      bulk->place.push_back(block.coordinates.col(i / block.components));
      bulk->kind.push_back(10 * block.components + i % block.components);
    }
  return bulk;
}

}  // namespace sprekk::growth_event
