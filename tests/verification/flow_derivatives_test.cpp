// The whole Jacobian of flow in rock and fractures, of the exchange between them and of their aperture.
#include "framework/assembly/piecewise_smooth.hpp"
#include "tests/verification/derivatives.hpp"

namespace sprekk::testing {
namespace {

/// Fractures that cross, touch, end in the rock and on two sides; gravity; units without any scale. `conduit` has the
/// laws.
std::string scene(const std::string& conduit) {
  return R"(
geometry:
  box: {x: [-1, 1], y: [-1, 1]}
  fractures: {a: {points: [[-1, 0.1], [0.7, 0]]}, b: {points: [[0, -0.5], [0.1, 1]]}, c: {points: [[0.4, -0.6], [0.5, -0.2]]}}
mesh: {size: 0.6, fracture_size: 0.4}
materials:
  young_modulus: 1 Pa
  poisson_ratio: 0.25
  biot_coefficient: 0.5
  friction: 0.6
  permeability: {along: 1 m^2, across: 0.1 m^2, angle: 30 deg}
  viscosity: 1 Pa*s
  fluid_density: 2 kg/m^3
components:
  pore: {type: matrix_flow/mpfa, storage: 0.7 1/Pa, gravity: [0.3 m/s^2, -1 m/s^2], boundary: {left: {pressure: "(1 + y) Pa"}, top: {flux: 0.1 m/s}}}
  rock:
    type: poromechanics/mpsa
    boundary: {left: {displacement_x: 0 m, displacement_y: 0 m}}
  conduit:
    type: fracture_flow/tpfa
    fluid_compressibility: 0.1 1/Pa
    initial_aperture: 1 m
    gravity: [0.3 m/s^2, -1 m/s^2]
    boundary: {left: {pressure: 1 Pa}, top: {pressure: -1 Pa}}
)" + conduit +
         R"(
  contact: {type: contact/coulomb}
couplers:
  - {type: biot, between: [pore, rock]}
  - {type: wall_exchange, between: [pore, conduit]}
  - {type: wall_traction, between: [rock, contact, conduit]}
  - {type: aperture, between: [contact, conduit]}
schedule: [{solve: [pore, rock, conduit, contact]}]
time: {end: 1 s, step: 1 s}
)";
}

const std::vector<Spread> spreads = {{"pore.pressure", -1, 1},       {"pore.wall_flux", -1, 1},
                                     {"conduit.pressure", -1, 1},    {"conduit.flux", -1, 1},
                                     {"conduit.aperture", 0.5, 1.5}, {"contact.jump", -1, 1}};
constexpr int rows = 5;  // the jump's equation is that of the walls' traction

using Pairs = std::vector<std::pair<std::string, std::string>>;
const Pairs of_all_laws = {{"pore.pressure", "pore.pressure"},       {"pore.pressure", "pore.wall_flux"},
                           {"pore.wall_flux", "pore.pressure"},      {"pore.wall_flux", "pore.wall_flux"},
                           {"pore.wall_flux", "conduit.pressure"},   {"conduit.pressure", "pore.wall_flux"},
                           {"conduit.pressure", "conduit.pressure"}, {"conduit.pressure", "conduit.flux"},
                           {"conduit.pressure", "conduit.aperture"}, {"conduit.flux", "conduit.pressure"},
                           {"conduit.flux", "conduit.flux"},         {"conduit.aperture", "conduit.aperture"},
                           {"conduit.aperture", "contact.jump"}};

Pairs with(Pairs pairs, const Pairs& more) {
  pairs.insert(pairs.end(), more.begin(), more.end());
  return pairs;
}

TEST(FlowDerivatives, OfTheCubicLaw) {
  SceneRun run = SceneRun::from_text(scene("    aperture_floor: 1 mm"));
  expect_derivatives(run, spreads, rows,
                     with(of_all_laws, {{"pore.wall_flux", "conduit.aperture"}, {"conduit.flux", "conduit.aperture"}}));
}

