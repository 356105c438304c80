// The common part of couplers of fluid and of heat between fractures and rock.
#pragma once

#include <cmath>
#include <utility>
#include <vector>

#include "framework/assembly/assembly.hpp"
#include "framework/field/ownership.hpp"
#include "framework/invariants.hpp"
#include "framework/matrix_of.hpp"
#include "framework/mesh/mesh.hpp"

namespace sprekk::couplers {

/// Fluxes through walls, from the fracture into the matrix.
struct WallFluxes {
  explicit WallFluxes(const Mesh& mesh) {
    std::vector<Triplet> ones, measures;
    for (int w = 0; w < mesh.wall_count(); ++w) {
      ones.emplace_back(w, w / 2, 1.0);
      measures.emplace_back(w / 2, w, mesh.fracture_cells[w / 2].measure);
    }
    to_walls = matrix_of(mesh.wall_count(), mesh.fracture_cell_count(), ones);
    outflow = Operator(matrix_of(mesh.fracture_cell_count(), mesh.wall_count(), measures));
  }
  SparseMatrix to_walls;  ///< walls × fracture cells: ones
  Operator outflow;       ///< fracture cells × walls: rates out of the fracture cells by fluxes
};

/// The conductance of the matrix in front of each wall, one over the derivative of `trace` by the flux: m/(Pa s), or
/// W/(m^2 K) for heat; 1 where the matrix has no resistance. `trace`: the pressure or temperature at the walls.
/// Collective.
inline Vector conductance_in_front(const Mesh& mesh, const LinearExpression& trace, const Field& flux) {
  SPREKK_EXPECT(flux.size() == mesh.wall_count(), flux.name(), flux.size(), mesh.wall_count());
  Vector conductance = Vector::Ones(mesh.wall_count());
  for (const LinearExpression::Term& term : trace.terms)
    if (term.field == &flux)
      for (int w = 0; w < mesh.wall_count(); ++w) {
        const double resistance = term.matrix.entries().coeff(w, w);
        SPREKK_ASSERT(std::isfinite(resistance), w, resistance);
        if (resistance > 0) conductance[w] = 1 / resistance;
      }
  exchange(mesh, Location::wall, 1, conductance);
  return conductance;
}

/// residual(row) += diag(factors) · trace, with its derivatives. Returns the trace. The trace may be a small difference
/// of large terms, as where the matrix drains into a fracture with low pressure: its round-off is that of these terms.
inline Vector add_trace(Assembly& assembly, const Field& row, const LinearExpression& trace, const Vector& factors) {
  Vector now = trace.now();
  SPREKK_ASSERT(now.size() == factors.size(), row.name(), now.size(), factors.size());
  assembly.add(row, factors.cwiseProduct(now));
  for (const LinearExpression::Term& term : trace.terms) {
    assembly.compare_round_off(row,
                               factors.cwiseProduct(term.matrix.entries().cwiseAbs() * term.field->now().cwiseAbs())
                                   .lpNorm<Eigen::Infinity>());
    if (assembly.wants_derivatives())
      assembly.derivative(row, *term.field, SparseMatrix(factors.asDiagonal() * term.matrix.entries()));
  }
  return now;
}

}  // namespace sprekk::couplers
