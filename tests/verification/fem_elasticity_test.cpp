// Finite elements without fluid: orders on smooth solutions, and nearly incompressible rock.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "framework/mesh/build_mesh.hpp"
#include "tests/components/meshes.hpp"
#include "tests/verification/fem_errors.hpp"
#include "tests/verification/mesh_file.hpp"

namespace sprekk::testing {
namespace {

const double pi = M_PI;

/// u = (sin pi x sin pi y, cos pi x sin pi y / 2) in a unit square with lambda = 1.5, G = 1 (E = 2.6, nu = 0.3), held
/// on the left and at the bottom and loaded by its tractions on the other sides.
struct Smooth {
  static Point displacement(const Point& x) {
    return {std::sin(pi * x[0]) * std::sin(pi * x[1]), std::cos(pi * x[0]) * std::sin(pi * x[1]) / 2};
  }
  static Eigen::Vector3d stress(const Point& x) {
    const double sx = std::sin(pi * x[0]), cx = std::cos(pi * x[0]), sy = std::sin(pi * x[1]), cy = std::cos(pi * x[1]);
    const double xx = pi * cx * sy, yy = pi / 2 * cx * cy, xy = pi * sx * cy - pi / 2 * sx * sy;
    return {3.5 * xx + 1.5 * yy, 1.5 * xx + 3.5 * yy, xy};
  }
  static SceneRun run(const std::string& order, const std::string& mesh) {
    const char* u = "{displacement: [\"(sin(pi*x)*sin(pi*y)) m\", \"(cos(pi*x)*sin(pi*y)/2) m\"]}";
    const char* xx = "(3.5*pi*cos(pi*x)*sin(pi*y) + 0.75*pi*cos(pi*x)*cos(pi*y)) Pa";
    const char* yy = "(1.5*pi*cos(pi*x)*sin(pi*y) + 1.75*pi*cos(pi*x)*cos(pi*y)) Pa";
    const char* xy = "(pi*sin(pi*x)*cos(pi*y) - pi/2*sin(pi*x)*sin(pi*y)) Pa";
    return SceneRun::from_text(fmt::format(
        "{{geometry: {{box: {{x: [0, 1], y: [0, 1]}}}}, mesh: {{{}}}, components: {{rock: {{type: poromechanics/fem, "
        "order: {}, young_modulus: 2.6 Pa, poisson_ratio: 0.3, body_force: [\"(2.5*pi^2*(sin(pi*x)*sin(pi*y) + "
        "sin(pi*x)*cos(pi*y)/2) + 2*pi^2*sin(pi*x)*sin(pi*y)) N/m^3\", \"(2.5*pi^2*(cos(pi*x)*sin(pi*y)/2 - "
        "cos(pi*x)*cos(pi*y)) + pi^2*cos(pi*x)*sin(pi*y)) N/m^3\"], boundary: {{left: {}, bottom: {}, right: "
        "{{traction: [\"{}\", \"{}\"]}}, top: {{traction: [\"{}\", \"{}\"]}}}}}}}}, couplers: [], schedule: [{{solve: "
        "[rock]}}], time: {{end: 1 s, step: 1 s}}}}",
        mesh, order, u, u, xx, xy, xy, yy));
  }
};

struct Errors {
  double displacement, stress;
};

Errors smooth_errors(const std::string& order, const std::string& mesh) {
  SceneRun run = Smooth::run(order, mesh);
  EXPECT_TRUE(run.step());
  return {displacement_error(run, Smooth::displacement), stress_error(run, Smooth::stress)};
}

double order_of(double coarse, double fine) { return std::log2(coarse / fine); }

TEST(FemElasticity, HasItsOrders) {
  double of_triangles = 0;
  for (const char* shape : {"triangles", "quadrilaterals"})
    for (const char* order : {"first", "second"}) {
      const bool is_second = std::string(order) == "second";
      const auto mesh = [&](int cells) {
        return fmt::format("kind: structured, cells: [{}, {}], shape: {}, distortion: 0.3", cells, cells, shape);
      };
      const Errors coarse = smooth_errors(order, mesh(10)), fine = smooth_errors(order, mesh(20));
      RecordProperty(fmt::format("{}_{}", shape, order),
                     fmt::format("{:.3g} {:.3g}; {:.3g} {:.3g}", coarse.displacement, fine.displacement, coarse.stress,
                                 fine.stress));
      EXPECT_GT(order_of(coarse.displacement, fine.displacement), is_second ? 2.9 : 1.9)
          << shape << " " << order << " " << coarse.displacement << " " << fine.displacement;
      EXPECT_GT(order_of(coarse.stress, fine.stress), is_second ? 1.9 : 0.9)
          << shape << " " << order << " " << coarse.stress << " " << fine.stress;
      EXPECT_LT(fine.displacement, is_second ? 2e-4 : 1e-2) << shape << " " << order;
      // The nodes are the same, and bilinear displacements bend with the cell.
      if (std::string(shape) == "triangles" && !is_second) of_triangles = coarse.displacement;
      if (std::string(shape) == "quadrilaterals" && !is_second) {
        EXPECT_LT(coarse.displacement, of_triangles);
      }
    }
}

/// u = (sin pi x cos pi y, −cos pi x sin pi y) has no divergence: with G = 1 the body force is 2 pi^2 u for every nu.
double divergence_free_error(const std::string& order, const std::string& shape, double poisson, int cells) {
  const char* u = "{displacement: [\"(sin(pi*x)*cos(pi*y)) m\", \"(-cos(pi*x)*sin(pi*y)) m\"]}";
  SceneRun run = SceneRun::from_text(fmt::format(
      "{{geometry: {{box: {{x: [0, 1], y: [0, 1]}}}}, mesh: {{kind: structured, cells: [{}, {}], distortion: 0.3, "
      "shape: {}}}, components: {{rock: {{type: poromechanics/fem, order: {}, young_modulus: {:.17g} Pa, "
      "poisson_ratio: {}, "
      "body_force: [\"(2*pi^2*sin(pi*x)*cos(pi*y)) N/m^3\", \"(-2*pi^2*cos(pi*x)*sin(pi*y)) N/m^3\"], boundary: "
      "{{left: "
      "{}, bottom: {}, right: {}, top: {{displacement_x: \"(-sin(pi*x)) m\", traction_y: \"(-2*pi*cos(pi*x)*cos(pi*y)) "
      "Pa\"}}}}}}}}, couplers: [], schedule: [{{solve: [rock]}}], time: {{end: 1 s, step: 1 s}}}}",
      cells, cells, shape, order, 2 * (1 + poisson), poisson, u, u, u));
  EXPECT_TRUE(run.step());
  return displacement_error(run, [](const Point& x) {
    return Point(std::sin(pi * x[0]) * std::cos(pi * x[1]), -std::cos(pi * x[0]) * std::sin(pi * x[1]));
  });
}

TEST(FemElasticity, NoOrderLocks) {
  for (const char* shape : {"triangles", "quadrilaterals"})
    for (const char* order : {"first", "second"}) {
      const bool is_first = order == std::string("first");
      const double usual = divergence_free_error(order, shape, 0.3, 12);
      const double second = shape == std::string("triangles") ? 1e-3 : 1.5e-3;
      EXPECT_LT(usual, is_first ? 0.02 : second) << shape;
      for (const double poisson : {0.3, 0.34, 0.49, 0.4999, 0.499999}) {
        const double error = divergence_free_error(order, shape, poisson, 12);
        RecordProperty(fmt::format("{}_{}_{}", shape, order, poisson), fmt::format("{:.3g}", error));
        EXPECT_LT(error, (is_first ? 1.2 : 3) * usual) << shape << " " << order << " " << poisson << " " << usual;
      }
    }
}

/// Rollers on three sides of a box in some direction, one of which moves, and a load on the fourth.
TEST(FemElasticity, UniformStressBetweenRollersInBoxesOfAnyDirection) {
  const Tensor mirrored = (Tensor() << -1, 0, 0, 1).finished();
  const Point corner(0.013, -0.009);
  for (const double poisson : {0.25, 0.4999})
    for (const double degrees : {0.0, 30.0, 77.0, 180.0})
      for (const Mesh& mesh :
           {generate_mesh(test::box(1, 1), test::mixed(0.15, 0.2)), test::square_with_single_corners(5)})
        for (const char* order : {"first", "second"}) {
          const double shear = 5e9 / (1 + poisson), lambda = 2 * shear * poisson / (1 - 2 * poisson), along = 2e-3,
                       across = (-10e6 - lambda * along) / (lambda + 2 * shear);
          Tensor map = Eigen::Rotation2D(degrees * pi / 180).toRotationMatrix();
          if (degrees == 180) map = mirrored;
          SceneRun run = SceneRun::from_text(
              "{geometry: {file: " + write_msh(to_raw_mesh(mesh), map, corner, "fem_box") +
              "}, components: {rock: {type: poromechanics/fem, order: " + order +
              fmt::format(", young_modulus: 10 GPa, poisson_ratio: {}, ", poisson) +
              "boundary: {left: {displacement_normal: 0 m}, bottom: "
              "{displacement_normal: 0 m}, right: {displacement_normal: 2e-3 m}, top: {normal_stress: -10 MPa}}}}, "
              "schedule: [{solve: rock}], time: {end: 1 h, step: 1 h}}");
          ASSERT_TRUE(run.step());
          const Tensor strain = map * Tensor(Point(along, across).asDiagonal()) * map.transpose();
          const Tensor expected = lambda * strain.trace() * Tensor::Identity() + 2 * shear * strain;
          for (int i = 0; i < run.mesh().node_count(); ++i)
            EXPECT_LT(
                (run.field("rock.displacement").segment<2>(2 * i) - strain * (run.mesh().nodes[i] - corner)).norm(),
                1e-10 * strain.norm());
          const Vector stress = stress_of_cells(run);
          for (int c = 0; c < run.mesh().cell_count(); ++c)
            EXPECT_LT(
                (stress.segment<3>(3 * c) - Eigen::Vector3d(expected(0, 0), expected(1, 1), expected(0, 1))).norm(),
                1e-10 * expected.norm());
        }
}

}  // namespace
}  // namespace sprekk::testing
