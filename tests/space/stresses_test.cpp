// MPSA in space: exact for linear displacements on every kind of body.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <random>
#include <vector>

#include "tests/space/flux_cases.hpp"
#include "tests/space/stress_cases.hpp"

namespace sprekk::test {
namespace {

using poromechanics::discretize_mpsa;
using poromechanics::isotropic_stiffness;

constexpr Bodies all_bodies[] = {Bodies::hexahedra, Bodies::wedges, Bodies::tetrahedra, Bodies::hexahedra_and_wedges};

Tensor some_gradient() {
  Tensor gradient;
  gradient << 0.7, -1.1, 0.3, 0.4, 0.9, -0.2, -0.5, 0.6, -0.8;
  return gradient;
}

ExactStress linear(const Tensor& gradient, double isotropic) {
  return {[=](const Point& x) -> Point { return Point(0.3, -0.2, 0.5) + gradient * x; }, [=](int) { return gradient; },
          [=](int) { return isotropic; }};
}

TEST(StressesInSpace, LinearDisplacementsAreExactWithFracturesOnEveryBody) {
  for (const Bodies bodies : all_bodies)
    for (const int count : {3, 4}) {
      const Mesh mesh = bent_box(count, bodies, Bend::all, true);
      for (const Stiffness& rock : {isotropic_stiffness(1.4, 0.8), some_stiffness()})
        for (const auto& conditions : {given_tractions(mesh), all_kinds_of_conditions(mesh), rollers(mesh)}) {
          const std::vector<Stiffness> stiffness(mesh.cell_count(), rock);
          const StressErrors errors = errors_of(discretize_mpsa(mesh, stiffness, conditions), mesh, stiffness,
                                                conditions, linear(some_gradient(), 0.6));
          EXPECT_LT(errors.force, 1e-12);
          EXPECT_LT(errors.trace, 1e-12);
          EXPECT_LT(errors.volume, 1e-13);
        }
    }
}

/// Moduli of a rock, so that a stress would show.
TEST(StressesInSpace, RotationsAndTranslationsAreFree) {
  Tensor rotation;
  rotation << 0, -0.3, 0.7, 0.3, 0, -0.5, -0.7, 0.5, 0;
  for (const Bodies bodies : all_bodies) {
    const Mesh mesh = bent_box(3, bodies, Bend::all, false);
    const std::vector<Stiffness> stiffness(mesh.cell_count(), 1e10 * some_stiffness());
    for (const auto& conditions : {given_tractions(mesh), all_kinds_of_conditions(mesh)}) {
      const StressErrors errors =
          errors_of(discretize_mpsa(mesh, stiffness, conditions), mesh, stiffness, conditions, linear(rotation, 0));
      EXPECT_LT(errors.force, 1e10 * 1e-12);
      EXPECT_LT(errors.trace, 1e-12);
      EXPECT_LT(errors.volume, 1e-13);
    }
  }
}

/// Two rocks that meet in a plane, each with a linear displacement and an isotropic stress of its own.
struct Layers {
  Mesh mesh;
  std::vector<Stiffness> stiffness;
  Tensor gradients[2];
  double isotropic[2] = {0.6, -0.3};
  Point on_plane;

  Layers(Bodies bodies, double contrast, const Eigen::AngleAxisd& rotation) {
    BoxMesh box({4, 3, 3}, bodies);
    std::mt19937 random(3);
    std::uniform_real_distribution<double> amount(-0.15, 0.15);
    for (Point& node : box.raw.nodes) {
      const bool is_inside = node[0] > 0 && node[0] < 4 && node[1] > 0 && node[1] < 3 && node[2] > 0 && node[2] < 3;
      const double x = amount(random), y = amount(random), z = amount(random);
      if (is_inside) node += Point(node[0] == 2 ? 0 : x, y, z);
    }
    box.turn(rotation);
    mesh = build_mesh(box.raw);
    on_plane = rotation * Point(2, 1, 1);
    normal = rotation * Point::UnitX();
    const Stiffness rocks[2] = {some_stiffness(), contrast * isotropic_stiffness(0.3, 1.4)};
    for (int c = 0; c < mesh.cell_count(); ++c) stiffness.push_back(rocks[layer(mesh.cell_center[c])]);
    // The other gradient differs by a ⊗ n; a makes the tractions agree.
    gradients[0] = some_gradient();
    const auto traction = [&](int rock, const Tensor& gradient, double s) -> Point {
      const SymmetricTensor of_rock = rocks[rock] * poromechanics::strain_of(gradient);
      Tensor stress = -s * Tensor::Identity();
      for (int k = 0; k < symmetric_components; ++k) {
        const auto [i, j] = symmetric_axes[k];
        stress(i, j) += of_rock[k];
        if (i != j) stress(j, i) += of_rock[k];
      }
      return stress * normal;
    };
    Tensor acoustic;
    for (int c = 0; c < 3; ++c) acoustic.col(c) = traction(1, Point::Unit(c) * normal.transpose(), 0);
    const Point missing = traction(0, gradients[0], isotropic[0]) - traction(1, gradients[0], isotropic[1]);
    gradients[1] = gradients[0] + acoustic.inverse() * missing * normal.transpose();
  }

