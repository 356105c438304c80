#include "components/matrix_flow/mpfa/local_fluxes.hpp"

#include "framework/invariants.hpp"
#include "framework/linear/eliminate.hpp"

namespace sprekk::matrix_flow {
namespace {

bool is_triangle(const Mesh& mesh, int cell) { return mesh.cell_nodes[cell].size() == 3; }

/// Where the pressures of both sides of a subface agree, from the centre of the face (0) to the node (1). At the third
/// points of a triangle, and at the centres of a parallelogram's faces, the arms from the centre of the cell to the
/// points are dual to the half faces: the fluxes out of a subcell are then a symmetric positive definite function of
/// its pressure drops, for any tensor. Where all subcells have this property, no flow can gain energy. So the points of
/// walls and of the boundary are chosen in the same way: with the centre of a wall's face, the flow in a triangle of
/// anisotropic rock may gain energy.
double continuity_point(const Mesh& mesh, int face) {
  for (const int cell : mesh.face_cells[face])
    if (cell != none && is_triangle(mesh, cell)) return 1.0 / 3;
  return 0;
}

double cross(const Point& a, const Point& b) { return a[0] * b[1] - a[1] * b[0]; }

}  // namespace

void LocalFluxes::find_arms(const Mesh& mesh, int node, const InteractionRegion& region) {
  arm_.resize(region.subcell_count());
  gradient_.resize(region.subcell_count());
  for (int k = 0; k < region.subcell_count(); ++k) {
    auto& arm = arm_[k];
    for (int i = 0; i < 2; ++i) {
      const int f = region.subcells[k].subfaces[i];
      const Point& middle = mesh.face_center[region.faces[f]];
      arm[i] = middle + towards_node_[f] * (mesh.nodes[node] - middle) - mesh.cell_center[region.subcells[k].cell];
    }
    const double determinant = cross(arm[0], arm[1]);
    SPREKK_ASSERT(determinant != 0, node, region.subcells[k].cell);
    gradient_[k] = {Point(arm[1][1], -arm[1][0]) / determinant, Point(-arm[0][1], arm[0][0]) / determinant};
  }
}

LocalFluxes::Weights LocalFluxes::consistent(const Subcell& subcell, const Tensor& mobility, int k) const {
  Weights weights;
  for (int i = 0; i < 2; ++i) {
    const Point conormal = mobility.transpose() * subcell.half_face[i];
    for (int j = 0; j < 2; ++j) weights[i][j] = conormal.dot(gradient_[k][j]);
  }
  return weights;
}

/// The same weights, if the half faces are dual to the arms.
LocalFluxes::Weights LocalFluxes::symmetric(const Subcell& subcell, const Tensor& mobility, int k) const {
  const double area = 0.5 * (arm_[k][0].dot(subcell.half_face[0]) + arm_[k][1].dot(subcell.half_face[1]));
  Weights weights;
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j) weights[i][j] = area * gradient_[k][i].dot(mobility * gradient_[k][j]);
  return weights;
}

LocalFluxes::Stabilizer LocalFluxes::solve(const Mesh& mesh, int node, const InteractionRegion& region,
                                           const std::vector<Tensor>& mobility,
                                           const std::vector<FlowCondition>& conditions) {
  towards_node_.clear();
  bool has_triangles_only = true;
  for (const int face : region.faces) towards_node_.push_back(continuity_point(mesh, face));
  for (const Subcell& subcell : region.subcells)
    has_triangles_only = has_triangles_only && is_triangle(mesh, subcell.cell);
  find_arms(mesh, node, region);
  solve_with(&LocalFluxes::consistent, mesh, region, mobility, conditions);
  if (has_triangles_only || each_subcell_dissipates() || dissipates(region, conditions)) return Stabilizer::none;
  return stabilize(mesh, node, region, mobility, conditions);
}

void LocalFluxes::solve_with(WeightsOf weights_of, const Mesh& mesh, const InteractionRegion& region,
                             const std::vector<Tensor>& mobility, const std::vector<FlowCondition>& conditions) {
  const int subcells = region.subcell_count();
  SPREKK_EXPECT(static_cast<int>(towards_node_.size()) == region.subface_count(), towards_node_.size());
  SPREKK_EXPECT(static_cast<int>(arm_.size()) == subcells, arm_.size(), subcells);
  subfaces_ = region.subface_count();
  columns_ = subcells;
  for (int f = 0; f < subfaces_; ++f) columns_ += !region.is_inner(f);
  const int width = subfaces_ + columns_;
  system_.assign(subfaces_ * width, 0);
  weights_.resize(subcells);
  for (int k = 0; k < subcells; ++k)
    weights_[k] = (this->*weights_of)(region.subcells[k], mobility[region.subcells[k].cell], k);

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
      SPREKK_ASSERT(k == none || is_index(k, subcells), f, k, subcells);
      if (k == none) continue;
      for (int i = 0; i < 2; ++i) {
        const double weight = weights_[k][region.place(f, k)][i];
        row[region.subcells[k].subfaces[i]] -= weight;
        row[subfaces_ + k] -= weight;
      }
    }
    if (!region.is_inner(f)) row[boundary_column++] = 0.5;
  }
  constexpr double singular = 1e-14;  // of the largest entry of a row; smaller pivots are round-off
  if (eliminate(system_.data(), subfaces_, width) < singular) throw unsolvable_region("MPFA", mesh, region, "mobility");
  pressures_.resize(subfaces_ * columns_);
  for (int f = 0; f < subfaces_; ++f)
    std::copy_n(system_.data() + f * width + subfaces_, columns_, pressures_.data() + f * columns_);

  fluxes_.assign(subfaces_ * columns_, 0);
  for (int f = 0; f < subfaces_; ++f) {
    // The flux can be computed from either side. The expression of the less permeable side has less cancellation.
    int side = 0;
    if (region.is_inner(f)) {
      const auto trace = [&](int s) { return mobility[region.subcells[region.neighbours[f][s]].cell].trace(); };
      side = trace(1) < trace(0) ? 1 : 0;
    }
    const int k = region.neighbours[f][side];
    double* flux = fluxes_.data() + f * columns_;
    for (int i = 0; i < 2; ++i) {
      const double weight = (side == 0 ? -1.0 : 1.0) * weights_[k][region.place(f, k)][i];
      const double* face_pressure = pressure(region.subcells[k].subfaces[i]);
      for (int j = 0; j < columns_; ++j) flux[j] += weight * face_pressure[j];
      flux[k] -= weight;
    }
  }
}

}  // namespace sprekk::matrix_flow
