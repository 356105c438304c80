#include "framework/results/cell_sampler.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "framework/dense/least_squares.hpp"
#include "framework/round_off.hpp"

namespace sprekk {
namespace {

using Edge = std::pair<Position, Position>;

Edge edge_of(const Position& a, const Position& b) { return a < b ? Edge{a, b} : Edge{b, a}; }

double twice_area(const Position& a, const Position& b, const Position& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

bool is_whole(const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(), [](double value) { return value == std::round(value); });
}

std::size_t at(int i) { return static_cast<std::size_t>(i); }
std::size_t index_of(int i) { return static_cast<std::size_t>(i); }  // where `at` is a member

}  // namespace

CellSampler::CellSampler(const Grid& grid, const Grid& walls) : grid_(grid) {
  add_parts();
  if (grid.points_per_cell == 3) {
    join_triangles(walls);
    fill_boxes();
  } else {
    join_lines();
  }
}

Position CellSampler::corner(int part, int k) const {
  return grid_.points[at(grid_.cells[at(grid_.points_per_cell * part + k)])];
}

void CellSampler::add_parts() {
  const Grid::Values* const group = grid_.find(grid_.points_per_cell == 3 ? "region" : "fracture");
  for (int part = 0; part < grid_.cell_count(); ++part) {
    const int number = grid_.sources[at(part)];
    if (number >= cell_count()) cells_.resize(at(number) + 1);
    Cell& cell = cells_[at(number)];
    cell.parts.push_back(part);
    if (group != nullptr) cell.group = static_cast<int>(group->values[at(part)]);
    Position middle{};
    for (int k = 0; k < grid_.points_per_cell; ++k)
      for (const int axis : {0, 1}) middle[at(axis)] += corner(part, k)[at(axis)] / grid_.points_per_cell;
    const Position a = corner(part, 0), b = corner(part, 1);
    const double size = grid_.points_per_cell == 2 ? std::hypot(b[0] - a[0], b[1] - a[1])
                                                   : std::abs(twice_area(a, b, corner(part, 2))) / 2;
    for (const int axis : {0, 1})
      cell.centre[at(axis)] += size / (cell.size + size) * (middle[at(axis)] - cell.centre[at(axis)]);
    cell.size += size;
  }
}

void CellSampler::join_triangles(const Grid& walls) {
  std::set<Edge> closed;
  for (int line = 0; line < walls.cell_count(); ++line)
    closed.insert(
        edge_of(walls.points[at(walls.cells[at(2 * line)])], walls.points[at(walls.cells[at(2 * line + 1)])]));
  std::map<std::pair<int, int>, int> first;  // the cell at each edge
  for (int part = 0; part < grid_.cell_count(); ++part)
    for (int k = 0; k < 3; ++k) {
      const int a = grid_.cells[at(3 * part + k)], b = grid_.cells[at(3 * part + (k + 1) % 3)];
      const int here = grid_.sources[at(part)];
      const auto [found, is_new] = first.try_emplace({std::min(a, b), std::max(a, b)}, here);
      const int there = found->second;
      if (is_new || there == here || group(here) != group(there)) continue;
      if (closed.count(edge_of(grid_.points[at(a)], grid_.points[at(b)])) > 0) continue;
      cells_[at(here)].beside.push_back(there);
      cells_[at(there)].beside.push_back(here);
    }
}

void CellSampler::join_lines() {
  std::map<std::pair<int, Position>, int> first;
  for (int part = 0; part < grid_.cell_count(); ++part)
    for (const int end : {0, 1}) {
      const int here = grid_.sources[at(part)];
      const auto [found, is_new] = first.try_emplace({group(here), corner(part, end)}, here);
      if (is_new) continue;
      cells_[at(here)].beside.push_back(found->second);
      cells_[at(found->second)].beside.push_back(here);
    }
}

void CellSampler::fill_boxes() {
  const double infinite = std::numeric_limits<double>::infinity();
  Position highest{-infinite, -infinite};
  lowest_ = {infinite, infinite};
  for (const Position& point : grid_.points)
    for (const int axis : {0, 1}) {
      lowest_[at(axis)] = std::min(lowest_[at(axis)], point[at(axis)]);
      highest[at(axis)] = std::max(highest[at(axis)], point[at(axis)]);
    }
  const double width = highest[0] - lowest_[0], height = highest[1] - lowest_[1];
  box_ = std::sqrt(width * height / std::max(grid_.cell_count(), 1));
  columns_ = static_cast<int>(width / box_) + 1;
  rows_ = static_cast<int>(height / box_) + 1;
  in_box_.resize(at(columns_) * at(rows_));
  for (int part = 0; part < grid_.cell_count(); ++part) {
    std::array<int, 2> low{}, high{};
    for (const int axis : {0, 1}) {
      const auto [least, most] =
          std::minmax({corner(part, 0)[at(axis)], corner(part, 1)[at(axis)], corner(part, 2)[at(axis)]});
      const int last = (axis == 0 ? columns_ : rows_) - 1;
      low[at(axis)] = std::clamp(static_cast<int>((least - lowest_[at(axis)]) / box_), 0, last);
      high[at(axis)] = std::clamp(static_cast<int>((most - lowest_[at(axis)]) / box_), 0, last);
    }
    for (int row = low[1]; row <= high[1]; ++row)
      for (int column = low[0]; column <= high[0]; ++column) in_box_[at(row * columns_ + column)].push_back(part);
  }
}

std::array<double, 3> CellSampler::shares(int part, const Position& place) const {
  const Position a = corner(part, 0), b = corner(part, 1), c = corner(part, 2);
  const double whole = twice_area(a, b, c);
  return {twice_area(place, b, c) / whole, twice_area(a, place, c) / whole, twice_area(a, b, place) / whole};
}

Position CellSampler::nearest_of_line(int part, const Position& place) const {
  const Position a = corner(part, 0), b = corner(part, 1);
  const double x = b[0] - a[0], y = b[1] - a[1];
  const double share = std::clamp(((place[0] - a[0]) * x + (place[1] - a[1]) * y) / (x * x + y * y), 0.0, 1.0);
  return {a[0] + share * x, a[1] + share * y};
}

std::optional<int> CellSampler::part_at(const Position& place, int group) const {
  std::optional<int> best;
  if (grid_.points_per_cell == 3) {
    const double column = (place[0] - lowest_[0]) / box_, row = (place[1] - lowest_[1]) / box_;
    if (!(column >= -1 && column <= columns_ && row >= -1 && row <= rows_)) return best;
    const int box = std::clamp(static_cast<int>(row), 0, rows_ - 1) * columns_ +
                    std::clamp(static_cast<int>(column), 0, columns_ - 1);
    double deepest = -rounding::same;
    for (const int part : in_box_[at(box)]) {
      const std::array<double, 3> s = shares(part, place);
      const double inside = std::min({s[0], s[1], s[2]});
      if (inside >= deepest) best = part, deepest = inside;
    }
    return best;
  }
  double nearest = std::numeric_limits<double>::infinity();
  for (int part = 0; part < grid_.cell_count(); ++part) {
    if (this->group(grid_.sources[at(part)]) != group) continue;
    const Position foot = nearest_of_line(part, place);
    const double distance = std::hypot(foot[0] - place[0], foot[1] - place[1]);
    if (distance < nearest) best = part, nearest = distance;
  }
  return best;
}

double CellSampler::from_points(const Grid::Values& array, int component, int part, const Position& place) const {
  std::array<double, 3> share{};
  if (grid_.points_per_cell == 3) {
    share = shares(part, place);
  } else {
    const Position a = corner(part, 0), b = corner(part, 1), foot = nearest_of_line(part, place);
    share[1] = std::hypot(foot[0] - a[0], foot[1] - a[1]) / std::hypot(b[0] - a[0], b[1] - a[1]);
    share[0] = 1 - share[1];
  }
  double value = 0;
  for (int k = 0; k < grid_.points_per_cell; ++k)
    value += share[at(k)] *
             array.values[at(grid_.cells[at(grid_.points_per_cell * part + k)] * array.components + component)];
  return value;
}

std::vector<double> CellSampler::values(const Grid::Values& array, int component) const {
  std::vector<double> values;
  for (const Cell& cell : cells_) {
    const int part = cell.parts.empty() ? 0 : cell.parts.front();
    if (array.place == Grid::Place::cell) {
      values.push_back(array.values[at(part * array.components + component)]);
      continue;
    }
    double value = 0;  // the mean over the cell
    for (const int piece : cell.parts) {
      const Position a = corner(piece, 0), b = corner(piece, 1), c = corner(piece, grid_.points_per_cell - 1);
      const bool is_line = grid_.points_per_cell == 2;
      const Position middle = is_line ? Position{(a[0] + b[0]) / 2, (a[1] + b[1]) / 2}
                                      : Position{(a[0] + b[0] + c[0]) / 3, (a[1] + b[1] + c[1]) / 3};
      const double share = is_line ? 1 : std::abs(twice_area(a, b, c)) / 2 / cell.size;
      value += share * from_points(array, component, piece, middle);
    }
    values.push_back(value);
  }
  return values;
}

std::vector<double> CellSampler::values_at(const Grid::Values& array, int component,
                                           const std::vector<Position>& places, const std::vector<int>& parts) const {
  const SampledArray sampled(*this, array, component);
  std::vector<double> values;
  for (std::size_t i = 0; i < places.size(); ++i) values.push_back(sampled.at(places[i], parts[i]));
  return values;
}

SampledArray::SampledArray(const CellSampler& cells, const Grid::Values& array, int component)
    : cells_(cells), array_(array), component_(component) {
  if (array.place == Grid::Place::point) return;
  own_ = cells.values(array, component);
  has_steps_ = is_whole(own_);
}

Position SampledArray::gradient(int cell) const {
  const auto [found, is_new] = gradients_.try_emplace(cell, Position{});
  if (!is_new) return found->second;
  const std::vector<int>& beside = cells_.cells_[index_of(cell)].beside;
  const auto count = static_cast<Eigen::Index>(beside.size());
  Eigen::MatrixXd directions(count, 2);
  Eigen::VectorXd changes(count);
  for (Eigen::Index k = 0; k < count; ++k) {
    const int other = beside[static_cast<std::size_t>(k)];
    const Eigen::Vector2d step(cells_.centre(other)[0] - cells_.centre(cell)[0],
                               cells_.centre(other)[1] - cells_.centre(cell)[1]);
    directions.row(k) = step / step.norm();
    changes[k] = (own_[index_of(other)] - own_[index_of(cell)]) / step.norm();
  }
  const Eigen::Vector2d solved = LeastSquares(directions, rounding::far_above).solve(changes);
  found->second = {solved[0], solved[1]};
  return found->second;
}

double SampledArray::at(const Position& place, int part) const {
  if (array_.place == Grid::Place::point) return cells_.from_points(array_, component_, part, place);
  const int cell = cells_.grid_.sources[index_of(part)];
  if (has_steps_ || cells_.cells_[index_of(cell)].beside.empty()) return own_[index_of(cell)];
  const Position here = cells_.grid_.points_per_cell == 2 ? cells_.nearest_of_line(part, place) : place;
  const Position slope = gradient(cell), centre = cells_.centre(cell);
  return own_[index_of(cell)] +
         Eigen::Vector2d(slope[0], slope[1]).dot(Eigen::Vector2d(here[0] - centre[0], here[1] - centre[1]));
}

}  // namespace sprekk
