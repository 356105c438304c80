#include "couplers/advection/limited_values.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "framework/field/ownership.hpp"
#include "framework/invariants.hpp"
#include "framework/round_off.hpp"

namespace sprekk::couplers {
namespace {

// Smallest over largest eigenvalue of the moments of directions to neighbours (1 where these lie evenly around).
constexpr double hardly_apart = 1e-2;  // below it more neighbours are taken

// The part of the rise and the fall around a fracture cell that a change may have (minmod in a row of equal cells).
// Where fluid passes many cells in a step, Newton's method does not always converge with the whole of it.
constexpr double part_in_fractures = 0.5;

/// The moments of the directions from a cell to what is around it.
template <class Links>
Eigen::SelfAdjointEigenSolver<Tensor> moments_of(const Links& links) {
  Tensor moments = Tensor::Zero();
  for (const auto& link : links) moments += link.where * link.where.transpose() / link.where.squaredNorm();
  return Eigen::SelfAdjointEigenSolver<Tensor>(moments);
}

/// Whether the directions have all components.
template <class Links>
bool fills_space(const Links& links) {
  const auto moments = moments_of(links).eigenvalues();
  return moments[0] > hardly_apart * moments[dimension - 1];
}

/// By least squares, in which near neighbours count more.
template <class Links>
void fit_gradients(Links& links) {
  if (links.empty()) return;
  const auto moments = moments_of(links);
  Tensor inverse = Tensor::Zero();
  for (int k = 0; k < dimension; ++k) {
    const double size = moments.eigenvalues()[k];
    const Point axis = moments.eigenvectors().col(k);
    if (size > rounding::half_of_digits * moments.eigenvalues()[dimension - 1])
      inverse += axis * axis.transpose() / size;
  }
  for (auto& link : links) link.gradient = inverse * link.where / link.where.squaredNorm();
}

void sort_once(std::vector<int>& cells) {
  std::ranges::sort(cells);
  cells.erase(std::ranges::unique(cells).begin(), cells.end());
}

}  // namespace

LimitedValues::LimitedValues(const Mesh& mesh, const MatrixCarried& carried) : mesh_(&mesh), rock_(&carried) {
  look_around_in_rock();
  for (Around& around : around_) fit_gradients(around.links);
  given_ = Vector::Zero(mesh.face_count());
}

LimitedValues::LimitedValues(const Mesh& mesh, const FractureCarried& carried) : mesh_(&mesh), fractures_(&carried) {
  look_around_in_fractures();
  for (Around& around : around_) fit_gradients(around.links);
  given_ = Vector::Zero(static_cast<int>(mesh.ridges.size()));
}

void LimitedValues::look_around_in_rock() {
  around_.resize(mesh_->cell_count());
  for (int c = 0; c < mesh_->cell_count(); ++c) {
    Around& around = around_[c];
    for (const int node : mesh_->cell_nodes[c])
      for (const int other : mesh_->node_cells[node])
        if (other != c) around.cells.push_back(other);
    sort_once(around.cells);
    for (const int face : mesh_->cell_faces[c]) {
      const auto& [first, second] = mesh_->face_cells[face];
      if (second != none) {
        const int other = first == c ? second : first;
        around.links.push_back({other, none, mesh_->cell_center[other] - mesh_->cell_center[c]});
      } else if (mesh_->face_side[face] != none && is_given(face)) {
        around.links.push_back({none, face, mesh_->face_center[face] - mesh_->cell_center[c]});
      }
    }
    if (!around.links.empty() && fills_space(around.links)) continue;
    std::erase_if(around.links, [](const Link& link) { return link.cell != none; });
    for (const int other : around.cells)
      around.links.push_back({other, none, mesh_->cell_center[other] - mesh_->cell_center[c]});
  }
}

void LimitedValues::look_around_in_fractures() {
  const auto& cells = mesh_->fracture_cells;
  // Fracture cells. Behind a crossing the plus side has other nodes.
  std::vector<std::vector<int>> at_node(mesh_->node_count());
  for (int i = 0; i < mesh_->fracture_cell_count(); ++i)
    for (const int node : mesh_->face_nodes[cells[i].faces[0]]) at_node[node].push_back(i);
  // Another cell as seen in the plane of a cell, after a turn about the ridge between them.
  const auto seen_from = [&](int cell, int other, const Point& ridge) -> Point {
    const Point beyond = cells[other].center - ridge, &normal = cells[cell].normal;
    const Point both = normal + cells[other].normal;
    const Point turned = beyond - both * (2 * normal.dot(beyond) / both.squaredNorm());
    return ridge - cells[cell].center + turned;
  };
  around_.resize(cells.size());
  for (int i = 0; i < mesh_->fracture_cell_count(); ++i) {
    Around& around = around_[i];
    for (const int node : mesh_->face_nodes[cells[i].faces[0]])
      for (const int other : at_node[node])
        if (other != i && cells[other].fracture == cells[i].fracture) around.cells.push_back(other);
    for (const int p : cells[i].ridges) {
      const Ridge& ridge = mesh_->ridges[p];
      if (ridge.kind == Ridge::Kind::inside) {
        const int other = ridge.cells[ridge.cells[0] == i ? 1 : 0];
        constexpr double folded = 1e-3;  // of two normals: a fracture that turns back on itself
        if ((cells[i].normal + cells[other].normal).norm() < folded) continue;
        around.links.push_back({other, none, seen_from(i, other, ridge.center)});
        around.cells.push_back(other);
      } else if (ridge.kind == Ridge::Kind::on_boundary && is_given(p)) {
        around.links.push_back({none, p, ridge.center - cells[i].center});
      }
    }
    sort_once(around.cells);
  }
}

void LimitedValues::begin_step() {
  for (const Around& around : around_)
    for (const Link& link : around.links)
      if (link.side != none)
        given_[link.side] = (rock_ ? rock_->side_value(link.side) : fractures_->end_value(link.side)).value_or(0);
}

Vector LimitedValues::weights(const std::vector<Stream>& streams, const Vector& capacity, double amount) const {
  if (fractures_) return {};
  Vector outflow = Vector::Zero(static_cast<int>(around_.size()));
  for (const Stream& stream : streams) outflow[stream.cell] += amount * std::max(-stream.rate, 0.0);
  exchange(*mesh_, Location::cell, 1, outflow);
  for (int c = 0; c < outflow.size(); ++c) outflow[c] = outflow[c] > capacity[c] ? capacity[c] / outflow[c] : 1.0;
  return outflow;
}

LimitedValues::Change LimitedValues::of(const Stream& stream, const Vector& values, const Vector& weights) const {
  if (stream.flux != (rock_ ? Stream::Flux::face : Stream::Flux::ridge)) return {};
  const bool enters_from_outside = stream.is_outside && stream.rate > 0;
  if (enters_from_outside || stream.rate == 0) return {};
  const int cell = stream.rate > 0 ? stream.index : stream.cell;
  const Point to_face = rock_ ? Point(mesh_->face_center[stream.flux_index] - mesh_->cell_center[cell])
                              : Point(mesh_->ridges[stream.flux_index].center - mesh_->fracture_cells[cell].center);
  SPREKK_ASSERT(cell < static_cast<int>(around_.size()) && values.size() == static_cast<int>(around_.size()), cell);
  Change change = within_bounds(cell, to_face, values);
  if (weights.size() == 0) return change;
  change.value *= weights[cell];
  for (auto& [of, by] : change.by_cells) by *= weights[cell];
  return change;
}

LimitedValues::Change LimitedValues::within_bounds(int cell, const Point& to_face, const Vector& values) const {
  const Around& around = around_[cell];
  const double own = values[cell];
  double change = 0, highest = own, lowest = own;
  int of_highest = cell, of_lowest = cell;  // none for a given value
  const auto bound = [&](double value, int of) {
    if (value > highest) highest = value, of_highest = of;
    if (value < lowest) lowest = value, of_lowest = of;
  };
  for (const Link& link : around.links) {
    const double value = link.cell == none ? given_[link.side] : values[link.cell];
    change += link.gradient.dot(to_face) * (value - own);
    bound(value, link.cell);
  }
  for (const int other : around.cells) bound(values[other], other);
  const double part = fractures_ ? part_in_fractures : 1;
  const double rise = highest - own, fall = own - lowest, most = part * std::min(rise, fall);
  if (std::abs(change) < most) {
    Change linear{change};
    double by_own = 0;
    for (const Link& link : around.links) {
      const double by = link.gradient.dot(to_face);
      by_own -= by;
      if (link.cell != none) linear.by_cells.emplace_back(link.cell, by);
    }
    linear.by_cells.emplace_back(cell, by_own);
    return linear;
  }
  const double sign = change < 0 ? -1 : 1;
  Change limited{sign * most};
  const int of = rise < fall ? of_highest : of_lowest;
  if (of == cell) return limited;
  const double by = part * (rise < fall ? sign : -sign);
  if (of != none) limited.by_cells.emplace_back(of, by);
  limited.by_cells.emplace_back(cell, -by);
  return limited;
}

}  // namespace sprekk::couplers
