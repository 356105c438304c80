#include "framework/mesh/search/point_location.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "framework/invariants.hpp"
#include "framework/mesh/search/distances.hpp"

namespace sprekk {
namespace {

constexpr double tie = 1e-6;  ///< of the length of a fracture cell: how much nearer one must be

struct Extent {
  Point low = Point::Constant(std::numeric_limits<double>::infinity());
  Point high = -low;
  void add(const Point& x) {
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
};

Extent extent_of(const Mesh& mesh, int cell) {
  Extent extent;
  for (const int node : mesh.cell_nodes[cell]) extent.add(mesh.nodes[node]);
  return extent;
}

}  // namespace

PointLocation::PointLocation(const Mesh& mesh) : mesh_(&mesh) {
  Extent whole;
  for (const Point& node : mesh.nodes) whole.add(node);
  const Point size = whole.high - whole.low;
  SPREKK_EXPECT(size.allFinite() && size.minCoeff() > 0, size[0], size[1]);
  low_ = whole.low;
  constexpr double slack = 1e-10;  // of the extent: round-off of coordinates
  slack_ = slack * size.norm();
  // Buckets of half the width of a cell of mean size: where a mesh is graded most points are asked for among its small
  // cells.
  width_ = 0.5 * (dimension == 2 ? std::sqrt(size.prod() / std::max(1, mesh.cell_count()))
                                 : std::cbrt(size.prod() / std::max(1, mesh.cell_count())));
  for (int axis = 0; axis < dimension; ++axis) counts_[axis] = 1 + static_cast<int>(size[axis] / width_);

  const auto for_each_bucket = [&](int cell, auto&& visit) {
    const Extent extent = extent_of(mesh, cell);
    std::array<int, dimension> first, last;
    for (int axis = 0; axis < dimension; ++axis) {
      first[axis] = bucket(axis, extent.low[axis] - slack_);
      last[axis] = bucket(axis, extent.high[axis] + slack_);
    }
    std::array<int, dimension> at = first;
    for (int axis = 0; axis < dimension;) {
      visit(number(at));
      for (axis = 0; axis < dimension && ++at[axis] > last[axis]; ++axis) at[axis] = first[axis];
    }
  };
  int buckets = 1;
  for (const int count : counts_) buckets *= count;
  cells_.offsets.assign(static_cast<std::size_t>(buckets) + 1, 0);
  for (int cell = 0; cell < mesh.cell_count(); ++cell) {
    for_each_bucket(cell, [&](int b) { ++cells_.offsets[b + 1]; });
  }
  std::partial_sum(cells_.offsets.begin(), cells_.offsets.end(), cells_.offsets.begin());
  cells_.items.resize(cells_.offsets.back());
  auto next = cells_.offsets;
  for (int cell = 0; cell < mesh.cell_count(); ++cell) {
    for_each_bucket(cell, [&](int b) { cells_.items[next[b]++] = cell; });
  }
}

int PointLocation::number(const std::array<int, dimension>& at) const {
  int number = 0;
  for (int axis = dimension - 1; axis >= 0; --axis) number = number * counts_[axis] + at[axis];
  return number;
}

int PointLocation::bucket(int axis, double coordinate) const {
  return static_cast<int>(std::clamp((coordinate - low_[axis]) / width_, 0.0, counts_[axis] - 1.0));
}

int PointLocation::cell_at(const Point& x) const {
  if (!x.allFinite()) return none;
  std::array<int, dimension> at;
  for (int axis = 0; axis < dimension; ++axis) at[axis] = bucket(axis, x[axis]);
  for (const int cell : cells_[number(at)]) {
    bool is_in = true;
    const CellFaces& faces = mesh_->cell_faces[cell];
    for (int k = 0; k < faces.size() && is_in; ++k)
      is_in = depth_below_face(*mesh_, cell, k, x) >= -slack_ * mesh_->face_measure[faces[k]];
    if (is_in) return cell;
  }
  // Between the planes of faces that are bent there are gaps, between the parts of cells there are none.
  for (const int cell : cells_[number(at)])
    if (parts_hold(*mesh_, cell, x, slack_)) return cell;
  return none;
}

int PointLocation::cell_at(const Point& x, int guess) const {
  // From cell to cell across the first face that has the point on its other side, until the point is so far inside that
  // no other cell counts it as its own: the cell is usually a few steps away.
  constexpr int most_steps = 12;
  int cell = guess;
  for (int step = 0; step < most_steps && cell != none; ++step) {
    int next = cell;
    const CellFaces& faces = mesh_->cell_faces[cell];
    for (int k = 0; k < faces.size() && next == cell; ++k) {
      if (depth_below_face(*mesh_, cell, k, x) > 2 * slack_ * mesh_->face_measure[faces[k]]) continue;
      const auto& [one, other] = mesh_->face_cells[faces[k]];
      next = one == cell ? other : one;
    }
    if (next == cell) return cell;
    cell = next;
  }
  return cell_at(x);
}

int find_fracture(const Mesh& mesh, const std::string& name) {
  for (std::size_t i = 0; i < mesh.fractures.size(); ++i) {
    if (mesh.fractures[i].name == name) return static_cast<int>(i);
  }
  return none;
}

int nearest_fracture_cell(const Mesh& mesh, const Point& x, const std::function<bool(int cell)>& counts) {
  int nearest = none;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < mesh.fracture_cell_count(); ++i) {
    if (counts && !counts(i)) continue;
    const double d = distance_to_fracture_cell(mesh, i, x);
    if (d < least - tie * mesh.fracture_cells[i].size()) least = d, nearest = i;
  }
  return nearest;
}

}  // namespace sprekk
