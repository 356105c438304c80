#include "components/matrix_flow/mpfa/local_fluxes.hpp"

#include "framework/discretization/dual_vectors.hpp"
#include "framework/invariants.hpp"
#include "framework/linear/eliminate.hpp"

namespace sprekk::matrix_flow {
namespace {

/// Triangles in a plane, tetrahedra in space.
bool is_simplex(const Mesh& mesh, int cell) { return mesh.cell_nodes[cell].size() == dimension + 1; }

}  // namespace

void LocalFluxes::find_arms(const Mesh& mesh, const InteractionRegion& region) {
  arm_.resize(region.subcell_count());
  gradient_.resize(region.subcell_count());
  for (int k = 0; k < region.subcell_count(); ++k) {
    for (int i = 0; i < dimension; ++i) {
      const int f = region.subcells[k].subfaces[i];
      arm_[k][i] = mesh.face_center[region.faces[f]] + points_[f].part * points_[f].way -
                   mesh.cell_center[region.subcells[k].cell];
    }
    gradient_[k] = dual_vectors<dimension>(arm_[k]);
  }
}

LocalFluxes::Weights LocalFluxes::consistent(const Subcell& subcell, const Tensor& mobility, int k) const {
  Weights weights;
  for (int i = 0; i < dimension; ++i) {
    const Point conormal = mobility.transpose() * subcell.half_face[i];
    for (int j = 0; j < dimension; ++j) weights[i][j] = conormal.dot(gradient_[k][j]);
  }
  return weights;
}

/// The same weights, if the half faces are dual to the arms.
LocalFluxes::Weights LocalFluxes::symmetric(const Subcell& subcell, const Tensor& mobility, int k) const {
  double measure = arm_[k][0].dot(subcell.half_face[0]);
  for (int i = 1; i < dimension; ++i) measure += arm_[k][i].dot(subcell.half_face[i]);
  measure /= dimension;
  Weights weights;
  for (int i = 0; i < dimension; ++i)
    for (int j = 0; j < dimension; ++j) weights[i][j] = measure * gradient_[k][i].dot(mobility * gradient_[k][j]);
  return weights;
}

LocalFluxes::Stabilizer LocalFluxes::solve(const Mesh& mesh, int node, const InteractionRegion& region,
                                           const std::vector<Tensor>& mobility,
                                           const std::vector<FlowCondition>& conditions) {
  points_.resize(region.subface_count());
  bool has_simplices_only = true;
  // Also on walls and on the boundary: with the centre of a wall's face, the flow in a triangle of anisotropic rock may
  // gain energy.
  for (int f = 0; f < region.subface_count(); ++f) points_[f] = continuity_point(mesh, region.faces[f], node);
  for (const Subcell& subcell : region.subcells)
    has_simplices_only = has_simplices_only && is_simplex(mesh, subcell.cell);
  find_arms(mesh, region);
  solve_with(&LocalFluxes::consistent, mesh, region, mobility, conditions);
  if (has_simplices_only || each_subcell_dissipates() || dissipates(region, conditions)) return Stabilizer::none;
  return stabilize(mesh, node, region, mobility, conditions);
}

void LocalFluxes::solve_with(WeightsOf weights_of, const Mesh& mesh, const InteractionRegion& region,
                             const std::vector<Tensor>& mobility, const std::vector<FlowCondition>& conditions) {
  const int subcells = region.subcell_count();
  SPREKK_EXPECT(static_cast<int>(points_.size()) == region.subface_count(), points_.size());
  SPREKK_EXPECT(static_cast<int>(arm_.size()) == subcells, arm_.size(), subcells);
  subfaces_ = region.subface_count();
  columns_ = subcells;
  for (int f = 0; f < subfaces_; ++f) columns_ += !region.is_inner(f);
  const bool has_derivatives = derivatives_ == Derivatives::by_mobility;
  const int inverse_column = subfaces_ + columns_, width = inverse_column + (has_derivatives ? subfaces_ : 0);
  system_.assign(subfaces_ * width, 0);
  weights_of_ = weights_of;
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
    if (has_derivatives) row[inverse_column + f] = 1;
    // The fluxes out of the neighbours add up to zero, or to the share of what is prescribed for the face.
    for (const int k : region.neighbours[f]) {
      SPREKK_ASSERT(k == none || is_index(k, subcells), f, k, subcells);
      if (k == none) continue;
      for (int i = 0; i < dimension; ++i) {
        const double weight = weights_[k][region.place(f, k)][i];
        row[region.subcells[k].subfaces[i]] -= weight;
        row[subfaces_ + k] -= weight;
      }
    }
    if (!region.is_inner(f)) row[boundary_column++] = region.shares[f];
  }
  constexpr double singular = 1e-14;  // of the largest entry of a row; smaller pivots are round-off
  if (eliminate(system_.data(), subfaces_, width) < singular) throw unsolvable_region("MPFA", mesh, region, "mobility");
  pressures_.resize(subfaces_ * columns_);
  for (int f = 0; f < subfaces_; ++f)
    std::copy_n(system_.data() + f * width + subfaces_, columns_, pressures_.data() + f * columns_);

