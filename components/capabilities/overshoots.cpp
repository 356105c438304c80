#include "components/capabilities/overshoots.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "framework/discretization/changes_along_face.hpp"
#include "framework/noticeable.hpp"
#include "framework/parallel/parallel.hpp"
#include "framework/round_off.hpp"

namespace sprekk {
namespace {

/// Inflow other than through faces is a source if it exceeds this share of all fluxes and of the storage.
constexpr double least_share_of_source = 1e-3;

/// The amount that a cell receives other than through its inner faces and from prescribed pressures, as a share of all
/// that it exchanges and stores.
double share_of_source(const FlowStep& step, int cell) {
  const double stored = step.capacity[cell] * (step.potential[cell] - step.potential_before[cell]);
  double source = stored, all = std::abs(stored);
  for (const int face : step.mesh.cell_faces[cell]) {
    if (step.conditions[face] == FlowCondition::flux) continue;
    const double outflow = (step.mesh.face_cells[face][0] == cell ? 1 : -1) * step.dt * step.fluxes[face];
    source += outflow;
    all += std::abs(outflow);
  }
  return all > 0 ? source / all : 0;
}

/// By how much the potential on a face, times `sign`, exceeds that at its centre.
double highest_on_face(const FlowStep& step, int face, double sign) {
  AlongFace changes;
  for (int k = 0; k < directions_of_faces; ++k)
    changes[k] = sign * step.boundary_changes[directions_of_faces * face + k];
  return highest_along_face(step.mesh, face, changes);
}

/// By how much the potential of a cell, times `sign`, exceeds all potentials from which fluid may have come.
double excess(const FlowStep& step, int cell, double sign) {
  const double own = sign * step.potential[cell];
  double largest = sign * step.potential_before[cell];
  for (const int face : step.mesh.cell_faces[cell])
    if (step.conditions[face] == FlowCondition::pressure)
      largest = std::max(largest, sign * step.boundary_values[face] + highest_on_face(step, face, sign));
  for (const int node : step.mesh.cell_nodes[cell]) {
    if (largest >= own) return 0;
    for (const int other : step.mesh.node_cells[node])
      if (other != cell) largest = std::max(largest, sign * step.potential[other]);
  }
  return std::max(0.0, own - largest);
}

double range_of(const FlowStep& step) {
  double highest = -std::numeric_limits<double>::infinity(), lowest = -highest;
  const auto reach = [&](double potential) {
    highest = std::max(highest, potential);
    lowest = std::min(lowest, potential);
  };
  for (const Vector* potentials : {&step.potential, &step.potential_before})
    for (const double potential : *potentials) reach(potential);
  for (int face = 0; face < step.mesh.face_count(); ++face)
    if (step.conditions[face] == FlowCondition::pressure) reach(step.boundary_values[face]);
  return parallel::max(highest) + parallel::max(-lowest);
}

}  // namespace

Overshoots find_overshoots(const FlowStep& step) {
  Overshoots found;
  found.range = range_of(step);
  // Of the base of potentials: what Newton's method leaves is less.
  if (!(found.range > rounding::same * step.base)) return found;
  double cells = 0;
  for (int cell = 0; cell < step.mesh.cell_count(); ++cell) {
    if (step.mesh.cell_rank[cell] != parallel::rank()) continue;
    for (const double sign : {1.0, -1.0}) {
      const double above = excess(step, cell, sign);
      if (above <= noticeable * found.range || sign * share_of_source(step, cell) > least_share_of_source) continue;
      ++cells;
      if (above > found.largest) found.cell = cell;
      found.largest = std::max(found.largest, above);
    }
  }
  found.cells = std::lround(parallel::sum(cells));
  const double largest = parallel::max(found.largest);
  found.cell = static_cast<int>(parallel::max(found.largest == largest ? found.cell : none));
  found.largest = largest;
  return found;
}

}  // namespace sprekk
