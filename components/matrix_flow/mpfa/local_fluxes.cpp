#include "components/matrix_flow/mpfa/local_fluxes.hpp"

#include <stdexcept>
#include <string>

#include "framework/linear/eliminate.hpp"

namespace sprekk::matrix_flow {

void LocalFluxes::solve(const InteractionRegion& region, const std::vector<Tensor>& mobility,
                        const std::vector<FlowCondition>& conditions) {
  const int subcells = region.subcell_count();
  subfaces_ = region.subface_count();
  columns_ = subcells;
  for (int f = 0; f < subfaces_; ++f) columns_ += !region.is_inner(f);
  const int width = subfaces_ + columns_;
  system_.assign(subfaces_ * width, 0);

  int boundary_column = subfaces_ + subcells;
  for (int f = 0; f < subfaces_; ++f) {
    double* row = system_.data() + f * width;
    const FlowCondition condition = conditions[region.faces[f]];
    if (condition == FlowCondition::pressure) {
      row[f] = row[boundary_column++] = 1;
      continue;
    }
    // The fluxes out of the neighbours add up to zero, or to the half of what is prescribed for the face.
    for (const int k : region.neighbours[f]) {
      if (k == none) continue;
      const Subcell& subcell = region.subcells[k];
      const Point conormal = mobility[subcell.cell].transpose() * subcell.half_face[region.place(f, k)];
      for (int i = 0; i < 2; ++i) {
        const double weight = conormal.dot(subcell.gradient[i]);
        row[subcell.subfaces[i]] -= weight;
        row[subfaces_ + k] -= weight;
      }
    }
    if (!region.is_inner(f)) row[boundary_column++] = 0.5;
  }
  if (eliminate(system_.data(), subfaces_, width) < 1e-14)
    throw std::runtime_error("MPFA: singular local problem at a node of cell " +
                             std::to_string(region.subcells[0].cell) + " (is its mobility positive definite?)");

  fluxes_.assign(subfaces_ * columns_, 0);
  for (int f = 0; f < subfaces_; ++f) {
    // Of the two equal expressions for the flux, the one of the less permeable side suffers less from cancellation.
    int side = 0;
    if (region.is_inner(f)) {
      const auto trace = [&](int s) { return mobility[region.subcells[region.neighbours[f][s]].cell].trace(); };
      side = trace(1) < trace(0) ? 1 : 0;
    }
    const int k = region.neighbours[f][side];
    const Subcell& subcell = region.subcells[k];
    const Point conormal =
        (side == 0 ? -1.0 : 1.0) * (mobility[subcell.cell].transpose() * subcell.half_face[region.place(f, k)]);
    double* flux = fluxes_.data() + f * columns_;
    for (int i = 0; i < 2; ++i) {
      const double weight = conormal.dot(subcell.gradient[i]);
      const double* face_pressure = pressure(subcell.subfaces[i]);
      for (int j = 0; j < columns_; ++j) flux[j] += weight * face_pressure[j];
      flux[k] -= weight;
    }
  }
}

}  // namespace sprekk::matrix_flow