  int layer(const Point& x) const { return normal.dot(x - on_plane) < 0 ? 0 : 1; }
  ExactStress exact() const {
    return {[this](const Point& x) -> Point { return gradients[layer(x)] * (x - on_plane); },
            [this](int c) { return gradients[layer(mesh.cell_center[c])]; },
            [this](int c) { return isotropic[layer(mesh.cell_center[c])]; }};
  }
  bool is_between(int face) const {
    const auto [one, other] = mesh.face_cells[face];
    return other != none && layer(mesh.cell_center[one]) != layer(mesh.cell_center[other]);
  }

  Point normal;
};

TEST(StressesInSpace, TwoLayersAreExactAtAnyContrastAndUnderALoadBetweenThem) {
  const Eigen::AngleAxisd rotation(0.7, Point(1, 2, -1).normalized());
  for (const Bodies bodies : {Bodies::hexahedra, Bodies::wedges, Bodies::tetrahedra})
    for (const double contrast : {1.0, 1e4})
      for (const bool is_loaded : {false, true}) {
        Layers layers(bodies, contrast, rotation);
        if (is_loaded) layers.gradients[1] += 0.1 / contrast * Point(1, -2, 0.5) * layers.normal.transpose();
        for (auto conditions : {given_tractions(layers.mesh), all_kinds_of_conditions(layers.mesh)}) {
          if (is_loaded)
            for (int f = 0; f < layers.mesh.face_count(); ++f)
              if (layers.is_between(f)) conditions[f].along.fill(MechanicalCondition::load);
          const StressErrors errors = errors_of(discretize_mpsa(layers.mesh, layers.stiffness, conditions), layers.mesh,
                                                layers.stiffness, conditions, layers.exact());
          EXPECT_LT(errors.force, 1e-12 * contrast);
          EXPECT_LT(errors.trace, contrast == 1 ? 1e-12 : 1e-10);
          EXPECT_LT(errors.volume, contrast == 1 ? 1e-13 : 1e-11);
        }
      }
}

TEST(StressesInSpace, ChosenNodesGiveTheSameRows) {
  const Mesh mesh = bent_box(3, Bodies::hexahedra_and_wedges, Bend::all, true);
  const std::vector<Stiffness> stiffness(mesh.cell_count(), some_stiffness());
  const auto conditions = all_kinds_of_conditions(mesh);
  std::vector<char> nodes(mesh.node_count());
  for (int n = 0; n < mesh.node_count(); ++n) nodes[n] = mesh.nodes[n][0] < 0.6;
  const StressOperators all = discretize_mpsa(mesh, stiffness, conditions),
                        some = discretize_mpsa(mesh, stiffness, conditions, nodes);
  const Vector u = Vector::Random(3 * mesh.cell_count()), of_all = all.force_displacement * u,
               of_some = some.force_displacement * u;
  int compared = 0;
  for (int f = 0; f < mesh.face_count(); ++f) {
    const FaceNodes& of_face = mesh.face_nodes[f];
    if (!std::all_of(of_face.begin(), of_face.end(), [&](int node) { return nodes[node]; })) continue;
    ++compared;
    EXPECT_EQ(of_all.segment<3>(3 * f), of_some.segment<3>(3 * f));
  }
  EXPECT_GT(compared, mesh.face_count() / 3);
}

}  // namespace
}  // namespace sprekk::test
