#include "framework/discretization/along_fracture.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "framework/invariants.hpp"

namespace sprekk {
namespace {

/// A neighbour of a cell in its fracture; how far its centre is along the fracture, m, negative towards points[0].
struct Neighbour {
  int cell;
  double at;
};

std::vector<Neighbour> neighbours_of(const Mesh& mesh, int cell) {
  const FractureCell& home = mesh.fracture_cells[cell];
  std::vector<Neighbour> neighbours;
  for (int k = 0; k < 2; ++k) {
    const Ridge& end = mesh.ridges[home.ridges[k]];
    if (end.kind != Ridge::Kind::inside) continue;
    const int other = end.cells[0] == cell ? end.cells[1] : end.cells[0];
    const double apart = 0.5 * (home.measure + mesh.fracture_cells[other].measure);
    neighbours.push_back({other, k == 0 ? -apart : apart});
  }
  return neighbours;
}

/// Adds a share of the polynomial through the centres of a cell and of its neighbours, at `t` from the former.
void add_polynomial(const Mesh& mesh, int cell, double t, double share, std::map<int, double>& weights) {
  const std::vector<Neighbour> around = neighbours_of(mesh, cell);
  if (around.size() == 2) {
    const double a = around[0].at, b = around[1].at;
    weights[cell] += share * (t - a) * (t - b) / (a * b);
    weights[around[0].cell] += share * t * (t - b) / (a * (a - b));
    weights[around[1].cell] += share * t * (t - a) / (b * (b - a));
    return;
  }
  SPREKK_EXPECT(around.size() == 1, cell);
  weights[cell] += share * (1 - t / around[0].at);
  weights[around[0].cell] += share * t / around[0].at;
}

}  // namespace

std::vector<std::pair<int, double>> along_fracture(const Mesh& mesh, int cell, const Point& x) {
  SPREKK_EXPECT(is_index(cell, mesh.fracture_cell_count()) && is_finite(x), cell);
  const FractureCell& home = mesh.fracture_cells[cell];
  const auto position = [&](int k) { return mesh.ridges[home.ridges[k]].center; };
  const double t =
      std::clamp((x - home.center).dot((position(1) - position(0)).normalized()), -home.measure, home.measure);
  for (const Neighbour& next : neighbours_of(mesh, cell)) {
    if (!(t * next.at > 0)) continue;
    std::map<int, double> weights;
    add_polynomial(mesh, cell, t, 1 - t / next.at, weights);
    add_polynomial(mesh, next.cell, t - next.at, t / next.at, weights);
    return {weights.begin(), weights.end()};
  }
  return {{cell, 1.0}};
}

}  // namespace sprekk
