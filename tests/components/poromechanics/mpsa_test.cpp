#include "components/poromechanics/mpsa/mpsa.hpp"

#include <gtest/gtest.h>

#include "tests/components/poromechanics/exact_values.hpp"

namespace sprekk::poromechanics {
namespace {

using test::anisotropic_stiffness;
using test::compare;
using test::is_outer;
using test::linear_displacement;
using test::linear_gradient;
using test::mixed_conditions;
using test::traction_everywhere;
using Conditions = std::vector<FaceConditions>;

TEST(Mpsa, IsExactForLinearDisplacements) {
  for (const Mesh& mesh : {test::fractured_square(), test::square_with_single_corners(6), test::fractured_rectangles(),
                           test::square_with_narrow_gaps(), test::fractured_square(test::mixed(0.1, 0.3)),
                           generate_mesh(test::box(2, 1), test::structured(7, 5, 0.4)),
                           generate_mesh(test::box(2, 1), test::rectangles(7, 1, 0.4))})
    for (const Stiffness& c : {isotropic_stiffness(1.4, 0.8), anisotropic_stiffness()})
      for (const Conditions& conditions : {mixed_conditions(mesh), traction_everywhere(mesh)}) {
        const auto errors = compare(
            mesh, std::vector<Stiffness>(mesh.cell_count(), c), conditions, linear_displacement,
            [](int) { return linear_gradient; }, [](int) { return 0.6; });
        EXPECT_LT(errors.force, 1e-12);
        EXPECT_LT(errors.trace, 1e-12);
        EXPECT_LT(errors.volume, 1e-13);
      }
}

TEST(Mpsa, RotationsAndTranslationsAreFree) {
  const Mesh mesh = test::fractured_square();
  const Tensor rotation = (Tensor() << 0, -1, 1, 0).finished();
  const auto errors = compare(
      mesh, std::vector<Stiffness>(mesh.cell_count(), 1e10 * anisotropic_stiffness()), mixed_conditions(mesh),
      [&](const Point& x) -> Point { return Point(3, -2) + rotation * x; }, [&](int) { return rotation; },
      [](int) { return 0; });
  EXPECT_LT(errors.force, 1e10 * 1e-13);
  EXPECT_LT(errors.trace, 1e-12);
  EXPECT_LT(errors.volume, 1e-14);
}

/// Two triangles, each of them alone in one corner, where nothing but the other stops it from turning.
TEST(Mpsa, TrianglesAloneInACornerFollowTheirNeighbours) {
  const Mesh mesh = test::square_with_single_corners(1);
  const auto errors = compare(
      mesh, std::vector<Stiffness>(mesh.cell_count(), isotropic_stiffness(1, 1)), traction_everywhere(mesh),
      linear_displacement, [](int) { return linear_gradient; }, [](int) { return 0.0; });
  EXPECT_LT(errors.force, 1e-13);
  EXPECT_LT(errors.trace, 1e-13);
  EXPECT_LT(errors.volume, 1e-14);
}

TEST(Mpsa, RollersHoldATriangleAloneInACorner) {
  const Mesh mesh = test::square_with_single_corners(3);
  Conditions conditions = traction_everywhere(mesh);
  for (int f = 0; f < mesh.face_count(); ++f) {
    if (!is_outer(mesh, f)) continue;
    const std::string& side = mesh.side_names[mesh.face_side[f]];
    if (side == "left" || side == "right") conditions[f][0] = MechanicalCondition::displacement;
    if (side == "bottom") conditions[f][1] = MechanicalCondition::displacement;
  }
  const auto errors = compare(
      mesh, std::vector<Stiffness>(mesh.cell_count(), anisotropic_stiffness()), conditions, linear_displacement,
      [](int) { return linear_gradient; }, [](int) { return 1.0; });
  EXPECT_LT(errors.force, 1e-13);
  EXPECT_LT(errors.trace, 1e-13);
  EXPECT_LT(errors.volume, 1e-14);
}

/// A soft surrounding leaves a stiff triangle free to turn; forces and displacements stay of the size of their causes.
TEST(Mpsa, AStiffTriangleInSoftRockIsHarmless) {
  const Mesh mesh = generate_mesh(test::box(1, 1), test::unstructured(0.15, 0.2));
  int inner = 0;
  while ((mesh.cell_center[inner] - Point(0.5, 0.5)).norm() > 0.12) ++inner;
  for (const double contrast : {1e4, 1e10, 1e16}) {
    std::vector<Stiffness> stiffness(mesh.cell_count(), isotropic_stiffness(1, 1));
    stiffness[inner] *= contrast;
    const auto operators = discretize_mpsa(mesh, stiffness, traction_everywhere(mesh));
    for (int f = 0; f < mesh.face_count(); ++f)
      for (int row : {2 * f, 2 * f + 1})
        for (SparseMatrix::InnerIterator entry(operators.force_displacement, row); entry; ++entry)
          EXPECT_LT(std::abs(entry.value()), 20) << "contrast " << contrast;
  }
}

TEST(Mpsa, PrescribedForcesAreKeptToTheLastDigit) {
  const Mesh mesh = test::fractured_square();
  const auto conditions = mixed_conditions(mesh);
  const auto operators =
      discretize_mpsa(mesh, std::vector<Stiffness>(mesh.cell_count(), isotropic_stiffness(2e10, 1e10)), conditions);
  const Vector u = Vector::Random(2 * mesh.cell_count()), s = Vector::Random(mesh.cell_count()) * 1e7;
  const Vector b = Vector::Random(2 * mesh.face_count());
  const Vector forces = operators.force_displacement * u + operators.force_stress * s + operators.force_boundary * b;
  for (int f = 0; f < mesh.face_count(); ++f)
    for (int d = 0; d < 2; ++d)
      if (conditions[f][d] == MechanicalCondition::traction) {
        EXPECT_EQ(forces[2 * f + d], b[2 * f + d]);
      }
}

TEST(Mpsa, ChosenNodesGiveTheSameRows) {
  const Mesh mesh = test::fractured_square();
  const auto conditions = mixed_conditions(mesh);
  const std::vector<Stiffness> stiffness(mesh.cell_count(), anisotropic_stiffness());
  std::vector<char> nodes(mesh.node_count());
  for (int n = 0; n < mesh.node_count(); ++n) nodes[n] = mesh.nodes[n][0] < 0.6;
  const auto all = discretize_mpsa(mesh, stiffness, conditions);
  const auto some = discretize_mpsa(mesh, stiffness, conditions, nodes);
  int compared = 0;
  for (int f = 0; f < mesh.face_count(); ++f) {
    if (!nodes[mesh.face_nodes[f][0]] || !nodes[mesh.face_nodes[f][1]]) continue;
    ++compared;
    for (const int row : {2 * f, 2 * f + 1}) {
      EXPECT_EQ(test::row_difference(all.force_displacement, some.force_displacement, row), 0);
      EXPECT_EQ(test::row_difference(all.force_stress, some.force_stress, row), 0);
      EXPECT_EQ(test::row_difference(all.force_boundary, some.force_boundary, row), 0);
      EXPECT_EQ(test::row_difference(all.trace_displacement, some.trace_displacement, row), 0);
      EXPECT_EQ(test::row_difference(all.trace_stress, some.trace_stress, row), 0);
      EXPECT_EQ(test::row_difference(all.trace_boundary, some.trace_boundary, row), 0);
    }
  }
  EXPECT_GT(compared, mesh.face_count() / 3);
  for (int c = 0; c < mesh.cell_count(); ++c) {
    const int i = mesh.cell_nodes[c][0], j = mesh.cell_nodes[c][1], k = mesh.cell_nodes[c][2];
    if (!nodes[i] || !nodes[j] || !nodes[k]) continue;
    EXPECT_EQ(test::row_difference(all.volume_displacement, some.volume_displacement, c), 0);
    EXPECT_EQ(test::row_difference(all.volume_stress, some.volume_stress, c), 0);
    EXPECT_EQ(test::row_difference(all.volume_boundary, some.volume_boundary, c), 0);
  }
}

TEST(Mpsa, RefusesConditionsThatDoNotFitTheMesh) {
  const Mesh mesh = test::square_with_single_corners(2);
  const std::vector<Stiffness> stiffness(mesh.cell_count(), isotropic_stiffness(1, 1));
  const auto conditions = traction_everywhere(mesh);
  EXPECT_THROW(discretize_mpsa(mesh, {}, conditions), std::invalid_argument);
  EXPECT_THROW(discretize_mpsa(mesh, stiffness, {}), std::invalid_argument);
  EXPECT_THROW(discretize_mpsa(mesh, stiffness, conditions, {1}), std::invalid_argument);
  EXPECT_THROW(discretize_mpsa(mesh, stiffness, Conditions(mesh.face_count())), std::invalid_argument);
  EXPECT_THROW(
      discretize_mpsa(mesh, stiffness,
                      Conditions(mesh.face_count(), {MechanicalCondition::traction, MechanicalCondition::traction})),
      std::invalid_argument);
}

}  // namespace
}  // namespace sprekk::poromechanics
