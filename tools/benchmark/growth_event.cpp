// What could be kept of a factorization when fractures grow? Runs a scene, and after each change of the mesh solves the
// equations of the bulk for the response to what lives on fractures (the columns of CondensedSolver) in several ways:
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
#include <umfpack.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <map>
#include <memory>
#include <numeric>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vector>

#include "framework/assembly/block_system.hpp"
#include "framework/linear/bulk_splitting.hpp"
#include "framework/linear/equilibration.hpp"
#include "framework/linear/umfpack_solver.hpp"
#include "framework/scene/mesh_growth.hpp"

namespace {

using namespace sprekk;

double seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

template <class Work>
double seconds_of(const Work& work) {
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

std::unique_ptr<Bulk> bulk_of(Model& model, const StepTime& step) {
  for (Part* part : model.parts()) part->begin_step(step);
  const std::vector<const Field*> unknowns = model.schedule().unknowns();
  Assembly assembly(unknowns, Assembly::Want::residual_and_derivatives);
  for (const Part* part : model.parts()) part->assemble(assembly, step);
  for (const Part* part : model.parts()) part->constrain(assembly);
  BlockSystem whole(model.mesh(), unknowns);
  const LinearSystem& system = whole.matrix(assembly);
  BulkSplitting split(system);
  split.bb.update(system.local.valuePtr());
  split.bf.update(system.local.valuePtr());
  auto bulk = std::make_unique<Bulk>();
  bulk->system = split.bulk_system();
  bulk->columns = Eigen::MatrixXd(split.bf.matrix)(Eigen::all, split.felt);
  for (const UnknownBlock& block : bulk->system.blocks)
    for (int i = 0; i < block.entities * block.components; ++i) {
      bulk->place.push_back(block.coordinates[i / block.components]);
      bulk->kind.push_back(10 * block.components + i % block.components);
    }
  return bulk;
}

/// Of every unknown its place in the order in which UMFPACK eliminates.
using Ranks = std::vector<int>;

struct Factorization {
  double ordering = 0, factorization = 0, entries = 0;
  Ranks ranks;
};

/// With METIS's ordering, or a given one.
Factorization factorize(const Bulk& bulk, const Ranks* given) {
  const Equilibrated scaled = equilibrate(bulk.system);
  const SparseMatrix& a = scaled.matrix;
  const int n = bulk.size();
  double control[UMFPACK_CONTROL], info[UMFPACK_INFO];
  umfpack_di_defaults(control);
  control[UMFPACK_ORDERING] = UMFPACK_ORDERING_METIS;
  control[UMFPACK_SCALE] = UMFPACK_SCALE_NONE;
  std::vector<int> order(n);
  if (given)
    for (int i = 0; i < n; ++i) order[(*given)[i]] = i;
  void *symbolic = nullptr, *numeric = nullptr;
  int status = UMFPACK_OK;
  Factorization result;
  result.ordering = seconds_of([&] {
    status = given ? umfpack_di_qsymbolic(n, n, a.outerIndexPtr(), a.innerIndexPtr(), nullptr, order.data(), &symbolic,
                                          control, info)
                   : umfpack_di_symbolic(n, n, a.outerIndexPtr(), a.innerIndexPtr(), nullptr, &symbolic, control, info);
  });
  if (status == UMFPACK_OK)
    result.factorization = seconds_of([&] {
      status =
          umfpack_di_numeric(a.outerIndexPtr(), a.innerIndexPtr(), a.valuePtr(), symbolic, &numeric, control, info);
    });
  if (status != UMFPACK_OK) throw std::runtime_error("UMFPACK failed");
  result.entries = info[UMFPACK_LNZ] + info[UMFPACK_UNZ];
  umfpack_di_get_numeric(nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, order.data(), nullptr, nullptr,
                         nullptr, numeric);
  result.ranks.resize(n);
  for (int i = 0; i < n; ++i) result.ranks[order[i]] = i;
  umfpack_di_free_numeric(&numeric);
  umfpack_di_free_symbolic(&symbolic);
  return result;
}

/// METIS's order of the cells, whose unknowns follow one another.
Ranks ranks_of_cells(const Bulk& bulk, double& ordering) {
  Ranks ranks(bulk.size());
  ordering = seconds_of([&] {
    std::map<std::pair<double, double>, int> cells;
    std::vector<int> cell_of(bulk.size());
    for (int i = 0; i < bulk.size(); ++i)
      cell_of[i] =
          cells.try_emplace({bulk.place[i].x(), bulk.place[i].y()}, static_cast<int>(cells.size())).first->second;
    const int n = static_cast<int>(cells.size());
    std::vector<Triplet> entries;
    for (int i = 0; i < bulk.size(); ++i)
      if (i == 0 || cell_of[i] != cell_of[i - 1])
        for (SparseMatrix::InnerIterator entry(bulk.system.local, i); entry; ++entry)
          if (entry.col() == 0 || cell_of[entry.col()] != cell_of[entry.col() - 1])
            entries.emplace_back(cell_of[i], cell_of[entry.col()], 1.0);
    SparseMatrix graph(n, n);
    graph.setFromTriplets(entries.begin(), entries.end());
    double control[UMFPACK_CONTROL];
    umfpack_di_defaults(control);
    control[UMFPACK_ORDERING] = UMFPACK_ORDERING_METIS;
    void* symbolic = nullptr;
    if (umfpack_di_symbolic(n, n, graph.outerIndexPtr(), graph.innerIndexPtr(), nullptr, &symbolic, control, nullptr) !=
        UMFPACK_OK)
      throw std::runtime_error("UMFPACK failed");
    std::vector<int> order(n), rank(n);
    umfpack_di_get_symbolic(nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, order.data(), nullptr,
                            nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, symbolic);
    umfpack_di_free_symbolic(&symbolic);
    for (int k = 0; k < n; ++k) rank[order[k]] = k;
    std::vector<int> unknowns(bulk.size());
    std::iota(unknowns.begin(), unknowns.end(), 0);
    std::stable_sort(unknowns.begin(), unknowns.end(),
                     [&](int a, int b) { return rank[cell_of[a]] < rank[cell_of[b]]; });
    for (int k = 0; k < bulk.size(); ++k) ranks[unknowns[k]] = k;
  });
  return ranks;
}

/// Every unknown of `after` comes where the one of its kind that was nearest before had been.
Ranks mapped(const Bulk& before, const Ranks& ranks, const std::vector<int>& origin, const Bulk& after) {
  std::vector<int> wish(after.size()), order(after.size());
  for (int i = 0; i < after.size(); ++i) {
    int nearest = origin[i];
    double distance = HUGE_VAL;
    for (int j = 0; origin[i] == none && j < before.size(); ++j)
      if (before.kind[j] == after.kind[i] && (before.place[j] - after.place[i]).squaredNorm() < distance) {
        distance = (before.place[j] - after.place[i]).squaredNorm();
        nearest = j;
      }
    wish[i] = ranks[nearest];
    order[i] = i;
  }
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return wish[a] < wish[b]; });
  Ranks result(after.size());
  for (int i = 0; i < after.size(); ++i) result[order[i]] = i;
  return result;
}

