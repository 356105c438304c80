// Closed cracks that slip under a uniform drop of stress, with dilation: the tractions of their walls, the slip and the
// stress-intensity factors against the closed form, at any angle and on any cells around the tips.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/verification/scene_run.hpp"

namespace sprekk::testing {
namespace {

constexpr double normal_stress = -15e6, along = -12e6, shear = 5e6, friction = 0.2;  ///< Pa, in the crack's frame
constexpr double plane_modulus = 40e9 / (1 - 0.2 * 0.2);

/// D_t = (tau - mu N) / (1 + mu tan psi), D_n = D_t tan psi; b = 1 m.
struct ClosedForm {
  double shear_drop, normal_drop;
  explicit ClosedForm(double dilation)
      : shear_drop((shear + friction * normal_stress) / (1 + friction * std::tan(dilation))),
        normal_drop(shear_drop * std::tan(dilation)) {}
  double slip(double x) const { return 4 / plane_modulus * shear_drop * std::sqrt(1 - x * x); }
};

struct Crack {
  std::string mesh;
  double angle = 0, dilation = 0;  ///< degrees
  double half_width = 40;          ///< of the box, m
  Point center = Point::Zero();
  bool has_field = true;  ///< otherwise the rock is anisotropic, a little, and there is no fine level
};

/// The worst over the cells of the crack or over both tips.
struct Errors {
  double traction;  ///< of the normal traction, over the drop of shear stress
  double slip;      ///< L2, relative
  double K_I;       ///< over K_II
  double K_II;      ///< relative
};

Errors errors_of(const Crack& crack) {
  const double c = std::cos(crack.angle * M_PI / 180), s = std::sin(crack.angle * M_PI / 180);
  const double dilation = crack.dilation * M_PI / 180, w = crack.half_width;
  const auto pascal = [](double value) { return fmt::format("{:.17g} Pa", value); };
  const auto point = [](const Point& x) { return fmt::format("[{:.17g} m, {:.17g} m]", x[0], x[1]); };
  const std::string xx = pascal(normal_stress * s * s + along * c * c - 2 * shear * s * c);
  const std::string yy = pascal(normal_stress * c * c + along * s * s + 2 * shear * s * c);
  const double shear_xy = (along - normal_stress) * s * c + shear * (c * c - s * s);
  const std::string xy = pascal(shear_xy), minus_xy = pascal(-shear_xy);
  const Point half(c, s);
  SceneRun run = SceneRun::from_text(fmt::format(
      "{{geometry: {{box: {{x: [{0} m, {1} m], y: [{0} m, {1} m]}}, fractures: {{crack: {{points: [{2}, {3}]}}}}}}, "
      "mesh: {4}, components: {{rock: {{type: poromechanics/mpsa, {11}, "
      "initial_stress: {{xx: {5}, yy: {6}, xy: {7}}}, boundary: {{left: {{displacement_x: 0 m, traction_y: {8}}}, "
      "bottom: {{displacement_y: 0 m, traction_x: {8}}}, right: {{traction: [{5}, {7}]}}, top: {{traction: [{7}, "
      "{6}]}}}}}}, contact: {{type: contact/coulomb, friction: {9}, dilation_angle: {10} deg}}{12}}}, couplers: "
      "[{{type: "
      "wall_traction, between: [rock, contact]}}{13}], schedule: [{{solve: [rock, contact]}}{14}], time: {{end: 1 s, "
      "step: 1 s}}}}",
      -w, w, point(crack.center - half), point(crack.center + half), crack.mesh, xx, yy, xy, minus_xy, friction,
      crack.dilation,
      crack.has_field ? "young_modulus: 40 GPa, poisson_ratio: 0.2"
                      : "stiffness: {xxxx: 44.444444444 GPa, yyyy: 44.444444444 GPa, xxyy: 11.111111111 GPa, xyxy: "
                        "16.666683333 GPa}",
      crack.has_field ? ", tips: {type: fine_fracture/quarter_point, size: 4 m, growth: {increment: 10 mm}}" : "",
      crack.has_field ? ", {type: two_level, between: [rock, tips]}" : "",
      crack.has_field ? ", {grow: tips, settle: [rock, contact]}" : ""));
  Errors errors{0, 0, 0, 0};
  if (!run.step()) return {1, 1, 1, 1};
  const ClosedForm exact(dilation);
  double difference = 0, norm = 0;
  for (int i = 0; i < run.mesh().fracture_cell_count(); ++i) {
    const FractureCell& cell = run.mesh().fracture_cells[i];
    const double traction = run.field("contact.traction")[2 * i] - (normal_stress - exact.normal_drop);
    errors.traction = std::max(errors.traction, std::abs(traction) / exact.shear_drop);
    const double slip = exact.slip((cell.center - crack.center).norm());
    difference += cell.measure * std::pow(std::abs(run.field("contact.jump")[2 * i + 1]) - slip, 2);
    norm += cell.measure * slip * slip;
  }
  errors.slip = std::sqrt(difference / norm);
  if (!crack.has_field) return errors;
  const double K_II = exact.shear_drop * std::sqrt(M_PI), K_I = exact.normal_drop * std::sqrt(M_PI);
  for (const std::string tip : {"tips.crack_first.", "tips.crack_last."}) {
    errors.K_I = std::max(errors.K_I, std::abs(run.quantity(tip + "K_I") - K_I) / K_II);
    errors.K_II = std::max(errors.K_II, std::abs(std::abs(run.quantity(tip + "K_II")) / K_II - 1));
  }
  return errors;
}

/// With a length that no round number perturbs, and cells around that are refined with those on the crack.
std::string triangles(int cells_on_crack) {
  return fmt::format("{{size: 7 m, fracture_size: {:.17g} m, growth: {:.17g}}}", 2.0 / cells_on_crack * (1 + 1e-9),
                     3.0 / cells_on_crack);
}

// The aim: on whatever mesh K_I is within 0.1 % of K_II with 20 cells, and half of that with 40. The largest error of
// the tractions of one mesh is that of its worst cell, some 0.1 h/b to 0.3 h/b by chance: their mean falls, and none is
// far off it.
TEST(ClosedCrack, FollowsTheClosedFormOnMeshesInAnyDirection) {
  std::vector<Errors> mean;
  for (const int cells : {10, 20, 40}) {
    Errors sum{0, 0, 0, 0}, largest{0, 0, 0, 0};
    int meshes = 0;
    for (const double angle : {0, 17, 30, 45})
      for (const Point& center : {Point(0, 0), Point(0.37, -0.21)}) {
        ++meshes;
        const Errors errors = errors_of({triangles(cells), angle, 1, 40, center});
        for (double Errors::*error : {&Errors::traction, &Errors::slip, &Errors::K_I, &Errors::K_II}) {
          sum.*error += errors.*error;
          largest.*error = std::max(largest.*error, errors.*error);
        }
      }
    for (double Errors::*error : {&Errors::traction, &Errors::slip, &Errors::K_I, &Errors::K_II}) sum.*error /= meshes;
    mean.push_back(sum);
    const double h = 20.0 / cells;
    EXPECT_LT(largest.traction, 1.2e-2 * h * std::max(h, 1.0)) << cells;
    EXPECT_LT(largest.slip, 3e-3 * h * h) << cells;
    EXPECT_LT(largest.K_I, 1e-3 * std::pow(h, 1.5)) << cells;
    EXPECT_LT(largest.K_II, 2e-3 * h * h) << cells;
  }
  for (const int finer : {1, 2}) {
    EXPECT_LT(mean[finer].traction, 0.52 * mean[finer - 1].traction) << finer;
    EXPECT_LT(mean[finer].K_I, 0.5 * mean[finer - 1].K_I) << finer;
  }
}

// The note of `sprekk check` on tips in rock that is anisotropic, here by a millionth.
TEST(ClosedCrack, WithoutFieldsAtItsTipsSlipsByAsMuchTooFarAsTheNoteSays) {
  const auto slip = [](int cells) {
    Crack crack{triangles(cells), 30, 0};
    crack.has_field = false;
    return errors_of(crack).slip;
  };
  EXPECT_NEAR(slip(10), 0.11, 0.02);
  EXPECT_NEAR(slip(20), 0.065, 0.007);
  EXPECT_NEAR(slip(40), 0.027, 0.004);
}

// Rectangles, and triangles of which four or eight meet at a tip, which one more or one fewer cell decides: the
// correction is there on all of them.
TEST(ClosedCrackOnStructuredCells, IsAsGoodAsOnOthers) {
  for (const char* shape : {"quadrilaterals", "triangles"})
    for (const int shift : {0, 1}) {
      const auto errors = [&](int cells, double dilation) {
        const std::string mesh = fmt::format("{{kind: structured, cells: [{0}, {0}], shape: {1}}}", 6 * cells, shape);
        return errors_of({mesh, 0, dilation, 6, Point(shift * 2.0 / cells, 0)});
      };
      const Errors ten = errors(10, 5), twenty = errors(20, 5);
      // 0.4 % of the drop is what the box, 6 times as wide as the crack, changes.
      EXPECT_LT(ten.slip, 1.5e-2) << shape << shift;
      EXPECT_LT(twenty.slip, 0.75e-2) << shape << shift;
      EXPECT_LT(ten.K_I, 1e-3) << shape << shift;
      EXPECT_LT(twenty.K_I, 1e-3) << shape << shift;
      EXPECT_LT(twenty.traction, 1e-2) << shape << shift;
    }
}

}  // namespace
}  // namespace sprekk::testing
