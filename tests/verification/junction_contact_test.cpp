// Walls and contact where fractures cross and touch.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "tests/verification/scene_run.hpp"

namespace sprekk::testing {
namespace {

/// A square whose sides follow a displacement; lambda = G = 1.
std::string block(const std::string& fractures, const std::string& mesh, const std::string& x, const std::string& y,
                  const std::string& friction) {
  const std::string u = "{displacement: [\"" + x + "\", \"" + y + "\"]}";
  return "{geometry: {box: {x: [-1, 1], y: [-1, 1]}, fractures: " + fractures + "}, mesh: " + mesh +
         ", components: {rock: {type: poromechanics/mpsa, young_modulus: 2.5 Pa, poisson_ratio: 0.25, boundary: "
         "{left: " +
         u + ", right: " + u + ", bottom: " + u + ", top: " + u +
         "}}, contact: {type: contact/coulomb, friction: " + friction +
         "}}, couplers: [{type: wall_traction, between: [rock, contact]}], schedule: [{solve: [rock, contact]}], time: "
         "{end: 1 s, step: 1 s}}";
}

/// A cross of 20 degrees, a T on it, and three that begin at one point.
const std::string many =
    "{a: {points: [[-1, 0.1], [0.8, 0.1]]}, b: {points: [[-0.9, -0.2], [0.9, 0.455]]}, c: {points: [[0.5, 0.1], [0.6, "
    "-0.9]]}, d: {points: [[0.3, -0.5], [0, -0.7]]}, e: {points: [[0.3, -0.5], [-0.2, -0.4]]}, f: {points: [[0.3, "
    "-0.5], "
    "[0.4, -0.1]]}}";
/// On lines of a grid of squares.
const std::string right =
    "{a: {points: [[-1, 0], [0.5, 0]]}, b: {points: [[0, -0.5], [0, 1]]}, c: {points: [[0.5, 0.5], [0, 0.5]]}, d: "
    "{points: "
    "[[0.5, 0.5], [0.5, 0.75]]}}";

/// A triangle of one cell between three fractures.
const std::string pocket =
    "{a: {points: [[-0.8, 0], [0.9, 0]]}, b: {points: [[-0.5, -0.5], [0.6, 0.6]]}, c: {points: [[0.1, -0.7], [0.1, "
    "0.8]]}}";

const std::string around =
    "{a: {points: [[-0.5, 0], [0.75, 0]]}, b: {points: [[-0.5, 0.25], [0.75, 0.25]]}, c: {points: [[0, -0.5], [0, "
    "0.75]]}, d: "
    "{points: [[0.25, -0.5], [0.25, 0.75]]}}";

struct Case {
  const char* name;
  std::string fractures, mesh;
  std::size_t junctions;
};

class Holding : public ::testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(
    Meshes, Holding,
    ::testing::Values(Case{"triangles", many, "{size: 0.15}", 3},
                      Case{"quadrilaterals", many, "{size: 0.15, shape: quadrilaterals}", 3},
                      Case{"pocket", pocket, "{size: 0.15}", 3},
                      Case{"square", around, "{kind: structured, shape: quadrilaterals, cells: [8, 8]}", 4},
                      Case{"squares", right, "{kind: structured, shape: quadrilaterals, cells: [8, 8]}", 3},
                      Case{"diagonals", right, "{kind: structured, cells: [8, 8]}", 3},
                      Case{"distorted", right, "{kind: structured, cells: [8, 8], distortion: 0.3}", 3}),
    [](const auto& info) { return std::string(info.param.name); });

TEST_P(Holding, StaysAsItIsUnderFriction) {
  // Uniaxial compression along y: eps = (sigma - nu tr(sigma) I)/(2 G) in plane strain.
  Tensor stress;
  stress << 0, 0, 0, -0.02;
  const Tensor eps = 0.5 * (stress - 0.25 * stress.trace() * Tensor::Identity());
  SceneRun run = SceneRun::from_text(block(GetParam().fractures, GetParam().mesh, fmt::format("{:.17g}*x", eps(0, 0)),
                                           fmt::format("{:.17g}*y", eps(1, 1)), "1e6"));
  ASSERT_EQ(run.mesh().junctions.size(), GetParam().junctions);
  ASSERT_TRUE(run.step());
  EXPECT_LE(run.iterations(), 6);
  for (int i = 0; i < run.mesh().fracture_cell_count(); ++i) {
    const FractureCell& cell = run.mesh().fracture_cells[i];
    const Point traction = stress * cell.normal;
    EXPECT_NEAR(run.field("contact.traction")[2 * i], traction.dot(cell.normal), 1e-12) << cell.center.transpose();
    EXPECT_NEAR(run.field("contact.traction")[2 * i + 1], traction.dot(cell.tangents), 1e-12)
        << cell.center.transpose();
    for (int k = 0; k < 2; ++k) EXPECT_NEAR(run.field("contact.jump")[2 * i + k], 0, 1e-12) << cell.center.transpose();
  }
}

TEST(JunctionWalls, PartFourBlocksThatMoveAway) {
  // Each sector moves as it likes; no wall has a traction.
  const std::string cross = "{a: {points: [[-1, 0], [1, 0]]}, b: {points: [[-0.4, -1], [0.4, 1]]}}";
  const std::string x = "if(x > 0.4*y, 2e-3, -1e-3)", y = "if(y > 0, 3e-3, 0) + if(x > 0.4*y, 2e-4, 0)";
  for (const char* mesh : {"{size: 0.2}", "{size: 0.2, shape: quadrilaterals}"}) {
    SceneRun run = SceneRun::from_text(block(cross, mesh, x, y, "0.5"));
    ASSERT_TRUE(run.step());
    for (int i = 0; i < run.mesh().fracture_cell_count(); ++i) {
      const FractureCell& cell = run.mesh().fracture_cells[i];
      // The minus wall's less the plus wall's; the plus side lies to the left.
      const Point jump = cell.fracture == 0 ? Point(0, -3e-3) : Point(3e-3, 2e-4);
      EXPECT_NEAR(run.field("contact.jump")[2 * i], jump.dot(cell.normal), 1e-12) << mesh;
      EXPECT_NEAR(run.field("contact.jump")[2 * i + 1], jump.dot(cell.tangents), 1e-12) << mesh;
      for (int k = 0; k < 2; ++k) EXPECT_NEAR(run.field("contact.traction")[2 * i + k], 0, 1e-12) << mesh;
    }
  }
}

TEST(JunctionWalls, SlideOnAFractureThatOthersTouch) {
  // The upper half slides on a, where the uniform traction just reaches the friction bound; b and c, which end on a
  // from both sides at one point, stick.
  const std::string lines =
      "{a: {points: [[-1, 0], [1, 0]]}, b: {points: [[0.1, 0], [0.3, 0.9]]}, c: {points: [[0.1, 0], [0.2, -0.8]]}}";
  const double slip =
      1e-3;  // of the minus wall, below, against the plus wall, along +x: the upper half goes to the left
  Tensor strain;
  strain << -0.01, -0.003, -0.003, -0.02;
  const Tensor stress = 2 * strain + strain.trace() * Tensor::Identity();
  const double friction = std::abs(stress(0, 1) / stress(1, 1));
  SceneRun run =
      SceneRun::from_text(block(lines, "{size: 0.15}", fmt::format("-0.01*x - 0.003*y - if(y > 0, {}, 0)", slip),
                                "-0.003*x - 0.02*y", fmt::format("\"if(abs(y) < 1e-6, {:.17g}, 1e6)\"", friction)));
  ASSERT_TRUE(run.step());
  EXPECT_LE(run.iterations(), 8);
  for (int i = 0; i < run.mesh().fracture_cell_count(); ++i) {
    const FractureCell& cell = run.mesh().fracture_cells[i];
    const Point traction = stress * cell.normal;
    EXPECT_NEAR(run.field("contact.jump")[2 * i], 0, 1e-12) << cell.center.transpose();
    EXPECT_NEAR(run.field("contact.jump")[2 * i + 1], cell.fracture == 0 ? slip : 0, 1e-12) << cell.center.transpose();
    EXPECT_NEAR(run.field("contact.traction")[2 * i], traction.dot(cell.normal), 1e-12) << cell.center.transpose();
    EXPECT_NEAR(run.field("contact.traction")[2 * i + 1], traction.dot(cell.tangents), 1e-12)
        << cell.center.transpose();
  }
}

/// Two equal cracks that cross at right angles in their middles under a pressure p, of half-length 1: dislocations
/// f = g/sqrt(1 − t^2) along both (of the opening w = −int f) have no traction but p on the walls,
///   int f(t) [1/(x − t) + t (x^2 − t^2)/(x^2 + t^2)^2] dt = −4 pi p/E',
/// by the stress of an edge dislocation beside its plane. With Chebyshev points: Erdogan and Gupta, Quart. Appl. Math.
/// 29 (1972) 525.
class Cross {
 public:
  explicit Cross(int count) : coefficients_(count) {
    Eigen::MatrixXd rows(count, count);
    Vector right = Vector::Constant(count, -4 * M_PI);
    const auto t = [&](int k) { return std::cos((2 * k + 1) * M_PI / (2 * count)); };
    for (int k = 0; k < count; ++k) {
      for (int r = 1; r < count; ++r) {
        const double x = std::cos(r * M_PI / count), square = x * x + t(k) * t(k);
        rows(r - 1, k) = M_PI / count * (1 / (x - t(k)) + t(k) * (x * x - t(k) * t(k)) / (square * square));
      }
      rows(count - 1, k) = 1;
    }
    right[count - 1] = 0;
    const Vector g = rows.partialPivLu().solve(right);
    for (int j = 0; j < count; ++j) {
      double sum = 0;
      for (int k = 0; k < count; ++k) sum += g[k] * std::cos(j * (2 * k + 1) * M_PI / (2 * count));
      coefficients_[j] = (j == 0 ? 1.0 : 2.0) / count * sum;
    }
  }
  /// K_I over p sqrt(pi): a single crack has g(1) = 4 p/E'.
  double factor() const { return coefficients_.sum() / 4; }
  /// E'/p times the opening at a distance from the middle.
  double opening(double distance) const {
    double sum = 0;
    const double angle = std::acos(std::min(1.0, distance));
    for (int j = 1; j < coefficients_.size(); ++j) sum += coefficients_[j] * std::sin(j * angle) / j;
    return sum;
  }
  /// E'/p times the volume of one of the cracks.
  double volume() const { return M_PI * coefficients_[1] / 2; }

