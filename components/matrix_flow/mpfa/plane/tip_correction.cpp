#include "components/matrix_flow/mpfa/plane/tip_correction.hpp"

namespace sprekk::matrix_flow {

TipCorrection::TipCorrection(const TipFlow& flow, const Mesh& mesh, const InteractionRegion& region,
                             const LocalFluxes& local, int node, const std::vector<Tensor>& mobility,
                             const std::vector<FlowCondition>& conditions)
    : flow_(flow), mesh_(mesh), region_(region), local_(local), mobility_(mobility), node_(mesh.nodes[node]) {
  const EndFrame& frame = flow.frame();
  if (node_ != frame.origin()) {
    side_ = frame.side_of(node_);
    for (int f = 0; f < region.subface_count(); ++f)
      if (!region.is_inner(f)) side_ = frame.side_of_wall(mesh, region.faces[f]);
  }
  for (const Subcell& subcell : region.subcells)
    inputs_.push_back(flow.pressure(mesh.cell_center[subcell.cell], side_));
  for (int f = 0; f < region.subface_count(); ++f) {
    if (region.is_inner(f)) continue;
    const int face = region.faces[f], side = frame.side_of_wall(mesh, face);
    const auto& [a, b] = mesh.face_nodes[face];
    inputs_.push_back(conditions[face] == FlowCondition::pressure ? flow.pressure(continuity_point(f), side)
                                                                  : flux(face, mesh.nodes[a], mesh.nodes[b], side));
  }
}

TipFlow::Modes TipCorrection::flux(int face, const Point& from, const Point& to, int side) const {
  double mobility = 0;
  int cells = 0;
  for (const int cell : mesh_.face_cells[face])
    if (cell != none) {
      mobility += 0.5 * mobility_[cell].trace();
      ++cells;
    }
  const TipFlow::Modes to_left = mobility / cells * (flow_.stream(to, side) - flow_.stream(from, side));
  const Point along = to - from;
  return Point(-along.y(), along.x()).dot(mesh_.face_normal[face]) > 0 ? to_left : TipFlow::Modes(-to_left);
}

Point TipCorrection::continuity_point(int subface) const {
  const Point& middle = mesh_.face_center[region_.faces[subface]];
  return middle + local_.point(subface).part * (node_ - middle);
}

TipFlow::Modes TipCorrection::of_flux(int subface) const {
  const int face = region_.faces[subface];
  return missing(local_.flux(subface), flux(face, node_, mesh_.face_center[face], side_));
}

TipFlow::Modes TipCorrection::of_pressure(int subface) const {
  // The pressure of a wall is the mean of the pressures at the continuity points of both halves; the correction makes
  // this mean the pressure at the centre of the wall.
  const int face = region_.faces[subface], side = flow_.frame().side_of_wall(mesh_, face);
  const Point &middle = mesh_.face_center[face], here = continuity_point(subface), there = 2 * middle - here;
  const auto pressure = [&](const Point& x) { return flow_.pressure(x, side); };
  return missing(local_.pressure(subface), pressure(middle) + 0.5 * (pressure(here) - pressure(there)));
}

TipFlow::Modes TipCorrection::missing(const double* coefficients, TipFlow::Modes exact) const {
  for (std::size_t i = 0; i < inputs_.size(); ++i) exact -= coefficients[i] * inputs_[i];
  return exact;
}

}  // namespace sprekk::matrix_flow