/// Per unknown of `after` the same one of `before`, or none.
std::vector<int> origins(const Bulk& before, const Bulk& after) {
  std::map<std::tuple<int, double, double>, int> known;
  for (int j = 0; j < before.size(); ++j) known[{before.kind[j], before.place[j].x(), before.place[j].y()}] = j;
  std::vector<int> origin(after.size(), none);
  for (int i = 0; i < after.size(); ++i)
    if (const auto found = known.find({after.kind[i], after.place[i].x(), after.place[i].y()}); found != known.end())
      origin[i] = found->second;
  return origin;
}

/// The rows of `after` that are not, entry by entry, rows of `before`.
std::vector<int> changed_rows(const Bulk& before, const Bulk& after, const std::vector<int>& origin) {
  std::vector<int> changed;
  for (int i = 0; i < after.size(); ++i) {
    std::map<int, double> now, was;
    bool is_new = origin[i] == none;
    for (SparseMatrix::InnerIterator entry(after.system.local, i); entry && !is_new; ++entry) {
      is_new = origin[entry.col()] == none;
      now[origin[entry.col()]] = entry.value();
    }
    if (!is_new)
      for (SparseMatrix::InnerIterator entry(before.system.local, origin[i]); entry; ++entry)
        was[static_cast<int>(entry.col())] = entry.value();
    if (is_new || now != was) changed.push_back(i);
  }
  return changed;
}

/// The factorization before, for vectors of the mesh after: what is new is left alone, what is gone is zero.
struct Old {
  const Bulk& before;
  const std::vector<int>& origin;

  Eigen::MatrixXd solve(const Eigen::MatrixXd& columns) const {
    Eigen::MatrixXd old = Eigen::MatrixXd::Zero(before.size(), columns.cols()), result = columns;
    for (int i = 0; i < columns.rows(); ++i)
      if (origin[i] != none) old.row(origin[i]) = columns.row(i);
    if (columns.cols() == 1)
      before.solver.solve_unchecked(old.col(0));
    else
      const_cast<UmfpackSolver&>(before.solver).solve_columns(old);
    for (int i = 0; i < columns.rows(); ++i)
      if (origin[i] != none) result.row(i) = old.row(origin[i]);
    return result;
  }
};