 private:
  Vector coefficients_;
};

TEST(PressurizedCross, OpensLikeTheIntegralEquation) {
  const Cross exact(160);
  EXPECT_NEAR(exact.factor(), 0.864, 5e-4);  // Rooke and Sneddon 1969; Tada, Paris and Irwin
  // The energy 2 p V/2 of both grows by 4 K_I^2/E' per half-length, with V ~ b^2.
  EXPECT_NEAR(exact.volume() / (2 * M_PI), exact.factor() * exact.factor(), 1e-5);
  const double scale = 1e6 / (10e9 / (1 - 0.04));
  double previous = 0;
  for (const double size : {0.1, 0.05}) {
    SceneRun run("verification/pressurized_cross.yaml",
                 {{"mesh", fmt::format("{{size: 32 m, fracture_size: {}, growth: {}}}", size, 2 * size)}});
    ASSERT_TRUE(run.step());
    EXPECT_LE(run.iterations(), 3);
    double error = 0, norm = 0, volume = 0, near = 0;
    for (int i = 0; i < run.mesh().fracture_cell_count(); ++i) {
      const FractureCell& cell = run.mesh().fracture_cells[i];
      const double opening = run.field("contact.jump")[2 * i], slip = run.field("contact.jump")[2 * i + 1];
      const double wanted = scale * exact.opening(cell.center.norm());
      error += cell.measure * (std::pow(opening - wanted, 2) + slip * slip);
      norm += cell.measure * wanted * wanted;
      volume += cell.measure * opening;
      if (cell.center.norm() < 2 * size) near = std::max(near, std::abs(opening / wanted - 1));
    }
    error = std::sqrt(error / norm);
    if (previous > 0) {
      EXPECT_LT(error, 0.002);
      EXPECT_LT(near, 0.002);  // no worse where they cross
      EXPECT_NEAR(volume / (2 * scale * exact.volume()), 1, 0.004);
      EXPECT_GT(std::log2(previous / error), 1.7) << previous << " " << error;
    }
    previous = error;
  }
}

/// Volumes of both fractures of a T of unequal arms under given pressures.
Point volumes(double size, double first, double second) {
  SceneRun run(
      "verification/pressurized_cross.yaml",
      {{"geometry.fractures", "{along: {points: [[-1, 0], [1, 0]]}, across: {points: [[0.3, 0], [0.8, 1.2]]}}"},
       {"mesh", fmt::format("{{size: 32 m, fracture_size: {}, growth: {}}}", size, 2 * size)},
       {"components.conduit.prescribed.everywhere", fmt::format("{{fracture: along, pressure: {} Pa}}", first)},
       {"components.conduit.prescribed.other", fmt::format("{{fracture: across, pressure: {} Pa}}", second)}});
  run.run();
  Point volume = Point::Zero();
  for (int i = 0; i < run.mesh().fracture_cell_count(); ++i) {
    EXPECT_GT(run.field("contact.jump")[2 * i], 0);
    volume[run.mesh().fracture_cells[i].fracture] +=
        run.mesh().fracture_cells[i].measure * run.field("contact.jump")[2 * i];
  }
  return volume;
}

TEST(PressurizedTee, IsReciprocal) {
  // Betti: what the pressure in one opens the other by is the same both ways. The method is not symmetric, so it holds
  // to the error, of second order.
  double previous = 0;
  for (const double size : {0.1, 0.05}) {
    const Point both = volumes(size, 1e6, 1e6);
    const double of_second = volumes(size, 1.2e6, 1e6)[1] - both[1], of_first = volumes(size, 1e6, 1.2e6)[0] - both[0];
    const double error = std::abs(of_second / of_first - 1);
    if (previous > 0) {
      EXPECT_LT(error, 0.004);
      EXPECT_GT(std::log2(previous / error), 1.5) << previous << " " << error;
    }
    previous = error;
  }
}

TEST(CoupledJunctions, KeepTheirFluidAndConverge) {
  // The scene of section 5.1 of the paper with fractures that cross and touch the one that fluid is injected into.
  for (const char* shape : {"triangles", "quadrilaterals"}) {
    SceneRun run("paper/onset_coarse.yaml",
                 {{"geometry.fractures.crossing", "{points: [[0.96, 1.01], [1.03, 1.01]]}"},
                  {"geometry.fractures.touching", "{points: [[0.99, 0.99], [1.02, 0.97]]}"},
                  {"mesh", std::string("{size: 0.2, fracture_size: 0.01, growth: 0.3, shape: ") + shape + "}"}});
    ASSERT_EQ(run.mesh().junctions.size(), 2u);
    int most = 0, all = 0;
    bool has_slipped[3] = {};
    run.run_until(run.model().scene().time.end, [&] {
      most = std::max(most, run.iterations());
      all += run.iterations();
      for (int i = 0; i < run.mesh().fracture_cell_count(); ++i)
        if (std::abs(run.field("contact.jump")[2 * i + 1]) > 1e-6)
          has_slipped[run.mesh().fracture_cells[i].fracture] = true;
      EXPECT_LE(std::abs(run.quantity("fluid_balance_error")), 1e-9 * (1e-7 + run.quantity("fluid_injected")));
    });
    EXPECT_EQ(run.steps(), 30) << shape;
    EXPECT_NEAR(run.quantity("fluid_injected"), 15 * 3600 * 5e-9, 1e-15);
    EXPECT_TRUE(has_slipped[0] && has_slipped[1]);
    EXPECT_LE(most, 6) << shape;
    EXPECT_LE(all, 3 * run.steps()) << shape;
  }
}

}  // namespace
}  // namespace sprekk::testing