  if (has_derivatives) {
    inverse_.resize(subfaces_ * subfaces_);
    for (int f = 0; f < subfaces_; ++f)
      std::copy_n(system_.data() + f * width + inverse_column, subfaces_, inverse_.data() + f * subfaces_);
  }

  fluxes_.assign(subfaces_ * columns_, 0);
  side_.assign(subfaces_, 0);
  for (int f = 0; f < subfaces_; ++f) {
    // The flux can be computed from either side. The expression of the less permeable side has less cancellation.
    int side = 0;
    if (region.is_inner(f)) {
      const auto trace = [&](int s) { return mobility[region.subcells[region.neighbours[f][s]].cell].trace(); };
      side = trace(1) < trace(0) ? 1 : 0;
    }
    side_[f] = side;
    const int k = region.neighbours[f][side];
    double* flux = fluxes_.data() + f * columns_;
    for (int i = 0; i < dimension; ++i) {
      const double weight = (side == 0 ? -1.0 : 1.0) * weights_[k][region.place(f, k)][i];
      const double* face_pressure = pressure(region.subcells[k].subfaces[i]);
      for (int j = 0; j < columns_; ++j) flux[j] += weight * face_pressure[j];
      flux[k] -= weight;
    }
  }
}

void LocalFluxes::by_mobility(const InteractionRegion& region, const std::vector<FlowCondition>& conditions,
                              int subcell, const Tensor& change, const std::vector<double>& given,
                              Change& result) const {
  SPREKK_EXPECT(derivatives_ == Derivatives::by_mobility && weights_of_, subcell);
  SPREKK_EXPECT(static_cast<int>(given.size()) == columns_, given.size(), columns_);
  const auto& subfaces = region.subcells[subcell].subfaces;
  // With the pressures held, the fluxes into the subcell change by these.
  const Weights weights = (this->*weights_of_)(region.subcells[subcell], change, subcell);
  std::array<double, dimension> into{}, drop{};
  for (int j = 0; j < dimension; ++j) {
    const double* of_given = pressure(subfaces[j]);
    drop[j] = -given[subcell];
    for (int c = 0; c < columns_; ++c) drop[j] += of_given[c] * given[c];
  }
  for (int i = 0; i < dimension; ++i)
    for (int j = 0; j < dimension; ++j) into[i] += weights[i][j] * drop[j];
  // The pressures follow so that the fluxes of both sides agree again.
  result.pressure.assign(subfaces_, 0);
  for (int i = 0; i < dimension; ++i) {
    if (conditions[region.faces[subfaces[i]]] == FlowCondition::pressure) continue;
    for (int f = 0; f < subfaces_; ++f) result.pressure[f] += inverse_[f * subfaces_ + subfaces[i]] * into[i];
  }
  result.flux.assign(subfaces_, 0);
  for (int f = 0; f < subfaces_; ++f) {
    if (conditions[region.faces[f]] == FlowCondition::flux) continue;
    const int k = region.neighbours[f][side_[f]], place = region.place(f, k);
    double flux = k == subcell ? into[place] : 0;
    for (int i = 0; i < dimension; ++i) flux += weights_[k][place][i] * result.pressure[region.subcells[k].subfaces[i]];
    result.flux[f] = side_[f] == 0 ? -flux : flux;
  }
}

}  // namespace sprekk::matrix_flow
