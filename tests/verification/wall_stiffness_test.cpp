// The stiffness of walls, a scale that contact takes from the rock: positive on any mesh, that of a cell of elastic
// rock, and nothing that the answer depends on.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "components/capabilities/poroelastic_rock.hpp"
#include "components/contact/frictional_contact.hpp"
#include "components/contact/options.hpp"
#include "framework/scene/registry.hpp"
#include "tests/verification/scene_run.hpp"

namespace sprekk::testing {
namespace {

struct ScaledOptions : contact::Options {
  double factor = 1;
  Spec spec() {
    Spec spec = contact::Options::spec("contact/scaled", "Contact with scaled stiffness.");
    spec.quantity("factor", factor, {.doc = "Of the stiffness of walls."});
    return spec;
  }
};

/// Contact with the stiffness of walls times a factor. It keeps the stiffness that it was given.
class ScaledContact : public contact::FrictionalContact {
 public:
  ScaledContact(const ComponentContext& context, const ScaledOptions& options)
      : FrictionalContact(context, options), factor_(options.factor) {}
  void set_wall_stiffness(const Vector& stiffness) override {
    given = stiffness;
    FrictionalContact::set_wall_stiffness(factor_ * stiffness);
  }
  Vector given;  ///< Pa/m, (normal, tangential) of each cell

 private:
  double factor_;
};

const RegisterComponent<ScaledContact, ScaledOptions> registration("test/scaled_contact");

template <class Capability>
Capability& part(SceneRun& run) {
  for (const auto& component : run.model().components())
    if (auto* found = dynamic_cast<Capability*>(component.get())) return *found;
  throw std::logic_error("no such component");
}

struct Scene {
  double young = 1e9;  ///< Pa
  double poisson = 0.25;
  double distortion = 0;
  double size = 0.25;                          ///< of cells, m; all lengths are in proportion
  double gap = 0.1;                            ///< between the two fractures, sizes
  double angle = 0;                            ///< rad
  double factor = 1;                           ///< of the stiffness
  double compression = -0.5e6, shear = 0.9e6;  ///< Pa, along the axes of the box
  std::string fractures = "both";

