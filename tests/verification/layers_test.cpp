// An inclined layer in a box whose displacement is linear in each layer: the stress is exact, whatever makes it jump.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "tests/verification/scene_run.hpp"

namespace sprekk::testing {
namespace {

/// Stress as (xx, yy, xy), Pa.
using Stress = Eigen::Vector3d;

/// The layer lies between n·(x − x0) = 0 and its thickness; displacements are zero below it, a ⊗ n · x in it, and a
/// times the thickness above it, beside a gradient along the normal that is everywhere.
struct InclinedLayer {
  double angle, young = 1e9, poisson = 0.25;
  double young_inside = 1e9, poisson_inside = 0.25;
  double pore_stress = 0;                                            ///< alpha p in the layer, Pa
  Stress initial = Stress::Zero(), initial_inside = Stress::Zero();  ///< Pa
  Point stretch = Point::Zero();                                     ///< of the rock around, along n
  std::string mesh = "size: 0.15 m";
  std::string rock = "poromechanics/mpsa";

  static constexpr double thickness = 0.3;
  Point normal() const { return {-std::sin(angle), std::cos(angle)}; }
  Point start() const { return {0.5, 0.5}; }
  double distance(const Point& x) const { return normal().dot(x - start()); }
  bool is_inside(const Point& x) const { return distance(x) > 0 && distance(x) < thickness; }

  static Stress stress_of(double young, double poisson, const Tensor& g) {
    const double lambda = young * poisson / ((1 + poisson) * (1 - 2 * poisson)), shear = young / (2 * (1 + poisson));
    return {lambda * g.trace() + 2 * shear * g(0, 0), lambda * g.trace() + 2 * shear * g(1, 1),
            shear * (g(0, 1) + g(1, 0))};
  }
  Point traction(const Stress& s) const {
    return {s[0] * normal()[0] + s[2] * normal()[1], s[2] * normal()[0] + s[1] * normal()[1]};
  }
  /// By which the gradient along n is larger in the layer: so that the traction on its sides is that of the rock
  /// around.
  Point jump() const {
    const Stress outside = stress_of(young, poisson, stretch * normal().transpose()) + initial;
    const Stress inside = stress_of(young_inside, poisson_inside, stretch * normal().transpose()) + initial_inside -
                          Stress(pore_stress, pore_stress, 0);
    Tensor acoustic;
    for (int i = 0; i < 2; ++i)
      acoustic.col(i) = traction(stress_of(young_inside, poisson_inside, Point::Unit(i) * normal().transpose()));
    return acoustic.inverse() * (traction(outside) - traction(inside));
  }
  Stress stress(const Point& x) const {
    if (!is_inside(x)) return stress_of(young, poisson, stretch * normal().transpose()) + initial;
    return stress_of(young_inside, poisson_inside, (stretch + jump()) * normal().transpose()) + initial_inside -
           Stress(pore_stress, pore_stress, 0);
  }
  Point displacement(const Point& x) const {
    return stretch * distance(x) + jump() * std::clamp(distance(x), 0.0, thickness);
  }

