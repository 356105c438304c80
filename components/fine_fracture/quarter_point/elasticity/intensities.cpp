#include "components/fine_fracture/quarter_point/elasticity/intensities.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "framework/invariants.hpp"
#include "framework/mesh/mesh.hpp"

namespace sprekk::fine_fracture {
namespace {

void correlate(const FineMesh::Tip& tip, const Elasticity& rock, const Vector& displacement, TipIntensities& result) {
  SPREKK_EXPECT(tip.room.radius > 0, tip.room.radius);
  SPREKK_EXPECT(is_unit(tip.room.direction), tip.room.direction.norm());
  const Point& x1 = tip.room.direction;
  const Point x2(-x1.y(), x1.x());
  std::array<Point, 2> opening;  // (normal, tangential) at a quarter of the radius, and at the radius
  for (int k = 0; k < 2; ++k) {
    const Point jump =
        displacement.segment<2>(2 * tip.wall_nodes[0][k]) - displacement.segment<2>(2 * tip.wall_nodes[1][k]);
    opening[k] = {jump.dot(x2), jump.dot(x1)};
  }
  const double factor = rock.shear * std::sqrt(2 * std::numbers::pi / tip.room.radius) / (rock.kolosov() + 1);
  result.K_correlation = factor * (4 * opening[0] - opening[1]);
  result.K_extrapolated = factor * (8 * opening[0] - opening[1]) / 3;
}

bool has_jump_at(const FineMesh& mesh, const FineMesh::Tip& tip) {
  return std::any_of(mesh.wall_edges.begin(), mesh.wall_edges.end(), [&](const FineMesh::WallEdge& edge) {
    return edge.tip != none && &mesh.tips[edge.tip] == &tip && edge.walls == CrackPath::Walls::jump;
  });
}

/// The domain keeps away from kinks, other cracks and from walls of another kind, where prescribed jumps begin:
/// stresses are singular there too.
double domain_radius(const TipRoom& room, const IntegralLimits& limits) {
  SPREKK_EXPECT(room.radius > 0 && room.clearance > 0, room.radius, room.clearance);
  return std::min(limits.domain_in_radii * room.radius,
                  std::max(2 * room.radius, limits.share_of_room * std::min(room.same_walls, room.clearance)));
}

}  // namespace

TipEvaluation::TipEvaluation(const FineMesh& mesh, const FineRock& rock, const FineMesh::Tip& tip,
                             const IntegralLimits& limits)
    : tip_(tip),
      rock_(rock.at(tip.room.position)),
      domain_radius_(domain_radius(tip.room, limits)),
      has_jump_(has_jump_at(mesh, tip)),
      integrals_(mesh, rock, tip, {domain_radius_, 0.5 * (domain_radius_ + tip.room.radius)}) {}

TipIntensities TipEvaluation::of(const FineLoads& loads, const Eigen::Ref<const Eigen::Matrix3Xd>& offsets,
                                 const Eigen::Ref<const Eigen::Matrix2Xd>& body_forces,
                                 const Vector& displacement) const {
  TipIntensities result{};
  result.crack = tip_.room.crack;
  result.is_last = tip_.room.is_last;
  result.position = tip_.room.position;
  result.direction = tip_.room.direction;
  result.domain_radius = domain_radius_;
  const auto [outer, inner] = integrals_.of(loads, offsets, body_forces, displacement);
  SPREKK_ASSERT(outer.K.allFinite() && inner.K.allFinite(), result.crack);
  result.K_interaction = outer.K;
  result.T = outer.T;
  result.K_inner = inner.K;
  correlate(tip_, rock_, displacement, result);
  result.K = has_jump_ ? result.K_extrapolated : result.K_interaction;
  result.error = (result.K - (has_jump_ ? result.K_correlation : result.K_inner)).cwiseAbs();
  result.energy_release_rate = result.K.squaredNorm() / rock_.plane_modulus();
  SPREKK_ASSERT(result.energy_release_rate >= 0, result.crack, result.energy_release_rate);
  return result;
}

}  // namespace sprekk::fine_fracture
