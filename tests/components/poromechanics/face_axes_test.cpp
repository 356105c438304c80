// Conditions along the normal and the tangent of each face.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/components/poromechanics/exact_values.hpp"

namespace sprekk::poromechanics {
namespace {

using test::is_outer;

/// On outer faces both directions prescribed, either one, and none, in turn, along the axes of the faces; some faces
/// have the axes of space if `mixed`. Walls have prescribed tractions.
std::vector<FaceConditions> conditions_in_turn(const Mesh& mesh, bool mixed) {
  const auto kind = [](bool moves) {
    return moves ? MechanicalCondition::displacement : MechanicalCondition::traction;
  };
  std::vector<FaceConditions> conditions(mesh.face_count());
  for (int f = 0; f < mesh.face_count(); ++f) {
    if (!is_outer(mesh, f)) continue;
    const bool is_side = !test::is_wall(mesh, f);
    conditions[f] = {kind(is_side && f % 2 == 0), kind(is_side && f / 2 % 2 == 0)};
    if (is_side && !(mixed && f % 3 == 0)) conditions[f].axes = ConditionAxes::of_face;
  }
  return conditions;
}

/// Displacement along the normal of all sides, free of traction along them.
std::vector<FaceConditions> rollers(const Mesh& mesh, ConditionAxes axes) {
  std::vector<FaceConditions> conditions(mesh.face_count());
  for (int f = 0; f < mesh.face_count(); ++f) {
    if (!is_outer(mesh, f)) continue;
    conditions[f] = {MechanicalCondition::traction, MechanicalCondition::traction};
    if (test::is_wall(mesh, f)) continue;
    conditions[f].axes = axes;
    const int along = std::abs(mesh.face_normal[f].x()) > 0.5 ? 0 : 1;
    conditions[f][axes == ConditionAxes::of_face ? 0 : along] = MechanicalCondition::displacement;
  }
  return conditions;
}

std::vector<Mesh> meshes() {
  return {test::fractured_square(),
          test::square_with_single_corners(6),
          test::square_with_single_corners(1),
          test::fractured_rectangles(),
          test::fractured_square(test::mixed(0.1, 0.3)),
          generate_mesh(test::box(2, 1), test::structured(7, 5, 0.4)),
          generate_mesh(test::box(2, 1), test::rectangles(7, 1, 0.4))};
}

TEST(FaceAxes, LinearDisplacementsAreExactInBoxesOfAnyDirection) {
  const Tensor maps[] = {test::turned_by(0),
                         test::turned_by(30),
                         test::turned_by(77),
                         test::turned_by(45),
                         test::turned_by(-30) * test::mirrored,
                         test::turned_by(1e-7)};
  for (const Mesh& straight : meshes())
    for (const Tensor& map : maps) {
      const Mesh mesh = test::moved(straight, map);
      for (const Stiffness& c : {isotropic_stiffness(1.4, 0.8), test::anisotropic_stiffness()})
        for (const bool mixed : {false, true}) {
          const auto errors = test::compare(
              mesh, std::vector<Stiffness>(mesh.cell_count(), c), conditions_in_turn(mesh, mixed),
              test::linear_displacement, [](int) { return test::linear_gradient; }, [](int) { return 0.6; });
          EXPECT_LT(errors.force, 1e-12) << map;
          EXPECT_LT(errors.trace, 1e-12) << map;
          EXPECT_LT(errors.volume, 1e-13) << map;
        }
    }
}

/// A rhombus: the rollers of a corner are neither along an axis nor at a right angle.
TEST(FaceAxes, LinearDisplacementsAreExactBetweenRollersThatMeetAtAnyAngle) {
  for (const double slant : {0.05, 0.6, 1.5, -0.8}) {
    const Tensor map = test::turned_by(20) * (Tensor() << 1, slant, 0, 1).finished();
    for (const Mesh& straight : {test::square_with_single_corners(5), test::grid_of({0, 0.2, 0.5, 1}, {0, 0.3, 1})}) {
      const Mesh mesh = test::moved(straight, map);
      const auto errors = test::compare(
          mesh, std::vector<Stiffness>(mesh.cell_count(), test::anisotropic_stiffness()),
          rollers(mesh, ConditionAxes::of_face), test::linear_displacement, [](int) { return test::linear_gradient; },
          [](int) { return -0.4; });
      EXPECT_LT(errors.force, 1e-12) << slant;
      EXPECT_LT(errors.trace, 1e-12) << slant;
      EXPECT_LT(errors.volume, 1e-13) << slant;
    }
  }
}

/// On sides along x and y the axes of faces differ from those of space by their signs and order only, also where soft
/// and stiff rock meet: the least force keeps its digits.
TEST(FaceAxes, AlongAxesTheyAreConditionsInXAndY) {
  for (const Mesh& mesh : meshes())
    for (const double contrast : {1.0, 1e10}) {
      std::vector<Stiffness> rock(mesh.cell_count(), test::anisotropic_stiffness());
      for (int c = 0; c < mesh.cell_count(); ++c)
        if (mesh.cell_center[c].x() + 0.3 * mesh.cell_center[c].y() < 0.6) rock[c] *= contrast;
      const auto of_face = discretize_mpsa(mesh, rock, rollers(mesh, ConditionAxes::of_face));
      const auto of_space = discretize_mpsa(mesh, rock, rollers(mesh, ConditionAxes::of_space));
      std::vector<Triplet> axes;
      for (int f = 0; f < mesh.face_count(); ++f) {
        const bool is_side = is_outer(mesh, f) && !test::is_wall(mesh, f);
        const Tensor columns = axes_of(is_side ? ConditionAxes::of_face : ConditionAxes::of_space, mesh.face_normal[f]);
        for (int c = 0; c < 2; ++c)
          for (int d = 0; d < 2; ++d)
            if (columns(c, d) != 0) axes.emplace_back(2 * f + d, 2 * f + c, columns(c, d));
      }
      SparseMatrix along(2 * mesh.face_count(), 2 * mesh.face_count());
      along.setFromTriplets(axes.begin(), axes.end());
      // Single cells in corners have a decomposition whose round-off depends on signs.
      const auto worst = [](const SparseMatrix& a, const SparseMatrix& b, int rows) {
        const SparseMatrix difference = a - b;
        double worst = 0;
        for (int row = 0; row < a.rows(); row += rows)
          if (const double size = difference.middleRows(row, rows).norm(); size > 0)
            worst = std::max(worst, size / b.middleRows(row, rows).norm());
        return worst;
      };
      // What a prescribed trace depends on is round-off.
      const int alone = 1, together = 2 * mesh.face_count();
      EXPECT_LT(worst(of_face.force_displacement, of_space.force_displacement, alone), 1e-13);
      EXPECT_LT(worst(of_face.force_stress, of_space.force_stress, alone), 1e-13);
      EXPECT_LT(worst(of_face.trace_displacement, of_space.trace_displacement, together), 1e-13);
      EXPECT_LT(worst(of_face.trace_stress, of_space.trace_stress, together), 1e-13);
      EXPECT_LT(worst(of_face.volume_displacement, of_space.volume_displacement, alone), 1e-13);
      EXPECT_LT(worst(of_face.volume_stress, of_space.volume_stress, alone), 1e-13);
      EXPECT_LT(worst(of_face.force_boundary * along, of_space.force_boundary, alone), 1e-13);
      EXPECT_LT(worst(of_face.trace_boundary * along, of_space.trace_boundary, together), 1e-13);
      EXPECT_LT(worst(of_face.volume_boundary * along, of_space.volume_boundary, alone), 1e-13);
    }
}

TEST(FaceAxes, PrescribedForcesHold) {
  const Mesh mesh = test::moved(test::fractured_square(), test::turned_by(30));
  const auto conditions = conditions_in_turn(mesh, false);
  const auto operators =
      discretize_mpsa(mesh, std::vector<Stiffness>(mesh.cell_count(), isotropic_stiffness(2e10, 1e10)), conditions);
  const Vector u = Vector::Random(2 * mesh.cell_count()), s = Vector::Random(mesh.cell_count()) * 1e7;
  const Vector b = Vector::Random(2 * mesh.face_count());
  const Vector forces = operators.force_displacement * u + operators.force_stress * s + operators.force_boundary * b;
  for (int f = 0; f < mesh.face_count(); ++f) {
    const Point force = axes_of(conditions[f].axes, mesh.face_normal[f]).transpose() * Point(forces.segment<2>(2 * f));
    // Round-off of the other direction's force.
    for (int d = 0; d < 2; ++d)
      if (conditions[f][d] == MechanicalCondition::traction) {
        EXPECT_NEAR(force[d], b[2 * f + d], 1e-14 * force.norm() + 1e-15);
      }
  }
}

TEST(FaceAxes, AreRefusedInside) {
  const Mesh mesh = test::square_with_single_corners(2);
  auto conditions = rollers(mesh, ConditionAxes::of_face);
  int inner = 0;
  while (is_outer(mesh, inner)) ++inner;
  conditions[inner].axes = ConditionAxes::of_face;
  EXPECT_THROW(discretize_mpsa(mesh, std::vector<Stiffness>(mesh.cell_count(), isotropic_stiffness(1, 1)), conditions),
               std::invalid_argument);
}

}  // namespace
}  // namespace sprekk::poromechanics
