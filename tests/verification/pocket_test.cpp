// Blocks of rock between fractures, which nothing but these holds, and networks: the condensed system answers like the
// whole one, and each pattern is ordered once.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/verification/scene_run.hpp"

namespace sprekk::testing {
namespace {

std::string line(double angle, double x0, double y0, double x1, double y1) {
  const double c = std::cos(angle), s = std::sin(angle);
  const auto turned = [&](double x, double y) {
    return fmt::format("[{:.12g} m, {:.12g} m]", 50 + c * x - s * y, 50 + s * x + c * y);
  };
  return "{points: [" + turned(x0, y0) + ", " + turned(x1, y1) + "]}";
}

/// A triangle of fractures about (x, y) that cross at its corners, as fractures NAMEa, NAMEb, NAMEc.
std::string triangle(const std::string& name, double angle, double x, double y) {
  return name + "a: " + line(angle, x - 14, y - 8, x + 14, y - 8) + ", " + name +
         "b: " + line(angle, x - 12, y - 12, x + 3, y + 12) + ", " + name +
         "c: " + line(angle, x + 12, y - 12, x - 3, y + 12);
}

struct Case {
  const char* name;
  std::string fractures;
};

/// Fluid is injected into fracture `a`, in rock that Biot's equations govern.
std::string stimulated(const std::string& fractures, bool condense) {
  return "{geometry: {box: {x: [0 m, 100 m], y: [0 m, 100 m]}, fractures: {" + fractures +
         "}}, mesh: {size: 14 m, fracture_size: 3 m}, materials: {young_modulus: 40 GPa, poisson_ratio: 0.25, "
         "biot_coefficient: 0.8, porosity: 0.01, fluid_compressibility: 4.5e-10 1/Pa, permeability: 1e-18 m^2, "
         "viscosity: 0.3 mPa*s, friction: 0.25, dilation_angle: 3 deg}, components: {pore: {type: matrix_flow/mpfa, "
         "initial_pressure: 30 MPa, boundary: {left: {pressure: 30 MPa}, right: {pressure: 30 MPa}}}, rock: {type: "
         "poromechanics/mpsa, initial_stress: {xx: -75 MPa, yy: -50 MPa, xy: 0}, boundary: {left: {displacement_x: 0 "
         "m}, bottom: {displacement_y: 0 m}, right: {normal_stress: -75 MPa}, top: {normal_stress: -50 MPa}}}, "
         "conduit: {type: fracture_flow/tpfa, initial_aperture: 0.2 mm, initial_pressure: 30 MPa, injection: {well: "
         "{fracture: aa, rate: 1e-6 m^2/s}}}, contact: {type: contact/coulomb}}, couplers: [{type: biot, between: "
         "[pore, rock]}, {type: wall_exchange, between: [pore, conduit]}, {type: wall_traction, between: [rock, "
         "contact, conduit]}, {type: aperture, between: [contact, conduit]}], schedule: [{solve: [pore, rock, conduit, "
         "contact]}], time: {end: 8 h, step: 2 h}, solver: {condense: " +
         std::string(condense ? "true" : "false") + "}}";
}

/// Flow through rock that stores nothing, held by fractures that end in the boundary: in a pocket the constant mode of
/// the pressure is known from its walls only.
std::string drained(const std::string& fractures, bool condense) {
  return "{geometry: {box: {x: [0 m, 100 m], y: [0 m, 100 m]}, fractures: {" + fractures +
         "}}, mesh: {size: 14 m, fracture_size: 3 m}, materials: {porosity: 0, fluid_compressibility: 4.5e-10 1/Pa, "
         "permeability: 1e-15 m^2, viscosity: 1 mPa*s}, components: {pore: {type: matrix_flow/mpfa, boundary: {left: "
         "{pressure: 3 MPa}, right: {pressure: 1 MPa}}}, conduit: {type: fracture_flow/tpfa, initial_aperture: 0.1 mm, "
         "injection: {well: {fracture: aa, rate: 1e-6 m^2/s}}}}, couplers: [{type: wall_exchange, between: [pore, "
         "conduit]}], schedule: [{solve: [pore, conduit]}], time: {end: 8 h, step: 2 h}, solver: {condense: " +
         std::string(condense ? "true" : "false") + "}}";
}

void expect_equal(const SceneRun& run, const SceneRun& whole, const std::vector<std::string>& fields) {
  for (const std::string& name : fields) {
    const Vector &mine = run.field(name), &other = whole.field(name);
    EXPECT_GT(other.lpNorm<Eigen::Infinity>(), 0) << name;
    EXPECT_LT((mine - other).lpNorm<Eigen::Infinity>(), 1e-7 * other.lpNorm<Eigen::Infinity>()) << name;
  }
}

class Pockets : public ::testing::TestWithParam<Case> {};

TEST_P(Pockets, OfRockAreCondensed) {
  SceneRun run = SceneRun::from_text(stimulated(GetParam().fractures, true));
  SceneRun whole = SceneRun::from_text(stimulated(GetParam().fractures, false));
  run.run();
  whole.run();
  expect_equal(run, whole,
               {"pore.pressure", "rock.displacement", "conduit.pressure", "contact.traction", "contact.jump"});
  const LinearCounts counts = run.linear_counts();
  EXPECT_EQ(counts.orderings, 1);
  EXPECT_EQ(counts.factorizations, 1);  // of the bulk; constant steps
  EXPECT_GE(counts.condensed, 4);       // one a step
  EXPECT_EQ(whole.linear_counts().orderings, 1);
}

TEST_P(Pockets, OfPressureAreCondensed) {
  SceneRun run = SceneRun::from_text(drained(GetParam().fractures, true));
  SceneRun whole = SceneRun::from_text(drained(GetParam().fractures, false));
  run.run();
  whole.run();
  expect_equal(run, whole, {"pore.pressure", "conduit.pressure"});
  const LinearCounts counts = run.linear_counts();
  EXPECT_EQ(counts.orderings, 1);
  EXPECT_EQ(counts.factorizations, 1);
  EXPECT_GE(counts.condensed, 1);
  EXPECT_EQ(whole.linear_counts().orderings, 1);
}

INSTANTIATE_TEST_SUITE_P(Cases, Pockets,
                         ::testing::Values(Case{"One", triangle("a", 0, 0, 0)},
                                           Case{"Turned", triangle("a", 0.3, 0, 0)},
                                           Case{"Mirrored", triangle("a", M_PI - 0.3, 0, 0)},
                                           Case{"Perturbed", triangle("a", 0.3 * (1 + 1e-9), 0, 0)},
                                           Case{"Two", triangle("a", 0.3, -20, 5) + ", " + triangle("b", 0.1, 20, -5)}),
                         [](const auto& info) { return std::string(info.param.name); });

}  // namespace
}  // namespace sprekk::testing
