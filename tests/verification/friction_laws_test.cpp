// Laws of friction and of closure that are registered as those of plug-ins: each has the answer and the iterations of
// the same law as a formula.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "components/contact/laws/closure.hpp"
#include "components/contact/laws/friction.hpp"
#include "tests/verification/contact_patch.hpp"
#include "tests/verification/scene_run.hpp"

namespace sprekk::testing {
namespace {

using namespace contact;

/// friction (1 − s/(1 m)) − q/(10 m) + 0.01 asinh(V/(2 mm/s)) + c N/(1 Pa).
struct OfAllVariables : FrictionLaw {
  double by_pressure;
  explicit OfAllVariables(double by_pressure) : by_pressure(by_pressure) {}
  OfWalls at(double friction, const WallState& state) const override {
    const auto [slip, path, rate, pressure] = state;
    constexpr double a = 0.01, reference = 2e-3;
    return {friction * (1 - slip) - path / 10 + a * std::asinh(rate / reference) + by_pressure * pressure,
            {-friction, -0.1, a / std::hypot(rate, reference), by_pressure}};
  }
  bool depends_on(WallVariable) const override { return true; }
};

struct FrictionParameters {
  double by_pressure = 0;
  Spec spec() {
    Spec spec("of_all_variables", "for a test");
    spec.quantity("by_pressure", by_pressure, {.unit = "1/Pa", .doc = "c.", .required = true});
    return spec;
  }
  std::unique_ptr<FrictionLaw> build(const NoInput&) const { return std::make_unique<OfAllVariables>(by_pressure); }
};

/// length p/(pressure + p).
struct Bounded : Closure {
  double length, pressure;
  Bounded(double length, double pressure) : length(length), pressure(pressure) {}
  Value at(double p) const override {
    const double sum = pressure + std::max(0.0, p);
    return {length * p / sum, length * (p < 0 ? 1 / sum : pressure / (sum * sum))};
  }
};

struct ClosureParameters {
  double length = 0, pressure = 0;
  Spec spec() {
    Spec spec("bounded", "for a test");
    spec.quantity("length", length, {.unit = "m", .doc = "Largest closure.", .required = true});
    spec.quantity("pressure", pressure, {.unit = "Pa", .doc = "At half of it.", .required = true});
    return spec;
  }
  std::unique_ptr<Closure> build(const NoInput&) const { return std::make_unique<Bounded>(length, pressure); }
};

const RegisterLaw<FrictionParameters, FrictionLaw, NoInput> friction(friction_laws(), "of_all_variables");
const RegisterLaw<ClosureParameters, Closure, NoInput> closure(closure_laws(), "bounded");

constexpr const char *law =
                         "friction: 0.5, friction_law: {type: of_all_variables, of_all_variables: {by_pressure: -2 "
                         "1/Pa}}",
                     *formula =
                         "friction: \"0.5*(1 - slip/(1 m)) - path/(10 m) + 0.01*asinh(slip_rate/(2 mm/s)) - "
                         "2*sigma_n/(1 Pa)\"";

/// A strain in which the inclined fracture has this traction (normal, tangential) on its plus wall, and no stress along
/// it (lambda = G = 1).
Tensor strain_of(const Point& traction) {
  const Point n(0.5, -std::sqrt(3) / 2), t(std::sqrt(3) / 2, 0.5);
  const Tensor stress = traction[0] * n * n.transpose() + traction[1] * (n * t.transpose() + t * n.transpose());
  return 0.5 * (stress - 0.25 * stress.trace() * Tensor::Identity());
}

/// How a patch is computed.
struct Way {
  std::string type = "coulomb", shape = "triangles", step = "1 s", more = {};
};

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  return text.replace(text.find(what), what.size(), by);
}

/// The patch with these laws, whose sides follow the strain of a traction and a jump.
std::string scene(const std::string& laws, const Point& traction, const Point& jump, const Way& way = {}) {
  std::string text = patch_scene(fmt::format("{:.17g}", jump[0]), fmt::format("{:.17g}", jump[1]), 7, "8 rad",
                                 strain_of(traction), way.shape, "", way.type);
  text = replaced(text, "friction: 7, dilation_angle: 8 rad", laws);
  return replaced(text, "step: 1 s}", "step: " + way.step + "}" + way.more);
}

void expect_same(const std::string& text, const std::string& twin) {
  SceneRun run = SceneRun::from_text(text), known = SceneRun::from_text(twin);
  ASSERT_TRUE(run.step() && known.step()) << text;
  EXPECT_EQ(run.iterations(), known.iterations()) << text;
  for (const char* field : {"contact.traction", "contact.jump", "rock.displacement"})
    EXPECT_LE((run.field(field) - known.field(field)).lpNorm<Eigen::Infinity>(),
              1e-11 * known.field(field).lpNorm<Eigen::Infinity>())
        << field << " " << text;
}

/// Of the shear, and a disturbed one.
std::vector<double> signs(const Way& way) {
  std::vector<double> signs = {1, -1};
  if (way.type == "coulomb" && way.shape == "triangles") signs.push_back(1 + 1e-9);
  return signs;
}

const std::vector<Way> ways = {{},
                               {.type = "augmented_lagrangian"},
                               {.type = "penalty"},
                               {.shape = "quadrilaterals"},
                               {.step = "1 s, scheme: sdirk2"},
                               {.step = "0.5 s"},
                               {.more = ", solver: {condense: false}"}};

TEST(RegisteredFriction, IsThatOfTheSameFormula) {
  for (const Way& way : ways)
    for (const double sign : signs(way))
      for (const std::string more :
           {"", ", dilation_angle: 0.1 rad", ", cohesion: 1 mPa, weakening: {distance: 8 mm}",
            ", cohesion: \"1 mPa*exp(-slip/(5 mm))\"", ", closure: {law: linear, stiffness: 8 Pa/m}"})
        for (const Point& jump :
             {Point(0, 4e-3), Point(5e-4, 1e-3), Point(5e-2, 4e-3)}) {  // the last one parts the walls
          const Point traction(-0.02, sign * 0.013), turned(jump[0], sign * jump[1]);
          expect_same(scene(law + more, traction, turned, way), scene(formula + more, traction, turned, way));
        }
}

/// A uniform strain and a jump that fulfil the law in a step of 1 s.
TEST(RegisteredFriction, HoldsWhatItsLawSays) {
  constexpr double slip = 3e-3, pressure = 0.02;
  const double held = 0.5 * (1 - slip) - slip / 10 + 0.01 * std::asinh(slip / 2e-3) - 2 * pressure;
  for (const double sign : {1.0, -1.0})
    for (const double factor : {1.0, 1 + 1e-9}) {
      SceneRun run = SceneRun::from_text(scene(law, {-pressure, sign * held * pressure}, {0, sign * factor * slip}));
      ASSERT_TRUE(run.step());
      EXPECT_LE(run.iterations(), 8);
      for (int i = 0; i < run.mesh().fracture_cell_count(); ++i) {
        EXPECT_NEAR(run.field("contact.traction")[2 * i], -pressure, 3e-9 * pressure);
        EXPECT_NEAR(run.field("contact.traction")[2 * i + 1], sign * held * pressure, 3e-9 * pressure);
        EXPECT_NEAR(run.field("contact.jump")[2 * i + 1], sign * slip, 3e-9 * slip);
      }
    }
}

TEST(RegisteredClosure, IsThatOfTheSameFormula) {
  for (const Way& way : ways)
    for (const double sign : signs(way))
      for (const Point& jump : {Point(0, 4e-3), Point(-1e-3, 1e-3), Point(5e-2, 4e-3)}) {
        const Point traction(-0.02, sign * 0.013), turned(jump[0], sign * jump[1]);
        expect_same(scene("friction: 0.5, closure: {law: bounded, bounded: {length: 2 mm, pressure: 10 mPa}}", traction,
                          turned, way),
                    scene("friction: 0.5, closure: {law: formula, closure: \"2 mm*sigma_n/(10 mPa + sigma_n)\"}",
                          traction, turned, way));
      }
}

TEST(RegisteredFriction, IsRefusedWhereItHasNoMeaning) {
  const auto refused = [](const std::string& laws) {
    try {
      SceneRun run = SceneRun::from_text(scene(laws, {-0.02, 0.013}, {0, 4e-3}));
      run.step();
    } catch (const std::exception& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const std::string rate_and_state =
      ", rate_and_state: {a: 0.01, b: 0.005, distance: 1 mm, reference_rate: 1 um/s, initial_slip_rate: 1 um/s}";
  const std::string raised = "friction: 0.5, friction_law: {type: of_all_variables, of_all_variables: {by_pressure: ";
  for (const auto& [laws, message] : std::vector<std::pair<std::string, std::string>>{
           {"friction: 0.5, friction_law: {type: of_all_variable}", "of_all_variables"},
           {"friction: 0.5, friction_law: {type: of_all_variables}", "'of_all_variables' is missing"},
           {"friction: 0.5, friction_law: {of_all_variables: {by_pressure: 0 1/Pa}}", "has no effect"},
           {raised + "1 Pa}}", "1/Pa"},
           {raised + "-1e6 1/Pa}}", "the law of friction 'of_all_variables' gives -"},
           {law + rate_and_state, "the law of friction is given twice"},
           {law + std::string(", weakening: {distance: 1 mm, friction: 0.1}"), "the law of friction is given twice"},
           {formula + std::string(law).substr(13), "is a formula, and changes by itself"}})
    EXPECT_THAT(refused(laws), ::testing::HasSubstr(message)) << laws;
}

TEST(RegisteredLaws, DoNotTakeTheNamesOfOthers) {
  for (const std::string name : {"constant", "of_all_variables"})
    EXPECT_ANY_THROW((RegisterLaw<FrictionParameters, FrictionLaw, NoInput>(friction_laws(), name)));
  EXPECT_EQ(friction_laws().types().size(), 1);
}

}  // namespace
}  // namespace sprekk::testing