/// A x = b, from A = (old rows) + (changed rows): x = M^-1 (b + P y), with P the changed rows and y such that they
/// hold. Returns the largest relative residual; rows in the scaling of `scaled`.
double solve_by_rows(const Old& old, const std::vector<int>& changed, const Bulk& after, const Equilibrated& scaled) {
  const int n = after.size(), m = static_cast<int>(changed.size());
  SparseMatrix rows(m, n);
  std::vector<Triplet> entries;
  for (int k = 0; k < m; ++k)
    for (SparseMatrix::InnerIterator entry(after.system.local, changed[k]); entry; ++entry)
      entries.emplace_back(k, static_cast<int>(entry.col()), scaled.row_scale[changed[k]] * entry.value());
  rows.setFromTriplets(entries.begin(), entries.end());
  Eigen::MatrixXd response = Eigen::MatrixXd::Zero(n, m);
  for (int k = 0; k < m; ++k) response(changed[k], k) = 1 / scaled.row_scale[changed[k]];
  response = old.solve(response);
  const Eigen::PartialPivLU<Eigen::MatrixXd> dense(rows * response);
  Eigen::MatrixXd x = old.solve(after.columns);
  const Eigen::MatrixXd wanted = scaled.row_scale.asDiagonal() * after.columns;
  x += response * dense.solve(wanted(changed, Eigen::all) - rows * x);
  const Eigen::MatrixXd residual = wanted - scaled.row_scale.asDiagonal() * (after.system.local * x);
  return (residual.colwise().norm().array() / wanted.colwise().norm().array()).maxCoeff();
}

/// Solves a part of a system alone; the rest is zero.
class ChangedPart {
 public:
  ChangedPart(const Bulk& bulk, const std::vector<int>& unknowns) : unknowns_(unknowns) {
    std::vector<int> place(bulk.size(), none);
    for (std::size_t k = 0; k < unknowns.size(); ++k) place[unknowns[k]] = static_cast<int>(k);
    std::vector<Triplet> entries;
    for (std::size_t k = 0; k < unknowns.size(); ++k)
      for (SparseMatrix::InnerIterator entry(bulk.system.local, unknowns[k]); entry; ++entry)
        if (place[entry.col()] != none) entries.emplace_back(static_cast<int>(k), place[entry.col()], entry.value());
    LinearSystem system;
    system.local.resize(unknowns.size(), unknowns.size());
    system.local.setFromTriplets(entries.begin(), entries.end());
    system.rows.resize(unknowns.size());
    std::iota(system.rows.begin(), system.rows.end(), 0);
    UnknownBlock block;
    block.name = "part";
    block.entities = static_cast<int>(unknowns.size());
    system.blocks = {block};
    if (!solver_.factor(system).solved) throw std::runtime_error("what has changed is singular by itself");
  }
  Vector solve(const Vector& b) const {
    Vector mine = b(unknowns_), result = Vector::Zero(b.size());
    solver_.solve_unchecked(mine);
    result(unknowns_) = mine;
    return result;
  }

 private:
  const std::vector<int>& unknowns_;
  UmfpackSolver solver_;
};

/// Right-preconditioned, without restart: first the changed part, then the old factorization for what is left. Returns
/// the number of iterations until the relative residual in the scaling is `tolerance`, 200 at most.
template <class Precondition>
int gmres(const SparseMatrix& a, const Vector& b, double tolerance, const Precondition& precondition, Vector& x) {
  constexpr int most = 200;
  Eigen::MatrixXd basis(b.size(), most + 1), searched(b.size(), most);
  Eigen::MatrixXd h = Eigen::MatrixXd::Zero(most + 1, most);
  const double norm = b.norm();
  basis.col(0) = b / norm;
  Vector g = Vector::Zero(most + 1), c(most), s(most);
  g[0] = norm;
  int k = 0;
  while (k < most && std::abs(g[k]) > tolerance * norm) {
    searched.col(k) = precondition(basis.col(k));
    Vector w = a * searched.col(k);
    for (int twice = 0; twice < 2; ++twice)
      for (int i = 0; i <= k; ++i) {
        const double along = basis.col(i).dot(w);
        h(i, k) += along;
        w -= along * basis.col(i);
      }
    h(k + 1, k) = w.norm();
    basis.col(k + 1) = w / h(k + 1, k);
    for (int i = 0; i < k; ++i) {
      const double upper = h(i, k);
      h(i, k) = c[i] * upper + s[i] * h(i + 1, k);
      h(i + 1, k) = -s[i] * upper + c[i] * h(i + 1, k);
    }
    const double length = std::hypot(h(k, k), h(k + 1, k));
    c[k] = h(k, k) / length;
    s[k] = h(k + 1, k) / length;
    h(k, k) = length;
    g[k + 1] = -s[k] * g[k];
    g[k] *= c[k];
    ++k;
  }
  x = searched.leftCols(k) * Vector(h.topLeftCorner(k, k).template triangularView<Eigen::Upper>().solve(g.head(k)));
  return k;
}

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
