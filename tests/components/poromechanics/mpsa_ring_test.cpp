// Reactions at a roller beside a curved side under load.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/components/poromechanics/exact_values.hpp"

namespace sprekk::poromechanics {
namespace {

using test::is_outer;
using test::traction_everywhere;

/// A quarter of a thick ring under pressure in its bore (Lamé), n by n quadrilaterals along rays and circles: one cell
/// alone at each corner, between a roller and a chord that is off the right angle by 45°/n.
struct Ring {
  static constexpr double inner = 1, outer = 2, lambda = 1, shear = 1;
  Tensor turn = Tensor::Identity();  ///< of the quarter; then rollers are along the faces' own axes
  bool bore_is_moved = false;        ///< by its displacement along the normals, instead of the pressure
  Point displacement(const Point& x) const {
    // u_r = A r + B / r with sigma_rr = −1 at the bore and 0 outside.
    const double a = inner * inner / (outer * outer - inner * inner);
    return x * (a / (2 * (lambda + shear)) + a * outer * outer / (2 * shear) / x.squaredNorm());
  }
  /// sigma_xx at the angle where x is along the circle, i.e. sigma_tt.
  static double hoop(double r) {
    return inner * inner / (outer * outer - inner * inner) * (1 + outer * outer / (r * r));
  }
  Mesh mesh(int n) const {
    RawMesh raw;
    raw.region_names = {"rock"};
    raw.side_names = {"floor", "outer", "wall", "bore"};
    const auto node = [n](int i, int j) { return i + (n + 1) * j; };
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i) {
        const double angle = std::numbers::pi / 2 * j / n, r = inner + (outer - inner) * i / n;
        raw.nodes.push_back(turn * Point(r * std::cos(angle), r * std::sin(angle)));
      }
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) raw.cells.push_back({node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)});
    raw.regions.assign(raw.cells.size(), 0);
    for (int i = 0; i < n; ++i) {
      raw.boundary_faces.push_back({{node(i, 0), node(i + 1, 0)}, 0});
      raw.boundary_faces.push_back({{node(n, i), node(n, i + 1)}, 1});
      raw.boundary_faces.push_back({{node(i, n), node(i + 1, n)}, 2});
      raw.boundary_faces.push_back({{node(0, i), node(0, i + 1)}, 3});
    }
    return build_mesh(raw);
  }

  /// The largest error of the hoop stress on the faces of the wall, from exact displacements of the cells.
  double error_of_reaction(int n, const MpsaLimits& limits = {}) const {
    const Mesh rock = mesh(n);
    std::vector<FaceConditions> conditions = traction_everywhere(rock);
    Vector u(2 * rock.cell_count()), b = Vector::Zero(2 * rock.face_count());
    for (int c = 0; c < rock.cell_count(); ++c) u.segment<2>(2 * c) = displacement(rock.cell_center[c]);
    for (int f = 0; f < rock.face_count(); ++f) {
      if (!is_outer(rock, f)) continue;
      const std::string& side = rock.side_names[rock.face_side[f]];
      if (side == "bore") b.segment<2>(2 * f) = -test::face_vector(rock, f);
      if (turn.isIdentity(0)) {
        if (side == "wall") conditions[f][0] = MechanicalCondition::displacement;
        if (side == "floor") conditions[f][1] = MechanicalCondition::displacement;
      } else {
        conditions[f].axes = ConditionAxes::of_face;
        if (side == "bore") b.segment<2>(2 * f) = Point(-rock.face_measure[f], 0);
        if (side == "wall" || side == "floor") conditions[f][0] = MechanicalCondition::displacement;
        if (side == "bore" && bore_is_moved) {
          conditions[f][0] = MechanicalCondition::displacement;
          b[2 * f] = rock.face_normal[f].dot(displacement(rock.face_center[f]));
        }
      }
    }
    const auto operators = discretize_mpsa(
        rock, std::vector<Stiffness>(rock.cell_count(), isotropic_stiffness(lambda, shear)), conditions, {}, limits);
    const Vector forces = operators.force_displacement * u + operators.force_boundary * b;
    double error = 0;
    for (int f = 0; f < rock.face_count(); ++f)
      if (is_outer(rock, f) && rock.side_names[rock.face_side[f]] == "wall")
        error = std::max(error, std::abs(forces.segment<2>(2 * f).dot(rock.face_normal[f]) / rock.face_measure[f] -
                                         hoop(rock.face_center[f].norm())));
    return error;
  }
};

TEST(Mpsa, AQuadrilateralAloneAtACornerOfARollerAndACurvedLoadedSide) {
  const Ring ring;
  const double coarse = ring.error_of_reaction(8), fine = ring.error_of_reaction(16),
               finest = ring.error_of_reaction(64);
  // The stress is 1.67 there.
  EXPECT_LT(coarse, 0.03);
  EXPECT_LT(fine, 0.5 * coarse);
  EXPECT_LT(finest, 0.2 * fine);
}

/// The limits for forces that determine a stress may be half or nearly twice as large.
TEST(Mpsa, ACornerHardlyDependsOnWhatIsVague) {
  const Ring ring;
  // With three cells along a quarter, chords are 15 degrees off the right angle, and with four 11: that is vague by
  // half of the usual measure, too.
  for (const double factor : {0.5, 0.7, 1.4, 1.8}) {
    MpsaLimits limits;
    limits.vague *= factor, limits.certain *= factor;
    for (const int n : {3, 4, 6, 8, 16})
      EXPECT_LT(ring.error_of_reaction(n, limits), (n == 3 ? 2 : 1.01) * ring.error_of_reaction(n))
          << factor << ", " << n;
  }
}

TEST(Mpsa, RollersOfATurnedRingAreAsGood) {
  const Ring ring;
  for (const double degrees : {30.0, 45.0, 77.0, 180.0, -125.3}) {
    const Ring turned{test::turned_by(degrees)};
    for (const int n : {8, 16}) EXPECT_NEAR(turned.error_of_reaction(n), ring.error_of_reaction(n), 1e-12) << degrees;
  }
}

/// Rollers that meet at nearly a right angle, one of them on a curved side.
TEST(Mpsa, AQuadrilateralAloneBetweenARollerAndACurvedSideThatIsMoved) {
  for (const double degrees : {30.0, 90.0}) {
    const Ring ring{test::turned_by(degrees), true};
    const double coarse = ring.error_of_reaction(8), fine = ring.error_of_reaction(16),
                 finest = ring.error_of_reaction(64);
    EXPECT_LT(coarse, 0.03);
    EXPECT_LT(fine, 0.5 * coarse);
    EXPECT_LT(finest, 0.2 * fine);
  }
}

}  // namespace
}  // namespace sprekk::poromechanics
