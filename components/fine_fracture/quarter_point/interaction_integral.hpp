// The interaction integral in domain form.
#pragma once

#include <array>

#include "components/fine_fracture/quarter_point/elasticity.hpp"
#include "components/fine_fracture/quarter_point/fine_mesh.hpp"
#include "components/fine_fracture/quarter_point/loads.hpp"

namespace sprekk::fine_fracture {

/// K_I, K_II (Pa m^1/2) and sigma_11 - sigma_22 (Pa) at a tip.
struct InteractionResult {
  Point K;
  double T;
};

/// With total stress sigma = C eps(u) + s, auxiliary field a and a weight q that is 1 at the tip and 0 at `radius`,
///
///   I = int_A [sigma_ij ua_i,1 q_,j + sa_ij u_i,1 q_,j - (sa : eps) q_,1 + q s : epsa_,1] - int_walls q t . ua_,1,
///
/// which is the usual domain form (Li, Shih and Needleman 1985; Yau, Wang and Corten 1980) after the body force div s
/// has been integrated by parts: only values of s occur. Before, the constant state that the walls' traction and s have
/// at the tip is subtracted, so that integrals converge at the tip. K = E' I / 2, sigma_11 = E' I for a unit force.
/// Exact for walls that are straight within the radius. On walls of kind jump, t is the mean of both elements'
/// stress, in the rosette a line fitted to it from behind. For two radii, the first one the larger, together: they
/// share all but q.
std::array<InteractionResult, 2> interaction_integrals(const FineMesh& mesh, const Elasticity& rock,
                                                       const FineLoads& loads, const Vector& displacement,
                                                       const FineMesh::Tip& tip, const std::array<double, 2>& radii);

}  // namespace sprekk::fine_fracture
