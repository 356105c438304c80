#include "couplers/well_exchange/space/line_patch.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <set>
#include <stdexcept>

#include "framework/invariants.hpp"
#include "framework/round_off.hpp"

namespace sprekk::couplers {
namespace {

constexpr int most_layers = 8;    // as in a plane, where a line between two sides has its index
constexpr int most_cells = 4000;  // a tenth of a second for each; on tetrahedra two layers: the index to 1 %
constexpr double same = 1e-9;     // of a direction, and of lengths of a face

/// Whether a face lies in one of the planes.
bool lies_in(const Mesh& mesh, int face, const std::vector<ClosedPlane>& planes) {
  for (const auto& [at, normal] : planes) {
    const double away = std::abs(normal.dot(mesh.face_center[face] - at));
    const double size = std::sqrt(mesh.face_measure[face]), coordinates = at.cwiseAbs().maxCoeff();
    if (normal.cross(mesh.face_normal[face]).norm() < same && away < same * size + rounding::of_sum * coordinates)
      return true;
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
    : field_(field), cells_(mesh, fluxes, patch(mesh, lengths, planes), mobility) {
  for (const auto& [cell, length] : lengths) lengths_.push_back(length);
  if (cells_.is_alone()) throw std::invalid_argument("there is no rock around its cells");
}

/// The balances m V decay p + outflow(p) = 2 pi m length in the cells of the line and 0 elsewhere.
std::vector<double> LinePatch::solve(double decay, const std::function<double(const Point&)>& around) const {
  Vector supply = Vector::Zero(static_cast<int>(cells_.cells().size()));
  for (std::size_t i = 0; i < lengths_.size(); ++i)
    supply[static_cast<int>(i)] = 2 * std::numbers::pi * field_.mobility() * lengths_[i];
  const Vector pressure = cells_.solve(field_.mobility() * decay, supply, around);
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
