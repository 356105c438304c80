#include "couplers/well_exchange/space/line_patch.hpp"

#include <cmath>
#include <numbers>
#include <set>
#include <stdexcept>

#include "framework/invariants.hpp"

namespace sprekk::couplers {
namespace {

constexpr int most_layers = 8;    // as in a plane, where a line between two sides has its index
constexpr int most_cells = 4000;  // a tenth of a second for each; on tetrahedra two layers: the index to 1 %
constexpr double same = 1e-9;     // of a direction; a distance from a plane is compared with 1 m and its coordinates

/// Whether a face lies in one of the planes.
bool lies_in(const Mesh& mesh, int face, const std::vector<ClosedPlane>& planes) {
  for (const auto& [at, normal] : planes) {
    const double away = std::abs(normal.dot(mesh.face_center[face] - at));
    if (std::abs(normal.dot(mesh.face_normal[face])) > 1 - same && away < same * (1 + at.norm())) return true;
  }
  return false;
}

/// Whether a cell touches nothing but rock and these planes.
bool is_inside(const Mesh& mesh, int cell, const std::vector<ClosedPlane>& planes) {
  for (const int node : mesh.cell_nodes[cell])
    for (const int face : mesh.node_faces[node])
      if (mesh.face_cells[face][1] == none && (mesh.face_side[face] == none || !lies_in(mesh, face, planes)))
        return false;
  return true;
}

std::vector<int> patch(const Mesh& mesh, const std::map<int, double>& lengths, const std::vector<ClosedPlane>& planes) {
  std::vector<int> cells;
  std::set<int> known;
  for (const auto& [cell, length] : lengths) {
    cells.push_back(cell);
    known.insert(cell);
  }
  std::size_t first = 0;
  for (int layer = 0; layer < most_layers; ++layer) {
    std::vector<int> next;
    for (std::size_t k = first; k < cells.size(); ++k)
      for (const int node : mesh.cell_nodes[cells[k]])
        for (const int other : mesh.node_cells[node])
          if (known.insert(other).second && is_inside(mesh, other, planes)) next.push_back(other);
    if (layer > 0 && cells.size() + next.size() > most_cells) break;
    first = cells.size();
    cells.insert(cells.end(), next.begin(), next.end());
  }
  return cells;
}

}  // namespace

TouchedSides touched_sides(const Mesh& mesh, const std::map<int, double>& cells) {
  TouchedSides touched;
  for (const auto& [cell, length] : cells)
    for (const int node : mesh.cell_nodes[cell])
      for (const int face : mesh.node_faces[node]) {
        if (mesh.face_cells[face][1] != none) continue;
        if (mesh.face_side[face] == none)
          touched.has_fracture = true;
        else if (!lies_in(mesh, face, touched.planes))
          touched.planes.push_back({mesh.face_center[face], mesh.face_normal[face]});
      }
  return touched;
}

LinePatch::LinePatch(const Mesh& mesh, const MatrixFluxes& fluxes, const std::map<int, double>& lengths,
                     const LineField& field, const Tensor& mobility, const std::vector<ClosedPlane>& planes)
    : field_(field) {
  const std::vector<int> cells = patch(mesh, lengths, planes);
  for (const auto& [cell, length] : lengths) lengths_.push_back(length);
  std::vector<char> nodes(mesh.node_count(), 0);
  std::vector<int> place(mesh.cell_count(), none);
  for (const int cell : cells) {
    place[cell] = static_cast<int>(volumes_.size());
    volumes_.push_back(mesh.cell_measure[cell]);
    for (const int node : mesh.cell_nodes[cell]) nodes[node] = 1;
  }
  const FluxOperators operators = fluxes.fluxes_around(nodes, mobility);
  if (operators.faces.flux.rows() > 0) throw std::invalid_argument("its discretization has unknowns on faces");
  if (operators.limited[0].cell.rows() > 0) throw std::invalid_argument("its fluxes are not linear in the pressures");
  std::map<int, int> points;
  for (const int cell : cells)
    for (const int face : mesh.cell_faces[cell]) {
      const double sign = mesh.face_cells[face][0] == cell ? 1 : -1;
      for (SparseMatrix::InnerIterator entry(operators.flux_cell, face); entry; ++entry) {
        const int other = static_cast<int>(entry.col());
        if (place[other] != none) {
          entries_.emplace_back(place[cell], place[other], sign * entry.value());
        } else if (entry.value() != 0) {
          const auto [point, is_new] = points.try_emplace(other, static_cast<int>(points_.size()));
          if (is_new) points_.push_back(mesh.cell_center[other]);
          outside_.push_back({place[cell], point->second, sign * entry.value()});
        }
      }
    }
  if (outside_.empty()) throw std::invalid_argument("there is no rock around its cells");
}

/// The balances m V decay p + outflow(p) = 2 pi m length in the cells of the line and 0 elsewhere.
std::vector<double> LinePatch::solve(double decay, const std::function<double(const Point&)>& outside) const {
  const int count = static_cast<int>(volumes_.size());
  Vector right = Vector::Zero(count);
  for (std::size_t i = 0; i < lengths_.size(); ++i)
    right[static_cast<int>(i)] = 2 * std::numbers::pi * field_.mobility() * lengths_[i];
  std::vector<double> around;
  for (const Point& point : points_) around.push_back(outside(point));
  for (const Outside& each : outside_) right[each.row] -= each.weight * around[each.point];
  std::vector<Triplet> entries = entries_;
  for (int i = 0; i < count; ++i) entries.emplace_back(i, i, field_.mobility() * volumes_[i] * decay);
  Eigen::SparseMatrix<double> system(count, count);
  system.setFromTriplets(entries.begin(), entries.end());
  const bool is_regular = solver_.factorize(system);
  SPREKK_ASSERT(is_regular, count);
  const Vector pressure = solver_.solve(right);
  return {pressure.data(), pressure.data() + lengths_.size()};
}

std::vector<double> LinePatch::pressures() const {
  return solve(0, [this](const Point& x) { return field_.pressure(x); });
}

std::vector<double> LinePatch::transformed_pressures(double decay) const {
  SPREKK_EXPECT(decay > 0, decay);
  return solve(decay, [this, decay](const Point& x) { return field_.transformed_pressure(x, decay); });
}

}  // namespace sprekk::couplers
