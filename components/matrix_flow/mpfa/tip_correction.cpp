#include "components/matrix_flow/mpfa/tip_correction.hpp"

#include "framework/discretization/subface.hpp"

namespace sprekk::matrix_flow {

TipCorrection::TipCorrection(const TipFlow& flow, const Mesh& mesh, const InteractionRegion& region,
                             const LocalFluxes& local, int node, const std::vector<Tensor>& mobility,
                             const std::vector<FlowCondition>& conditions)
    : flow_(flow), mesh_(mesh), region_(region), local_(local), mobility_(mobility), node_(node) {
  const EndFrame& frame = flow.frame();
  if (mesh.nodes[node] != frame.origin()) {
    side_ = frame.side_of(mesh.nodes[node]);
    for (const int face : region.faces)
      if (mesh.face_fracture_cell[face] != none) side_ = frame.side_of_wall(mesh, face);
  }
  for (const Subcell& subcell : region.subcells)
    inputs_.push_back(flow.pressure(mesh.cell_center[subcell.cell], side_));
  for (int f = 0; f < region.subface_count(); ++f) {
    if (region.is_inner(f)) continue;
    const int face = region.faces[f], side = side_of(face);
    inputs_.push_back(conditions[face] == FlowCondition::pressure ? flow.pressure(continuity_point(f), side)
                                                                  : mobility_of(face) * flow.flux(mesh, face, side));
  }
}

double TipCorrection::mobility_of(int face) const {
  double mobility = 0;
  int cells = 0;
  for (const int cell : mesh_.face_cells[face])
    if (cell != none) {
      mobility += mobility_[cell].trace() / dimension;
      ++cells;
    }
  return mobility / cells;
}

int TipCorrection::side_of(int face) const {
  if (mesh_.face_fracture_cell[face] != none) return flow_.frame().side_of_wall(mesh_, face);
  // In space a face at a rim may have an edge in the fracture: its nodes alone do not tell the side.
  return dimension == 2 ? side_ : flow_.frame().side_of(mesh_.face_center[face]);
}

Point TipCorrection::continuity_point(int subface) const {
  const ContinuityPoint& point = local_.point(subface);
  return mesh_.face_center[region_.faces[subface]] + point.part * point.way;
}

TipFlow::Modes TipCorrection::of_flux(int subface) const {
  const int face = region_.faces[subface];
  return missing(local_.flux(subface), mobility_of(face) * flow_.flux_at_node(mesh_, face, node_, side_of(face)));
}

TipFlow::Modes TipCorrection::of_pressure(int subface) const {
  // The pressure of a wall is the mean of the pressures at the continuity points of its parts; the correction makes
  // this mean the pressure at the centre of the wall.
  const int face = region_.faces[subface], side = side_of(face);
  const auto pressure = [&](const Point& x) { return flow_.pressure(x, side); };
  const Point& middle = mesh_.face_center[face];
  const Point at = continuity_point(subface);
  const TipFlow::Modes here = pressure(at);
  TipFlow::Modes above = TipFlow::Modes::Zero();  // the pressure here, over the mean
  for (const int other : mesh_.face_nodes[face]) {
    if (other == node_) continue;
    Point there = 2 * middle - at;
    if constexpr (dimension == 3) {
      const ContinuityPoint point = continuity_point_in_space(mesh_, face, other);
      there = middle + point.part * point.way;
    }
    above += share_at_node(mesh_, face, other) * (here - pressure(there));
  }
  return missing(local_.pressure(subface), pressure(middle) + above);
}

TipFlow::Modes TipCorrection::missing(const double* coefficients, TipFlow::Modes exact) const {
  for (std::size_t i = 0; i < inputs_.size(); ++i) exact -= coefficients[i] * inputs_[i];
  return exact;
}

}  // namespace sprekk::matrix_flow
