#include "framework/results/bodies.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>

#include "framework/dense/least_squares.hpp"
#include "framework/round_off.hpp"

namespace sprekk {
namespace {

/// The corners of the faces of a body, in the order of gmsh.
const std::vector<std::vector<int>>& faces_with(std::int64_t corners) {
  static const std::vector<std::vector<int>> tetrahedron{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}},
      wedge{{0, 2, 1}, {3, 4, 5}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}},
      hexahedron{{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
  if (corners == 4) return tetrahedron;
  if (corners == 6) return wedge;
  if (corners == 8) return hexahedron;
  throw std::runtime_error("a body of a grid has " + std::to_string(corners) + " corners");
}

std::int64_t begin_of(const GridData& grid, int cell) { return cell == 0 ? 0 : grid.cell_ends[cell - 1]; }

Eigen::Vector3d point(const GridData& grid, std::int64_t number) {
  return Eigen::Vector3d::Map(&grid.points[3 * number]);
}

double six_volumes(const std::array<Eigen::Vector3d, 4>& x) {
  return (x[1] - x[0]).cross(x[2] - x[0]).dot(x[3] - x[0]);
}

}  // namespace

Bodies::Bodies(const GridData& grid) : grid_(grid), beside_(grid.cell_count()) {
  for (int body = 0; body < count(); ++body) {
    Eigen::Vector3d moment = Eigen::Vector3d::Zero();
    double volume = 0;
    for (const Corners& x : tetrahedra_of(body)) {
      const double part = std::abs(six_volumes(x)) / 6;
      volume += part;
      moment += part * (x[0] + x[1] + x[2] + x[3]) / 4;
    }
    volumes_.push_back(volume);
    centres_.push_back(moment / volume);
  }
  join_bodies();
  fill_boxes();
}

/// Between the mean of its corners and its faces.
std::vector<Bodies::Corners> Bodies::tetrahedra_of(int body) const {
  const std::int64_t begin = begin_of(grid_, body), corners = grid_.cell_ends[body] - begin;
  const auto corner = [&](int k) { return point(grid_, grid_.cell_points[begin + k]); };
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (int k = 0; k < corners; ++k) middle += corner(k) / static_cast<double>(corners);
  std::vector<Corners> tetrahedra;
  for (const std::vector<int>& face : faces_with(corners)) {
    if (face.size() == 3) {
      tetrahedra.push_back({middle, corner(face[0]), corner(face[1]), corner(face[2])});
      continue;
    }
    const Eigen::Vector3d of_face = (corner(face[0]) + corner(face[1]) + corner(face[2]) + corner(face[3])) / 4;
    for (std::size_t k = 0; k < 4; ++k)
      tetrahedra.push_back({middle, of_face, corner(face[k]), corner(face[(k + 1) % 4])});
  }
  return tetrahedra;
}

void Bodies::join_bodies() {
  const auto region = std::ranges::find(grid_.on_cells, "region", &GridData::Array::name);
  const auto are_of_one_region = [&](int one, int other) {
    return region == grid_.on_cells.end() || region->values[one] == region->values[other];
  };
  std::vector<std::pair<std::array<std::int64_t, 4>, int>> faces;
  for (int body = 0; body < count(); ++body) {
    const std::int64_t begin = begin_of(grid_, body);
    for (const std::vector<int>& face : faces_with(grid_.cell_ends[body] - begin)) {
      std::array<std::int64_t, 4> nodes{-1, -1, -1, -1};
      for (std::size_t k = 0; k < face.size(); ++k) nodes[k] = grid_.cell_points[begin + face[k]];
      std::ranges::sort(nodes);
      faces.emplace_back(nodes, body);
    }
  }
  std::ranges::sort(faces);
  for (std::size_t k = 0; k + 1 < faces.size(); ++k) {
    const int one = faces[k].second, other = faces[k + 1].second;
    if (faces[k].first != faces[k + 1].first || !are_of_one_region(one, other)) continue;
    beside_[one].push_back(other);
    beside_[other].push_back(one);
  }
}

std::array<int, 3> Bodies::box_at(const Eigen::Vector3d& place) const {
  std::array<int, 3> at{};
  for (int axis = 0; axis < 3; ++axis)
    at[axis] = std::clamp(static_cast<int>((place[axis] - low_[axis]) / box_[axis]), 0, boxes_[axis] - 1);
  return at;
}

void Bodies::fill_boxes() {
  const auto all = Eigen::Matrix3Xd::Map(grid_.points.data(), 3, grid_.point_count());
  low_ = all.rowwise().minCoeff();
  const Eigen::Vector3d size = all.rowwise().maxCoeff() - low_;
  const double edge = std::cbrt(size.prod() / std::max(count(), 1));
  for (int axis = 0; axis < 3; ++axis) {
    boxes_[axis] = static_cast<int>(size[axis] / edge) + 1;
    box_[axis] = size[axis] / boxes_[axis];
  }
  in_box_.resize(static_cast<std::size_t>(boxes_[0]) * boxes_[1] * boxes_[2]);
  for (int body = 0; body < count(); ++body) {
    Eigen::Vector3d low = centre(body), high = low;
    for (std::int64_t k = begin_of(grid_, body); k < grid_.cell_ends[body]; ++k) {
      low = low.cwiseMin(point(grid_, grid_.cell_points[k]));
      high = high.cwiseMax(point(grid_, grid_.cell_points[k]));
    }
    const std::array<int, 3> first = box_at(low), last = box_at(high);
    for (int k = first[2]; k <= last[2]; ++k)
      for (int j = first[1]; j <= last[1]; ++j)
        for (int i = first[0]; i <= last[0]; ++i) in_box_[(k * boxes_[1] + j) * boxes_[0] + i].push_back(body);
  }
}

std::optional<int> Bodies::holding(const Eigen::Vector3d& place) const {
  const auto [i, j, k] = box_at(place);
  std::optional<int> best;
  double deepest = -rounding::same;
  for (const int body : in_box_[(k * boxes_[1] + j) * boxes_[0] + i])
    for (const Corners& x : tetrahedra_of(body)) {
      double inside = std::numeric_limits<double>::infinity();
      for (std::size_t corner = 0; corner < 4; ++corner) {
        Corners moved = x;
        moved[corner] = place;
        inside = std::min(inside, six_volumes(moved) / six_volumes(x));
      }
      if (inside >= deepest) best = body, deepest = inside;
    }
  return best;
}

/// The bodies beside one; where these do not tell a gradient, also those beside them.
std::vector<int> Bodies::around(int body) const {
  constexpr std::size_t enough = 4;  // bodies, one more than directions: they tell a gradient and how far it is one
  if (beside_[body].size() >= enough) return beside_[body];
  std::set<int> all(beside_[body].begin(), beside_[body].end());
  for (const int next : beside_[body]) all.insert(beside_[next].begin(), beside_[next].end());
  all.erase(body);
  return {all.begin(), all.end()};
}

double Bodies::value_at(const std::vector<double>& values, int body, const Eigen::Vector3d& place) const {
  const std::vector<int> others = around(body);
  if (others.empty()) return values[body];
  const auto count = static_cast<Eigen::Index>(others.size());
  Eigen::MatrixXd directions(count, 3);
  Eigen::VectorXd changes(count);
  for (Eigen::Index k = 0; k < count; ++k) {
    const Eigen::Vector3d step = centre(others[k]) - centre(body);
    directions.row(k) = step / step.norm();
    changes[k] = (values[others[k]] - values[body]) / step.norm();
  }
  return values[body] + LeastSquares(directions, rounding::far_above).solve(changes).dot(place - centre(body));
}

}  // namespace sprekk
