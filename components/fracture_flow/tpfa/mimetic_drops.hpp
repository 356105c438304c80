// The terms that make fluxes along fractures exact for linear pressures in cells of any shape (mimetic finite
// differences).
#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

#include "components/fracture_flow/tpfa/outflows.hpp"
#include "framework/mesh/mesh.hpp"

namespace sprekk::fracture_flow {

/// The mimetic inner product of Brezzi, Lipnikov and Simoncini (Math. Models Methods Appl. Sci. 15 (2005) 1533) in each
/// fracture cell, without the two-point part. The pressure drops from the centre of a cell to its ridge k by
///   h_k q_k/T + sum over its ridges j of G_kj q_j/T,
/// with q_j the flux out through ridge j, T the transmissivity, h_k the distance of the ridge over its length. With R
/// the midpoints of the ridges relative to the centre, N their normals times their lengths, A the area:
///   G = R R^T/A + P^T h P − h,  P = 1 − N R^T/A.
/// The first term is exact for linear pressures; P^T h P vanishes for their flows, and makes the sum positive definite.
/// G vanishes in rectangles, and also in a plane, where cells are lines.
class MimeticDrops {
 public:
  MimeticDrops() = default;  ///< two-point fluxes alone
  explicit MimeticDrops(const Mesh& mesh);

  bool is_empty() const { return of_cell_.empty(); }

  /// The ridges by whose fluxes the drop from the centre of a cell to its ridge changes, each with the factor of its
  /// flux over T, 1/m (dimensionless in space). At a junction, `ridge` is any of the ridges there that belong to the
  /// cell.
  std::vector<std::pair<int, double>> at(int cell, int ridge) const;

  /// The least part of the two-point drop h_k q_k/T at a ridge k that has to be kept so that the sum M of all drops
  /// stays positive definite when the rest is taken away at each of the cell's junctions. Relative to M, the largest
  /// eigenvalue of the drops at these junctions is at most the sum of h_k (M^-1)_kk over them, and h_k (M^-1)_kk <= 1 +
  /// (distance of the ridge · its length)/A. 0 in cells with two-point fluxes alone.
  double least_kept(int cell, int ridge) const;

  /// The drops from the centre of a cell to its ridges, times T, by the flows out through them: h + G, by places in
  /// FractureCell::ridges.
  Eigen::MatrixXd drops(const Mesh& mesh, int cell) const;

  /// The number of fracture cells in which two-point fluxes alone are not exact for linear pressures.
  static long cells_that_need_them(const Mesh& mesh);

 private:
  const Mesh* mesh_ = nullptr;
  std::vector<Eigen::MatrixXd> of_cell_;  ///< G, by places in FractureCell::ridges
  Outflows outflows_;
};

}  // namespace sprekk::fracture_flow
