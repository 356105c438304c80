// Boxes in any direction, with conditions along the normals and tangents of their sides.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "components/poromechanics/rock.hpp"
#include "framework/mesh/build_mesh.hpp"
#include "tests/components/meshes.hpp"
#include "tests/verification/mesh_file.hpp"
#include "tests/verification/scene_run.hpp"

namespace sprekk::testing {
namespace {

const Tensor mirrored = (Tensor() << -1, 0, 0, 1).finished();
const Point shift(0.013, -0.009);

/// Cells alone in corners, a mesh of both shapes, rectangles.
std::vector<Mesh> boxes() {
  return {test::square_with_single_corners(5), generate_mesh(test::box(1, 1), test::mixed(0.15, 0.2)),
          generate_mesh(test::box(1, 1), test::rectangles(5, 4, 0.3)),
          generate_mesh(test::box(1, 1), test::unstructured(0.17, 0.2))};
}

const poromechanics::Rock& rock_of(SceneRun& run) {
  for (const Part* part : run.model().parts())
    if (const auto* rock = dynamic_cast<const poromechanics::Rock*>(part)) return *rock;
  throw std::logic_error("a scene without rock");
}

constexpr double young = 10e9, poisson = 0.25;
constexpr double shear_modulus = young / (2 * (1 + poisson)), lambda = 2 * shear_modulus * poisson / (1 - 2 * poisson);

SceneRun box_of_rock(const std::string& mesh, const std::string& boundary, const std::string& more = "") {
  return SceneRun::from_text("{geometry: {file: " + mesh +
                             "}, components: {rock: {type: poromechanics/mpsa, young_modulus: 10 GPa, poisson_ratio: "
                             "0.25, boundary: " +
                             boundary + more + "}}, schedule: [{solve: rock}], time: {end: 2 h, step: 1 h}}");
}

/// The gradient and the stress of the whole box, along x and y.
void expect_uniform(SceneRun& run, const Tensor& gradient, const Point& at_rest) {
  const auto& rock = rock_of(run);
  const Mesh& mesh = run.mesh();
  const Tensor strain = 0.5 * (gradient + gradient.transpose());
  const Tensor stress = lambda * strain.trace() * Tensor::Identity() + 2 * shear_modulus * strain;
  const Vector forces = rock.face_forces(), outer = rock.outer_displacement();
  for (int c = 0; c < mesh.cell_count(); ++c)
    EXPECT_LT(
        (Point(run.field("rock.displacement").segment<2>(2 * c)) - gradient * (mesh.cell_center[c] - at_rest)).norm(),
        1e-10 * strain.norm());
  for (int f = 0; f < mesh.face_count(); ++f) {
    EXPECT_LT((Point(forces.segment<2>(2 * f)) / mesh.face_measure[f] - stress * mesh.face_normal[f]).norm(),
              1e-10 * stress.norm());
    if (mesh.face_cells[f][1] == none) {
      EXPECT_LT((Point(outer.segment<2>(2 * f)) - gradient * (mesh.face_center[f] - at_rest)).norm(),
                1e-10 * strain.norm());
    }
  }
}

class TurnedBox : public ::testing::TestWithParam<Tensor> {
 protected:
  const Tensor map = GetParam();
  const bool is_mirrored = map.determinant() < 0;
  const Point corner = shift;  ///< where the box has its origin
  /// A tensor in the frame of the box, along x and y.
  Tensor in_space(const Tensor& of_box) const { return map * of_box * map.transpose(); }
  std::string file(const Mesh& mesh) const { return write_msh(to_raw_mesh(mesh), map, shift, "turned_box"); }
};

/// Two rollers meet in each of two corners, a roller and a load in the others; the roller on the right moves.
TEST_P(TurnedBox, UniformStressBetweenRollersAndALoad) {
  for (const Mesh& mesh : boxes()) {
    SceneRun run = box_of_rock(file(mesh),
                               "{left: {displacement_normal: 0 m}, bottom: {displacement_normal: 0 m}, right: "
                               "{displacement_normal: (2e-3*t/h) m}, top: {normal_stress: -10 MPa}}");
    for (const double hours : {1, 2}) {
      ASSERT_TRUE(run.step());
      const double along = 2e-3 * hours, across = (-10e6 - lambda * along) / (lambda + 2 * shear_modulus);
      expect_uniform(run, in_space(Point(along, across).asDiagonal()), corner);
    }
  }
}

/// Rollers on two sides that are not parallel hold the rock.
TEST_P(TurnedBox, UniformStressHeldByTwoRollers) {
  for (const Mesh& mesh : boxes()) {
    SceneRun run = box_of_rock(file(mesh),
                               "{left: {displacement_normal: 0 m}, bottom: {displacement_normal: 0 m}, right: "
                               "{normal_stress: -4 MPa}, top: {normal_stress: -10 MPa}}");
    ASSERT_TRUE(run.step());
    // Of stresses (a, b): strain a = ((1 − nu) a − nu b) / 2G.
    const double along = ((1 - poisson) * -4e6 - poisson * -10e6) / (2 * shear_modulus);
    const double across = ((1 - poisson) * -10e6 - poisson * -4e6) / (2 * shear_modulus);
    expect_uniform(run, in_space(Point(along, across).asDiagonal()), corner);
  }
}

/// Simple shear. The tangent has the rock on its left: it turns the other way in a mirrored box.
TEST_P(TurnedBox, UniformShear) {
  const double slope = 1e-3, shear = shear_modulus * slope, sign = is_mirrored ? -1 : 1;
  for (const Mesh& mesh : boxes()) {
    SceneRun run = box_of_rock(
        file(mesh),
        fmt::format("{{bottom: {{displacement_normal: 0 m, displacement_tangential: 0 m}}, "
                    "top: {{displacement_tangential: {:.17g} m, displacement_normal: 0 m}}, "
                    "left: {{shear_stress: {:.17g} Pa, displacement_normal: {:.17g}*({:.17g}*(x-({:.17g}))+"
                    "{:.17g}*(y-({:.17g})))}}, right: {{shear_stress: {:.17g} Pa, normal_stress: 0}}}}",
                    -sign * slope, sign * shear, -slope, map(0, 1), corner.x(), map(1, 1), corner.y(), sign * shear));
    ASSERT_TRUE(run.step());
    expect_uniform(run, in_space((Tensor() << 0, slope, 0, 0).finished()), corner);
  }
}

/// A stress that its sides bear moves nothing.
TEST_P(TurnedBox, InitialStressInEquilibriumMovesNothing) {
  const Tensor stress = (Tensor() << -17e6, 3e6, 3e6, -9e6).finished(), of_box = map.transpose() * stress * map;
  const double shear = (is_mirrored ? -1 : 1) * of_box(0, 1);
  for (const Mesh& mesh : boxes()) {
    SceneRun run = box_of_rock(
        file(mesh),
        fmt::format("{{left: {{displacement_normal: 0 m, shear_stress: {0:.17g} Pa}}, right: {{normal_stress: {1:.17g} "
                    "Pa, shear_stress: {0:.17g} Pa}}, bottom: {{displacement_normal: 0 m, shear_stress: {2:.17g} Pa}}, "
                    "top: {{normal_stress: {3:.17g} Pa, displacement_tangential: 0 m}}}}",
                    shear, of_box(0, 0), -shear, of_box(1, 1)),
        ", initial_stress: {xx: -17 MPa, yy: -9 MPa, xy: 3 MPa}");
    ASSERT_TRUE(run.step());
    EXPECT_LT(run.field("rock.displacement").lpNorm<Eigen::Infinity>(), 1e-12 * stress.norm() / young);
    // Eigenvectors: no line has a larger traction than the largest principal stress.
    const double largest = 13e6 + std::hypot(4e6, 3e6);
    EXPECT_LT(rock_of(run).largest_load(), largest * (1 + 1e-12));
    EXPECT_GT(rock_of(run).largest_load(), 0.9 * largest);
  }
}

std::string name_of_direction(const ::testing::TestParamInfo<TurnedBox::ParamType>& info) {
  constexpr const char* names[] = {"AsDrawn", "By30", "By77", "Mirrored", "MirroredAndBy30", "ByNextToNothing"};
  return names[info.index];
}

INSTANTIATE_TEST_SUITE_P(Directions, TurnedBox,
                         ::testing::Values(turned_by(0), turned_by(30), turned_by(77), mirrored,
                                           turned_by(30) * mirrored, turned_by(1e-7)),
                         name_of_direction);

/// Pore pressure and displacement of Terzaghi's column after each step. `conditions`: of left, right and top.
struct Column {
  std::vector<Point> centers;  ///< of the cells, m
  std::vector<Vector> pressure, displacement;
  double largest_load = 0;
};
Column consolidated(const std::string& mesh, const std::array<std::string, 3>& conditions) {
  SceneRun run = SceneRun::from_text(
      "{geometry: {file: " + mesh +
      "}, components: {pore: {type: matrix_flow/mpfa, permeability: 1 m^2, viscosity: 1 Pa*s, storage: 0.5 1/Pa, "
      "boundary: {bottom: {pressure: 0 Pa}}}, rock: {type: poromechanics/mpsa, young_modulus: 1.6666666666666667 Pa, "
      "poisson_ratio: 0.25, boundary: {left: " +
      conditions[0] + ", right: " + conditions[1] + ", top: " + conditions[2] +
      ", bottom: {normal_stress: -2 Pa}}}}, couplers: [{type: biot, between: [pore, rock], biot_coefficient: 1}], "
      "schedule: [{solve: [pore, rock]}], time: {end: 0.1 s, step: 0.02 s}}");
  Column column;
  column.centers = run.mesh().cell_center;
  run.run_until(0.1, [&] {
    column.pressure.push_back(run.field("pore.pressure"));
    column.displacement.push_back(run.field("rock.displacement"));
  });
  column.largest_load = rock_of(run).largest_load();
  return column;
}

TEST(TurnedColumn, ConsolidatesLikeAnUprightOne) {
  const std::string roller = "{displacement_normal: 0 m}";
  Geometry box = test::box(0.1, 1);
  for (const MeshOptions& options :
       {test::rectangles(4, 40), test::structured(4, 40, 0.2), test::mixed(0.04, 0.2), test::unstructured(0.04, 0.2)}) {
    const RawMesh mesh = to_raw_mesh(generate_mesh(box, options));
    const Column upright = consolidated(write_msh(mesh, Tensor::Identity(), Point::Zero(), "upright"),
                                        {"{displacement_x: 0 m}", "{displacement_x: 0 m}", "{displacement_y: 0 m}"});
    ASSERT_EQ(upright.pressure.size(), 5u);
    for (const Tensor& map : {turned_by(0), turned_by(30), Tensor(turned_by(77) * mirrored)}) {
      const Column turned = consolidated(write_msh(mesh, map, shift, "turned"), {roller, roller, roller});
      ASSERT_EQ(turned.pressure.size(), 5u);
      for (std::size_t c = 0; c < turned.centers.size(); ++c) {
        // Cells of a file are numbered by their places.
        const Point was = map.transpose() * (turned.centers[c] - shift);
        const auto distance = [&](const Point& center) { return (center - was).squaredNorm(); };
        const auto d = std::ranges::min_element(upright.centers, {}, distance) - upright.centers.begin();
        for (int i = 0; i < 5; ++i) {
          EXPECT_NEAR(turned.pressure[i][c], upright.pressure[i][d], 1e-9);  // of 1 Pa
          EXPECT_LT(
              (Point(turned.displacement[i].segment<2>(2 * c)) - map * Point(upright.displacement[i].segment<2>(2 * d)))
                  .norm(),
              1e-9);  // of 0.5 m
        }
      }
      EXPECT_NEAR(turned.largest_load, upright.largest_load, 1e-12);
    }
  }
}

}  // namespace
}  // namespace sprekk::testing
