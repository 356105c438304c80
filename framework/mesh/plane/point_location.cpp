#include "framework/mesh/plane/point_location.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "framework/invariants.hpp"
#include "framework/mesh/plane/planar.hpp"

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
  SPREKK_EXPECT(size.allFinite() && size.minCoeff() > 0, size.x(), size.y());
  low_ = whole.low;
  constexpr double slack = 1e-10;  // of the extent: round-off of coordinates
  slack_ = slack * size.norm();
  // Four buckets for a cell of mean area: where a mesh is graded most points are asked for among its small cells.
  width_ = 0.5 * std::sqrt(size.x() * size.y() / std::max(1, mesh.cell_count()));
  for (int axis = 0; axis < 2; ++axis) counts_[axis] = 1 + static_cast<int>(size[axis] / width_);

  const auto for_each_bucket = [&](int cell, auto&& visit) {
    const Extent extent = extent_of(mesh, cell);
    for (int j = bucket(1, extent.low.y() - slack_); j <= bucket(1, extent.high.y() + slack_); ++j) {
      for (int i = bucket(0, extent.low.x() - slack_); i <= bucket(0, extent.high.x() + slack_); ++i) {
        visit(j * counts_[0] + i);
      }
    }
  };
  cells_.offsets.assign(static_cast<std::size_t>(counts_[0]) * counts_[1] + 1, 0);
  for (int cell = 0; cell < mesh.cell_count(); ++cell) {
    for_each_bucket(cell, [&](int b) { ++cells_.offsets[b + 1]; });
  }
  std::partial_sum(cells_.offsets.begin(), cells_.offsets.end(), cells_.offsets.begin());
  cells_.items.resize(cells_.offsets.back());
  auto next = cells_.offsets;
  SPREKK_ASSERT(counts_[0] > 0 && counts_[1] > 0, counts_[0], counts_[1]);
  for (int cell = 0; cell < mesh.cell_count(); ++cell) {
    for_each_bucket(cell, [&](int b) { cells_.items[next[b]++] = cell; });
  }
}

int PointLocation::bucket(int axis, double coordinate) const {
  return static_cast<int>(std::clamp((coordinate - low_[axis]) / width_, 0.0, counts_[axis] - 1.0));
}

int PointLocation::cell_at(const Point& x) const {
  if (!x.allFinite()) return none;
  for (const int cell : cells_[bucket(1, x.y()) * counts_[0] + bucket(0, x.x())]) {
    const Ring& corners = mesh_->cell_nodes[cell];
    bool is_in = true;
    for (int k = 0; k < corners.size() && is_in; ++k) {
      const Point &a = mesh_->nodes[corners[k]], &b = mesh_->nodes[corners.after(k)];
      const double above = cross(b - a, x - a);
      is_in = above >= 0 || above >= -slack_ * (b - a).norm();
    }
    if (is_in) return cell;
  }
  return none;
}

int PointLocation::cell_at(const Point& x, int guess) const {
  // From cell to cell across the first face that has the point on its other side, until the point is so far inside that
  // no other cell counts it as its own.
  constexpr int most_steps = 12;
  int cell = guess;
  for (int step = 0; step < most_steps && cell != none; ++step) {
    const Ring& corners = mesh_->cell_nodes[cell];
    int next = cell;
    for (int k = 0; k < corners.size() && next == cell; ++k) {
      const Point &a = mesh_->nodes[corners[k]], &b = mesh_->nodes[corners.after(k)];
      const double above = cross(b - a, x - a);
      if (above > 0 && above * above > 4 * slack_ * slack_ * (b - a).squaredNorm()) continue;
      const auto& [one, other] = mesh_->face_cells[mesh_->cell_faces[cell][k]];
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
    const auto [from, to] = mesh.fracture_cells[i].ridges;
    const double d = distance(x, Segment{mesh.ridges[from].center, mesh.ridges[to].center});
    if (d < least - tie * mesh.fracture_cells[i].measure) least = d, nearest = i;
  }
  return nearest;
}

}  // namespace sprekk
