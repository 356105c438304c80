// What could be kept of a factorization when fractures grow? Runs a scene, and after each change of the mesh solves the
// equations of the bulk for their Schur complement on fractures (the columns of CondensedSolver) in several ways:
//
//   new       ordering by METIS, unknown by unknown, factorization, columns
//   cells     the same with an ordering of cells (EntityGraph): what the program does
//   mapped    the ordering of the first mesh, new cells in the places of those nearest to them
//   last      the same with METIS's ordering of the mesh before
//   GMRES     with the factorization of the mesh before as a preconditioner, and one of what has changed
//   rows      the factorization of the mesh before, and the rows that have changed put in exactly (Woodbury's formula)
//
//   bench_growth_event SCENE EVENTS [PATH VALUE]…
//
// Prints a line an event and their sums: seconds of ordering + factorization (+ columns), or of all. These are
// processor seconds of one run and may be compared with one another.
#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "framework/config/yaml/load_scene.hpp"

#include "tools/benchmark/growth_event_old_factors.hpp"
#include "tools/benchmark/growth_event_orderings.hpp"

namespace {

using namespace sprekk;
using namespace sprekk::growth_event;

struct Sums {
  double ordering = 0, factorization = 0, columns = 0;
  double mapped_ordering = 0, mapped_factorization = 0, last_ordering = 0, last_factorization = 0;
  double cells_ordering = 0, cells_factorization = 0;
  double gmres = 0, rows = 0, iterations = 0, solves = 0;
};

void compare(const Bulk& before, const Ranks& last_ranks, Bulk& after, Ranks& chain, Ranks& own, Sums& sums) {
  const std::vector<int> origin = origins(before, after);
  const Factorization fresh = factorize(after, nullptr);
  const double columns = seconds_of([&] {
    Eigen::MatrixXd x = after.columns;
    after.solver.solve_columns(x);
  });
  chain = mapped(before, chain, origin, after);
  const Factorization kept = factorize(after, &chain);
  const Ranks from_last = mapped(before, last_ranks, origin, after);
  const Factorization last = factorize(after, &from_last);
  own = fresh.ranks;

  double of_cells = 0;
  const Ranks by_cells = ranks_of_cells(after, of_cells);
  const Factorization cells = factorize(after, &by_cells);

  const std::vector<int> changed = changed_rows(before, after, origin);
  const Equilibrated scaled = equilibrate(after.system);
  const Old old{before, origin};
  double residual = 0;
  const double by_rows = seconds_of([&] { residual = solve_by_rows(old, changed, after, scaled); });

  int iterations = 0, solves = 0;
  double error = 0;
  const double by_gmres = seconds_of([&] {
    const ChangedPart part(after, changed);
    const auto precondition = [&](const Vector& v) -> Vector {
      const Vector r = v.cwiseQuotient(scaled.row_scale);
      Vector z = part.solve(r);
      const Vector left = r - after.system.local * z;
      z += old.solve(left);
      return z.cwiseQuotient(scaled.column_scale);
    };
    for (int k = 0; k < after.columns.cols(); ++k) {
      const Vector b = scaled.row_scale.cwiseProduct(after.columns.col(k));
      Vector x;
      iterations += gmres(scaled.matrix, b, 1e-12, precondition, x);
      ++solves;
      error = std::max(error, (b - scaled.matrix * x).norm() / b.norm());
    }
  });
  fmt::print(
      "{:7} {:7} {:7} | new {:.4f} + {:.4f} + {:.4f} | mapped {:.4f} + {:.4f}, fill {:.2f} | last {:.4f} + {:.4f}, "
      "fill "
      "{:.2f} | cells {:.4f} + {:.4f}, fill {:.2f} | rows {:.4f} ({:.0e}) | GMRES {:.3f}, {:.1f} iterations ({:.0e})\n",
      after.size(), after.columns.cols(), changed.size(), fresh.ordering, fresh.factorization, columns, kept.ordering,
      kept.factorization, kept.entries / fresh.entries, last.ordering, last.factorization, last.entries / fresh.entries,
      of_cells + cells.ordering, cells.factorization, cells.entries / fresh.entries, by_rows, residual, by_gmres,
      static_cast<double>(iterations) / solves, error);
  std::fflush(stdout);
  sums.ordering += fresh.ordering;
  sums.factorization += fresh.factorization;
  sums.columns += columns;
  sums.mapped_ordering += kept.ordering;
  sums.mapped_factorization += kept.factorization;
  sums.last_ordering += last.ordering;
  sums.last_factorization += last.factorization;
  sums.cells_ordering += of_cells + cells.ordering;
  sums.cells_factorization += cells.factorization;
  sums.gmres += by_gmres;
  sums.rows += by_rows;
  sums.iterations += iterations;
  sums.solves += solves;
}

int run(const std::string& file, int events, const std::vector<Override>& overrides) {
  const Scene scene = read_scene(load_scene({file}, overrides), std::filesystem::path(file).parent_path().string());
  auto model = std::make_unique<Model>(scene);
  StepController controller(scene.time, model->switch_times());
  MeshGrowth growth(model, controller);
  const StepTime usual{-scene.time.step, scene.time.step, 0};
  const auto bulk = [&] {
    auto result = bulk_of(*model, usual);
    const LinearReport report = result->solver.factor(result->system);
    if (!report.solved) throw std::runtime_error(report.reason);
    return result;
  };
  std::unique_ptr<Bulk> before = bulk();
  Ranks last = factorize(*before, nullptr).ranks, chain = last;
  Sums sums;
  long changes = 0;
  fmt::print("unknowns, columns, unknowns whose equations have changed\n");
  while (changes < events) {
    const StepTime step = controller.next();
    const StepStatus status = model->attempt(step);
    if (status.converged && growth.before_acceptance() == MeshGrowth::Outcome::changed) continue;
    if (!status.converged) {
      model->rewind();
      if (!controller.rejected(step, status.retry_dt)) throw std::runtime_error(status.reason);
      continue;
    }
    model->accept();
    controller.accepted(step, status.iterations);
    if (growth.after_acceptance() == MeshGrowth::Outcome::failed) throw std::runtime_error(growth.reason());
    if (growth.changes() == changes) continue;
    changes = growth.changes();
    std::unique_ptr<Bulk> after = bulk();
    Ranks own;
    compare(*before, last, *after, chain, own, sums);
    before = std::move(after);
    last = std::move(own);
  }
  fmt::print(
      "all: new {:.3f} + {:.3f} + columns {:.3f} | mapped {:.3f} + {:.3f} | last {:.3f} + {:.3f} | cells {:.3f} + "
      "{:.3f} | rows {:.3f} | GMRES "
      "{:.3f}, {:.1f} iterations a column\n",
      sums.ordering, sums.factorization, sums.columns, sums.mapped_ordering, sums.mapped_factorization,
      sums.last_ordering, sums.last_factorization, sums.cells_ordering, sums.cells_factorization, sums.rows, sums.gmres,
      sums.iterations / sums.solves);
  return 0;
}

}  // namespace

int main(int count, char** arguments) {
  if (count < 3 || count % 2 == 0) {
    fmt::print(stderr, "bench_growth_event SCENE EVENTS [PATH VALUE]…\n");
    return 2;
  }
  std::vector<Override> overrides;
  for (int i = 3; i + 1 < count; i += 2) overrides.push_back({arguments[i], arguments[i + 1]});
  try {
    return run(arguments[1], std::atoi(arguments[2]), overrides);
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
}
