#include "components/matrix_flow/ntpfa/ntpfa.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>

#include "components/matrix_flow/check_conditions.hpp"
#include "components/matrix_flow/ntpfa/cell_rays.hpp"
#include "framework/invariants.hpp"

namespace sprekk::matrix_flow {
namespace {

/// The share of the common part of two fluxes that is not limited. With all of it the rest changes sign at more
/// faces, and is lost there; with half of it the flux is more accurate, and the bounds hold as well.
constexpr double taken_as_it_is = 0.5;

/// Rows of matrices for one quantity of each face.
struct Rows {
  std::vector<Triplet> cell, boundary, change;

  void add(int row, int cell_of, const RaySum& rays, double factor) {
    for (const auto& [weight, ray] : rays) {
      if (weight == 0) continue;
      if (ray.own != 0) cell.emplace_back(row, cell_of, factor * weight * ray.own);
      if (ray.cell != none) cell.emplace_back(row, ray.cell, factor * weight * ray.of_cell);
      if (ray.face != none) boundary.emplace_back(row, ray.face, factor * weight * ray.of_boundary);
      if (ray.face != none && ray.of_change != 0) change.emplace_back(row, ray.face, factor * weight * ray.of_change);
    }
  }
  void add_difference(int row, const std::array<int, 2>& cells, double factor) {
    cell.emplace_back(row, cells[0], factor);
    cell.emplace_back(row, cells[1], -factor);
  }
};

/// The flux out of a cell, its pressure less that at the ends of the rays.
double of_neighbour(const RaySum& rays, int cell) {
  double sum = 0;
  for (const auto& [weight, ray] : rays)
    if (ray.cell == cell) sum += weight * ray.of_cell;
  return sum;
}

class Discretization {
 public:
  Discretization(const Mesh& mesh, const std::vector<Tensor>& mobility, const std::vector<FlowCondition>& conditions)
      : mesh_(mesh), mobility_(mobility) {
    std::vector<CellRays> rays;
    rays.reserve(mesh.cell_count());
    for (int cell = 0; cell < mesh.cell_count(); ++cell) rays.emplace_back(mesh, mobility, conditions, cell);
    for (int face = 0; face < mesh.face_count(); ++face) {
      const auto [cell, other] = mesh.face_cells[face];
      SPREKK_ASSERT((conditions[face] == FlowCondition::none) == (other != none), face, other);
      const Point normal = mesh.face_measure[face] * mesh.face_normal[face];
      switch (conditions[face]) {
        case FlowCondition::none:
          add_inner(face, rays[cell].sum(mobility[cell] * normal), rays[other].sum(-mobility[other] * normal));
          break;
        case FlowCondition::pressure:
          add_pressure(face, rays[cell].sum(mobility[cell] * normal));
          break;
        case FlowCondition::flux:
          add_flux(face, rays[cell]);
          break;
      }
    }
  }

  FluxOperators operators() const {
    FluxOperators made = {matrix(flux_.cell, mesh_.cell_count()),      matrix(flux_.boundary, mesh_.face_count()),
                          matrix(flux_.change, mesh_.face_count()),    matrix(trace_.cell, mesh_.cell_count()),
                          matrix(trace_.boundary, mesh_.face_count()), matrix(trace_.change, mesh_.face_count()),
                          matrix(not_exact_, mesh_.face_count())};
    for (const int side : {0, 1}) {
      made.limited[side].cell = matrix(sides_[side].cell, mesh_.cell_count());
      made.limited[side].boundary = matrix(sides_[side].boundary, mesh_.face_count());
      made.limited[side].change = matrix(sides_[side].change, mesh_.face_count());
    }
    return made;
  }

 private:
  void add_inner(int face, const std::optional<RaySum>& from_first, const std::optional<RaySum>& from_second) {
    const std::array<int, 2>& cells = mesh_.face_cells[face];
    if (!from_first || !from_second) {
      not_exact_.emplace_back(face, face, 1);
      const double one = two_point(face, cells[0]), two = two_point(face, cells[1]);
      return flux_.add_difference(face, cells, one / (1 + one / two));
    }
    const double common =
        taken_as_it_is * std::min(of_neighbour(*from_first, cells[1]), of_neighbour(*from_second, cells[0]));
    if (common > 0) flux_.add_difference(face, cells, common);
    sides_[0].add(face, cells[0], *from_first, -1);
    sides_[1].add(face, cells[1], *from_second, 1);
    if (common > 0)
      for (Rows& side : sides_) side.add_difference(face, cells, -common);
  }

  void add_pressure(int face, const std::optional<RaySum>& rays) {
    const int cell = mesh_.face_cells[face][0];
    trace_.boundary.emplace_back(face, face, 1);
    if (rays) return flux_.add(face, cell, *rays, -1);
    not_exact_.emplace_back(face, face, 1);
    const double conductance = two_point(face, cell);
    flux_.cell.emplace_back(face, cell, conductance);
    flux_.boundary.emplace_back(face, face, -conductance);
  }

  /// The pressure at the centre: along the conormal to the line of the face, and along it from there.
  void add_flux(int face, const CellRays& rays) {
    const int cell = mesh_.face_cells[face][0];
    flux_.boundary.emplace_back(face, face, 1);
    trace_.cell.emplace_back(face, cell, 1);
    trace_.boundary.emplace_back(face, face, -1 / two_point(face, cell));
    const Point& normal = mesh_.face_normal[face];
    const Point conormal = mobility_[cell] * normal, to_face = mesh_.face_center[face] - mesh_.cell_center[cell];
    const Point along = to_face - normal.dot(to_face) / normal.dot(conormal) * conormal;
    if (along.isZero(0)) return;
    if (const auto sum = rays.sum_without_return(along, face)) return trace_.add(face, cell, *sum, 1);
    not_exact_.emplace_back(face, face, 1);
  }

  /// Between the centre of the cell and the line of the face, per pressure difference.
  double two_point(int face, int cell) const {
    const Point& normal = mesh_.face_normal[face];
    const double distance = std::abs(normal.dot(mesh_.face_center[face] - mesh_.cell_center[cell]));
    return mesh_.face_measure[face] * normal.dot(mobility_[cell] * normal) / distance;
  }

  SparseMatrix matrix(const std::vector<Triplet>& entries, int columns) const {
    SparseMatrix made(mesh_.face_count(), columns);
    made.setFromTriplets(entries.begin(), entries.end());
    return made;
  }

  const Mesh& mesh_;
  const std::vector<Tensor>& mobility_;
  Rows flux_, trace_;
  std::array<Rows, 2> sides_;
  std::vector<Triplet> not_exact_;
};

}  // namespace

FluxOperators discretize_ntpfa(const Mesh& mesh, const std::vector<Tensor>& mobility,
                               const std::vector<FlowCondition>& conditions, const std::vector<char>& nodes) {
  check_conditions(mesh, mobility, conditions, nodes);
  for (std::size_t cell = 0; cell < mobility.size(); ++cell)
    if (!(mobility[cell].trace() > 0 && mobility[cell].determinant() > 0))
      throw std::runtime_error("flux discretization: the mobility of cell " + std::to_string(cell) +
                               " is not positive definite");
  return Discretization(mesh, mobility, conditions).operators();
}

}  // namespace sprekk::matrix_flow