  /// A long fracture with two bends, which opens, slips and sticks, and a second one along its middle.
  SceneRun run() const {
    const auto at = [&](double x, double y) {
      const double c = std::cos(angle), s = std::sin(angle);
      return fmt::format("[{:.17g} m, {:.17g} m]", size * (c * x - s * y), size * (s * x + c * y));
    };
    std::string fractures = fmt::format("a: {{points: [{}, {}, {}, {}]}}", at(-6, 2), at(-3, 0), at(3, 0), at(6, 2));
    if (this->fractures == "both") fractures += fmt::format(", b: {{points: [{}, {}]}}", at(-2, gap), at(1.5, gap));
    return SceneRun::from_text(fmt::format(
        "{{geometry: {{box: {{x: [{0:.17g} m, {1:.17g} m], y: [{0:.17g} m, {1:.17g} m]}}, fractures: {{{2}}}}}, mesh: "
        "{{size: {3:.17g} m, gap_edges: 0, distortion: {10:.17g}}}, components: {{rock: {{type: poromechanics/mpsa, "
        "young_modulus: {4:.17g} Pa, "
        "poisson_ratio: {11:.17g}, boundary: {{left: {{displacement: [0 m, 0 m]}}, right: {{traction: [{5:.17g} Pa, "
        "{6:.17g} Pa]}}, bottom: {{traction: [{7:.17g} Pa, {8:.17g} Pa]}}, top: {{traction: [{6:.17g} Pa, {5:.17g} "
        "Pa]}}}}}}, contact: {{type: test/scaled_contact, friction: 0.3, factor: {9:.17g}}}}}, couplers: [{{type: "
        "wall_traction, between: [rock, contact]}}], schedule: [{{solve: [rock, contact]}}], time: {{end: 1 s, step: 1 "
        "s}}}}",
        -15 * size, 15 * size, fractures, size, young, compression, shear, -shear, -compression, factor, distortion,
        poisson));
  }
};

/// How the traction of a cell closes its own jump while the cells of the rock keep their place, m/Pa.
Vector compliance_in(SceneRun& run) {
  const RockWalls& walls = part<RockWalls>(run);
  for (const LinearExpression::Term& term : walls.displacement_jump().terms)
    if (term.field->spec().name == "wall_traction") return -term.matrix.entries().diagonal();
  throw std::logic_error("no jump by tractions");
}

const double gaps[] = {0.3, 0.05, 0.02, 0.005};

TEST(WallStiffness, IsPositiveWhereAWallMovesAgainstItsTraction) {
  int against = 0;
  for (const double gap : gaps)
    for (const double poisson : {0.0, 0.49}) {
      SceneRun run = Scene{.poisson = poisson, .distortion = 0.3, .gap = gap, .angle = 0.4}.run();
      run.step();
      const Vector compliance = compliance_in(run), stiffness = part<ScaledContact>(run).given;
      ASSERT_EQ(stiffness.size(), compliance.size());
      for (int i = 0; i < stiffness.size(); ++i) {
        against += compliance[i] <= 0;
        ASSERT_TRUE(std::isfinite(stiffness[i]));
        EXPECT_GT(stiffness[i], 0);
      }
    }
  EXPECT_GT(against, 0) << "no mesh is rough enough for the test";
}

// The walls of a cell of length L in rock of modulus E' = E / (1 - nu^2) part by about 1 / E' of L for each Pa.
TEST(WallStiffness, IsThatOfACellOfElasticRock) {
  Scene soft{.fractures = "one"};
  SceneRun run = soft.run();
  run.run();
  const Vector stiffness = part<ScaledContact>(run).given;
  const double modulus = soft.young / (1 - 0.25 * 0.25);
  for (int i = 0; i < stiffness.size(); ++i) {
    const double per_modulus = stiffness[i] * run.mesh().fracture_cells[i / 2].measure / modulus;
    EXPECT_GT(per_modulus, 0.3);
    EXPECT_LT(per_modulus, 10);
  }
  Scene other = soft;
  other.young *= 10;
  SceneRun stiff = other.run();
  stiff.run();
  EXPECT_LT((part<ScaledContact>(stiff).given - 10 * stiffness).norm(), 1e-9 * 10 * stiffness.norm());
  other = soft;
  other.size *= 4;
  SceneRun large = other.run();
  large.run();
  const Vector coarse = part<ScaledContact>(large).given;
  ASSERT_EQ(coarse.size(), stiffness.size());
  EXPECT_LT((coarse - 0.25 * stiffness).norm(), 1e-6 * stiffness.norm());
}

// Eqs. 2 and 3 of the paper hold for one positive stiffness if they hold for another.
TEST(WallStiffness, DoesNotChangeTheAnswer) {
  for (const double gap : {1.0, 0.1, 0.02}) {
    std::array<int, 3> states{};
    Vector traction, jump;
    for (const double factor : {1.0, 1e-2, 1e2}) {
      SceneRun run = Scene{.gap = gap, .factor = factor}.run();
      run.run();
      const Vector f = run.field("contact.traction"), u = run.field("contact.jump");
      const double stress = f.lpNorm<Eigen::Infinity>(), move = u.lpNorm<Eigen::Infinity>();
      for (int i = 0; i < run.mesh().fracture_cell_count(); ++i) {
        ++states[static_cast<int>(part<ScaledContact>(run).state(i))];
        EXPECT_LE(f[2 * i], 1e-9 * stress);
        EXPECT_GE(u[2 * i], -1e-9 * move);
        EXPECT_LE(std::abs(f[2 * i] * u[2 * i]), 1e-9 * stress * move);
        EXPECT_LE(std::abs(f[2 * i + 1]), -0.3 * f[2 * i] + 1e-9 * stress);
      }
      if (factor == 1) {
        traction = f;
        jump = u;
      }
      EXPECT_LT((f - traction).lpNorm<Eigen::Infinity>(), 1e-7 * stress) << factor;
      EXPECT_LT((u - jump).lpNorm<Eigen::Infinity>(), 1e-7 * move) << factor;
    }
    for (const int count : states) EXPECT_GT(count, 0) << gap;
  }
}

}  // namespace
}  // namespace sprekk::testing
