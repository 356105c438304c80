// The flow along fractures of a fluid whose weight follows a density that varies.
#include "components/fracture_flow/tpfa/flux_rows.hpp"
#include "components/fracture_flow/tpfa/fracture_flow.hpp"
#include "framework/invariants.hpp"
#include "framework/matrix_of.hpp"

namespace sprekk::fracture_flow {

/// From the centre x of a cell to the mean y of the centres of all cells at a ridge or junction, the weight is (d(x) +
/// d(y))/2 g·(x − y), with the excess d of the density and the mean of these cells in the place of d(y). This is exact
/// for densities that are linear in space, also where fractures bend, and adds up to nothing around a junction.
void FractureFlow::weigh_links() {
  for (Link& link : links_) {
    link.by_density.clear();
    link.excess_at_end = 0;
    const Point& position = mesh_.ridges[link.ridge].center;
    const Point gravity = options_.gravity.at({position, 0, 0});
    if (link.second == none) {
      const double weight = gravity.dot(mesh_.fracture_cells[link.first].center - position);
      const std::optional<double> at_end = density_->at_boundary(link.ridge, link.boundary_pressure);
      if (at_end) link.excess_at_end = 0.5 * weight * (*at_end - options_.fluid_density);
      link.by_density.emplace_back(link.first, at_end ? 0.5 * weight : weight);
      continue;
    }
    std::vector<int> cells = {link.first, link.second};
    if (link.junction != none) cells = mesh_.junctions[link.junction].cells;
    const double share = 1.0 / static_cast<double>(cells.size());
    Point middle = Point::Zero();
    for (const int cell : cells) middle += share * mesh_.fracture_cells[cell].center;
    const double first = 0.5 * gravity.dot(mesh_.fracture_cells[link.first].center - middle);
    const double second = -0.5 * gravity.dot(mesh_.fracture_cells[link.second].center - middle);
    link.by_density = {{link.first, first}, {link.second, second}};
    for (const int cell : cells) link.by_density.emplace_back(cell, share * (first + second));
  }
}

void FractureFlow::find_excess() const {
  excess_ = density_->values(FluidDensity::State::now).array() - options_.fluid_density;
  SPREKK_ASSERT(excess_.size() == mesh_.fracture_cell_count() && is_finite(excess_), excess_.size());
}

double FractureFlow::varying_weight(const Link& link) const {
  double weight = link.excess_at_end;
  for (const auto& [cell, factor] : link.by_density) weight += factor * excess_[cell];
  return weight;
}

void FractureFlow::assemble_density(Assembly& assembly, const FluxRows& rows) const {
  const SparseMatrix of_cells = matrix_of(flux_.size(), mesh_.fracture_cell_count(), rows.by_density);
  for (const FluidDensity::Derivative& by : density_->derivatives())
    assembly.derivative(flux_, *by.field, SparseMatrix(of_cells * by.values.asDiagonal()));
}

}  // namespace sprekk::fracture_flow
