// Orderings of the bulk, new ones and ones that are kept, and what a factorization with them costs.
#pragma once

#include <umfpack.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <stdexcept>
#include <vector>

#include "framework/linear/equilibration.hpp"
#include "tools/benchmark/growth_event_bulk.hpp"

namespace sprekk::growth_event {

/// Of every unknown its place in the order in which UMFPACK eliminates.
using Ranks = std::vector<int>;

struct Factorization {
  double ordering = 0, factorization = 0, entries = 0;
  Ranks ranks;
};

/// With METIS's ordering, or a given one.
inline Factorization factorize(const Bulk& bulk, const Ranks* given) {
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
inline Ranks ranks_of_cells(const Bulk& bulk, double& ordering) {
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
inline Ranks mapped(const Bulk& before, const Ranks& ranks, const std::vector<int>& origin, const Bulk& after) {
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

}  // namespace sprekk::growth_event