  SceneRun run() const {
    const Point n = normal();
    const double slope = std::tan(angle), rise = thickness / std::cos(angle), left = 0.5 - 0.5 * slope;
    const auto expression = [&](int k) {
      const std::string distance = fmt::format("({:.17g}*(x-0.5)+{:.17g}*(y-0.5))", n[0], n[1]);
      return fmt::format("\"({:.17g}*{}+{:.17g}*max(0,min({},{}))) m\"", stretch[k], distance, jump()[k], thickness,
                         distance);
    };
    const std::string side = fmt::format("{{displacement: [{}, {}]}}", expression(0), expression(1));
    const auto by_region = [](double inside, double outside, const char* unit) {
      return fmt::format("{{regions: {{layer: {:.17g} {}, rock: {:.17g} {}}}}}", inside, unit, outside, unit);
    };
    return SceneRun::from_text(fmt::format(
        "{{geometry: {{box: {{x: [0 m, 1 m], y: [-0.6 m, 1.9 m]}}, regions: {{layer: {{polygon: [[0 m, {:.17g} m], [1 "
        "m, {:.17g} m], [1 m, {:.17g} m], [0 m, {:.17g} m]]}}}}}}, mesh: {{{}}}, components: {{pore: {{type: "
        "matrix_flow/mpfa, permeability: 0 m^2, viscosity: 1 Pa*s, storage: 1 1/Pa, source: {}}}, rock: {{type: "
        "{}, young_modulus: {}, poisson_ratio: {}, initial_stress: {{xx: {}, yy: {}, xy: {}}}, "
        "boundary: {{left: {}, right: {}, bottom: {}, top: {}}}}}}}, couplers: [{{type: biot, between: [pore, rock], "
        "biot_coefficient: 1}}], schedule: [{{solve: pore}}, {{solve: rock}}], time: {{end: 1 s, step: 1 s}}}}",
        left, left + slope, left + slope + rise, left + rise, mesh, by_region(pore_stress, 0, "1/s"), rock,
        by_region(young_inside, young, "Pa"), by_region(poisson_inside, poisson, ""),
        by_region(initial_inside[0], initial[0], "Pa"), by_region(initial_inside[1], initial[1], "Pa"),
        by_region(initial_inside[2], initial[2], "Pa"), side, side, side, side));
  }
};

Vector stress_of_cells(const SceneRun& run) {
  std::vector<OutputField> fields;
  for (const auto& component : const_cast<SceneRun&>(run).model().components()) component->output(fields);
  for (const OutputField& field : fields)
    if (field.name == "rock.stress") return field.values;
  return {};
}

void expect_exact(const InclinedLayer& layer) {
  SceneRun run = layer.run();
  run.run();
  const Vector stress = stress_of_cells(run);
  double largest = 0, error = 0, move = 0, moved = 0;
  for (int c = 0; c < run.mesh().cell_count(); ++c) {
    const Point& x = run.mesh().cell_center[c];
    largest = std::max(largest, layer.stress(x).norm());
    error = std::max(error, (stress.segment<3>(3 * c) - layer.stress(x)).norm());
    moved = std::max(moved, layer.displacement(x).norm());
  }
  const Vector& displacement = run.field("rock.displacement");
  const bool is_nodal = run.model().fields().at("rock.displacement").spec().location == Location::node;
  for (int i = 0; i < displacement.size() / 2; ++i) {
    const Point& x = is_nodal ? run.mesh().nodes[i] : run.mesh().cell_center[i];
    move = std::max(move, (displacement.segment<2>(2 * i) - layer.displacement(x)).norm());
  }
  EXPECT_GT(moved, 1e-5);
  EXPECT_LT(error, 1e-7 * largest) << "angle " << layer.angle << ", " << layer.mesh;
  EXPECT_LT(move, 1e-8 * moved) << "angle " << layer.angle << ", " << layer.mesh;
}

const double angles[] = {0, 0.2, M_PI / 6, -0.6};
const char* const meshes[] = {"size: 0.15 m, distortion: 0.2", "size: 0.15 m, shape: quadrilaterals"};

TEST(InclinedLayer, AJumpOfThePorePressureIsExact) {
  for (const double angle : angles)
    for (const char* mesh : meshes) {
      InclinedLayer layer{.angle = angle};
      layer.pore_stress = 8e5;
      layer.mesh = mesh;
      expect_exact(layer);
    }
}

TEST(InclinedLayer, AJumpOfTheStiffnessIsExact) {
  for (const double angle : angles)
    for (const double factor : {1 + 1e-9, 2.0, 0.1, 1e4})
      for (const char* mesh : meshes) {
        InclinedLayer layer{.angle = angle};
        layer.young_inside = factor * layer.young;
        layer.poisson_inside = 0.4;
        layer.stretch = Point(4e-4, 7e-4);  // along x and y: it shears the layer and stretches it
        layer.pore_stress = 2e5;
        layer.mesh = mesh;
        expect_exact(layer);
      }
}

// The traction that the initial stress leaves on the sides of the layer is a load on lines: 0.5 to 3 MPa here.
TEST(InclinedLayer, AnInitialStressThatIsNotAtRestLoadsBothSides) {
  for (const double angle : angles)
    for (const double factor : {1.0, 3.0})
      for (const char* mesh : meshes) {
        InclinedLayer layer{.angle = angle};
        layer.initial = Stress(-3e6, -5e6, 0.4e6);
        layer.initial_inside = Stress(-6e6, -5.5e6, -0.2e6);
        layer.young_inside = factor * layer.young;
        layer.mesh = mesh;
        expect_exact(layer);
      }
}

TEST(InclinedLayer, FiniteElementsAreExactForAllOfThese) {
  for (const double angle : angles)
    for (const double factor : {0.1, 1e4})
      for (const char* order : {"first", "second"})
        for (const char* mesh : meshes) {
          InclinedLayer layer{.angle = angle};
          layer.rock = std::string("poromechanics/fem, order: ") + order;
          layer.young_inside = factor * layer.young;
          layer.poisson_inside = 0.4;
          layer.stretch = Point(4e-4, 7e-4);
          layer.pore_stress = 2e5;
          layer.initial = Stress(-3e6, -5e6, 0.4e6);
          layer.initial_inside = Stress(-6e6, -5.5e6, -0.2e6);
          layer.mesh = mesh;
          expect_exact(layer);
        }
}

// What is at rest stays so: the horizontal stress may jump across a horizontal interface.
TEST(InclinedLayer, AnInitialStressAtRestMovesNothing) {
  InclinedLayer layer{.angle = 0};
  layer.initial = Stress(-3e6, -5e6, 0.4e6);
  layer.initial_inside = Stress(-6e6, -5e6, 0.4e6);
  SceneRun run = layer.run();
  run.run();
  EXPECT_LT(run.field("rock.displacement").lpNorm<Eigen::Infinity>(), 1e-15);
}

}  // namespace
}  // namespace sprekk::testing