TEST(FlowDerivatives, OfLimitedFluxes) {
  std::string text = scene("    aperture_floor: 1 mm");
  const std::string mpfa = "matrix_flow/mpfa";
  text.replace(text.find(mpfa), mpfa.size(), "matrix_flow/ntpfa");
  SceneRun run = SceneRun::from_text(text);
  expect_derivatives(run, spreads, rows,
                     with(of_all_laws, {{"pore.wall_flux", "conduit.aperture"}, {"conduit.flux", "conduit.aperture"}}));
}

/// Of unlike layers; around the tips of fractures anisotropic rock has no singular flow, whose derivatives are held.
TEST(FlowDerivatives, OfAPermeabilityByFormula) {
  for (const std::string formula : {"{xx: (1 + 0.4*p/Pa + 0.5*eps_v) m^2, yy: (0.1 + 0.3*x/m*x/m + 0.02*eps_v^2) m^2}",
                                    "{xx: (2 + x/m) m^2, yy: \"(0.3*exp(0.4*p/Pa - 0.2*eps_v*y/m)) m^2\"}"})
    for (const std::string type : {"mpfa", "tpfa"}) {
      std::string text = scene("    aperture_floor: 1 mm");
      const auto put = [&](const std::string& old, const std::string& other) {
        text.replace(text.find(old), old.size(), other);
      };
      put("matrix_flow/mpfa", "matrix_flow/" + type);
      put("{along: 1 m^2, across: 0.1 m^2, angle: 30 deg}", formula);
      SceneRun run = SceneRun::from_text(text);
      std::vector<Spread> with_rock = spreads;
      with_rock.push_back({"rock.displacement", -0.3, 0.3});
      Pairs full = with(of_all_laws, {{"pore.wall_flux", "conduit.aperture"},
                                      {"conduit.flux", "conduit.aperture"},
                                      {"pore.pressure", "rock.displacement"}});
      if (type == "mpfa") full.push_back({"pore.wall_flux", "rock.displacement"});
      for (auto* part : parts_with<PiecewiseSmooth>(run.model().parts()))
        part->set_search_mode(SearchMode::without_shortcuts);
      expect_derivatives(run, with_rock, rows, full);
    }
}

TEST(FlowDerivatives, OfAPorosityByFormula) {
  for (const std::string type : {"mpfa", "tpfa"}) {
    std::string text = scene("    aperture_floor: 1 mm");
    const auto put = [&](const std::string& old, const std::string& other) {
      text.replace(text.find(old), old.size(), other);
    };
    put("matrix_flow/mpfa", "matrix_flow/" + type);
    put("storage: 0.7 1/Pa",
        "porosity: \"0.4 + 0.2*tanh(p/Pa) + 0.1*x/m*eps_v + 0.1*eps_v^2\", fluid_compressibility: 0.3 1/Pa");
    SceneRun run = SceneRun::from_text(text);
    std::vector<Spread> with_rock = spreads;
    with_rock.push_back({"rock.displacement", -0.3, 0.3});
    expect_derivatives(run, with_rock, rows,
                       with(of_all_laws, {{"pore.wall_flux", "conduit.aperture"},
                                          {"conduit.flux", "conduit.aperture"},
                                          {"pore.pressure", "rock.displacement"}}));
  }
}

TEST(FlowDerivatives, OfTheCubicLawAboveAndBelowItsFloor) {
  SceneRun run = SceneRun::from_text(scene("    aperture_floor: 0.9 m"));
  expect_derivatives(run, spreads, rows,
                     with(of_all_laws, {{"pore.wall_flux", "conduit.aperture"}, {"conduit.flux", "conduit.aperture"}}));
}

TEST(FlowDerivatives, OfTheCubicLawThatIsReleasedInPart) {
  for (const char* floor : {"1 mm", "0.9 m"}) {
    SceneRun run = SceneRun::from_text(scene(std::string("    aperture_floor: ") + floor));
    Field& aperture = run.model().fields().at("conduit.aperture");
    aperture.set(Vector::LinSpaced(aperture.size(), 0.6, 1.3));
    for (auto* part : parts_with<PiecewiseSmooth>(run.model().parts())) {
      part->release_coefficients(0);
      part->release_coefficients(0.3);
    }
    expect_derivatives(
        run, spreads, rows,
        with(of_all_laws, {{"pore.wall_flux", "conduit.aperture"}, {"conduit.flux", "conduit.aperture"}}));
  }
}

TEST(FlowDerivatives, OfTheLawOfRoughWallsAboveAndBelowItsResidual) {
  for (const char* residual : {"1 mm", "0.5 m"}) {
    SceneRun run =
        SceneRun::from_text(scene(std::string("    law: {type: rough, roughness: 0.4 m, residual: ") + residual + "}"));
    expect_derivatives(
        run, spreads, rows,
        with(of_all_laws, {{"pore.wall_flux", "conduit.aperture"}, {"conduit.flux", "conduit.aperture"}}));
  }
}

TEST(FlowDerivatives, OfAGivenTransmissivity) {
  // kappa = 2 K / (mu a^2) depends on the aperture.
  SceneRun run = SceneRun::from_text(scene("    transmissivity: constant\n    transmissivity_value: (2 + x) m^3"));
  expect_derivatives(run, spreads, rows, with(of_all_laws, {{"pore.wall_flux", "conduit.aperture"}}));
}

TEST(FlowDerivatives, OfAGivenNormalPermeability) {
  SceneRun run =
      SceneRun::from_text(scene("    normal_permeability: constant\n    normal_permeability_value: (2 + y) m/(Pa*s)"));
  expect_derivatives(run, spreads, rows, with(of_all_laws, {{"conduit.flux", "conduit.aperture"}}));
}

TEST(FlowDerivatives, OfWallsOfDifferentNormalPermeability) {
  SceneRun run = SceneRun::from_text(scene("    wall_permeability: {left: (2 + y) m/(Pa*s)}"));
  expect_derivatives(run, spreads, rows,
                     with(of_all_laws, {{"pore.wall_flux", "conduit.aperture"}, {"conduit.flux", "conduit.aperture"}}));
}

TEST(FlowDerivatives, OfInertia) {
  for (const char* law : {"type: cubic, inertia: (3 + x) 1/m", "type: cubic, inertia: 300 1/m, residual: 0.9 m",
                          "type: rough, roughness: 0.4 m, inertia: 20 1/m"}) {
    SceneRun run = SceneRun::from_text(scene(std::string("    law: {") + law + "}"));
    expect_derivatives(
        run, spreads, rows,
        with(of_all_laws, {{"pore.wall_flux", "conduit.aperture"}, {"conduit.flux", "conduit.aperture"}}));
  }
  SceneRun run = SceneRun::from_text(scene("    law: {type: constant, transmissivity: (2 + x) m^3, inertia: 3 1/m}"));
  expect_derivatives(run, spreads, rows, with(of_all_laws, {{"pore.wall_flux", "conduit.aperture"}}));
}

TEST(FlowDerivatives, OfInertiaThatIsReleasedInPart) {
  SceneRun run = SceneRun::from_text(scene("    law: {type: cubic, inertia: 30 1/m}"));
  Field& flux = run.model().fields().at("conduit.flux");
  flux.set(Vector::LinSpaced(flux.size(), -0.7, 1.1));
  for (auto* part : parts_with<PiecewiseSmooth>(run.model().parts())) {
    part->release_coefficients(0);
    part->release_coefficients(0.3);
  }
  expect_derivatives(run, spreads, rows,
                     with(of_all_laws, {{"pore.wall_flux", "conduit.aperture"}, {"conduit.flux", "conduit.aperture"}}));
}

}  // namespace
}  // namespace sprekk::testing
