// One state has one residual and one Jacobian: whatever has been assembled before, all terms of all parts come back to
// the bit.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>

#include "framework/assembly/assemble_all.hpp"
#include "framework/assembly/piecewise_smooth.hpp"
#include "framework/config/yaml/load_scene.hpp"
#include "framework/scene/registry.hpp"
#include "tests/verification/scene_run.hpp"

namespace sprekk::testing {
namespace {

const std::vector<Override> coarse = {{"mesh", "{size: 0.5 m, fracture_size: 25 mm}"},
                                      {"components.tips.size", "0.3 m"},
                                      {"components.tips.sectors", "8"},
                                      {"components.tips.mesh_ratio", "1"},
                                      {"time.step", "1 min"}};

/// All contents of an assembly, by name.
using Terms = std::map<std::string, std::vector<double>>;

void append(std::vector<double>& to, const Vector& values) { to.insert(to.end(), values.begin(), values.end()); }

Terms terms_at(const std::vector<Part*>& parts, const std::vector<const Field*>& unknowns, const StepTime& step) {
  Assembly assembly(unknowns, Assembly::Request::residual_and_derivatives);
  assemble_all(assembly, parts, step);
  Terms terms;
  for (int u = 0; u < static_cast<int>(unknowns.size()); ++u) {
    std::vector<double>& row = terms[unknowns[u]->name()];
    append(row, assembly.residual(u));
    append(row, assembly.balances().residual(u));
    append(row, assembly.balances().throughput(u));
    row.insert(row.end(), {assembly.magnitude(u), assembly.round_off_base(u)});
  }
  for (const Assembly::Block& block : assembly.blocks()) {
    std::vector<double>& entries = terms[unknowns[block.row]->name() + " by " + unknowns[block.column]->name()];
    entries.push_back(block.factor);
    if (block.weights) append(entries, *block.weights);
    for (int outer = 0; outer < block.matrix->outerSize(); ++outer)
      for (SparseMatrix::InnerIterator entry(*block.matrix, outer); entry; ++entry)
        entries.insert(entries.end(), {double(entry.row()), double(entry.col()), entry.value()});
  }
  for (const Assembly::Fixed& fixed : assembly.fixed())
    terms["fixed"].insert(terms["fixed"].end(), {double(fixed.unknown), double(fixed.row), fixed.scale, fixed.error});
  return terms;
}

/// Values that Newton's method may try: any size, and either sign where the values now have both.
std::vector<Vector> random_values(const std::vector<const Field*>& unknowns, std::mt19937& random) {
  std::uniform_real_distribution<double> factor(-1, 2);
  std::vector<Vector> values;
  for (const Field* field : unknowns) {
    const double scale = field->now().size() ? std::max(field->now().lpNorm<Eigen::Infinity>(), 1e-6) : 0;
    values.push_back(field->now());
    const bool is_positive = field->now().size() && field->now().minCoeff() > 0;
    for (double& value : values.back())
      value = is_positive ? value * std::exp(0.2 * factor(random)) : 0.5 * value + 0.3 * scale * factor(random);
  }
  return values;
}

class RepeatedAssembly : public ::testing::TestWithParam<std::vector<Override>> {};

TEST_P(RepeatedAssembly, GivesTheSameBits) {
  std::vector<Override> settings = coarse;
  settings.insert(settings.end(), GetParam().begin(), GetParam().end());
  SceneRun run("paper/wing_cracks.yaml", settings);
  ASSERT_TRUE(run.step());
  Model& model = run.model();
  const std::vector<const Field*> unknowns = model.schedule().unknowns();
  const auto set = [&](const std::vector<Vector>& values) {
    for (std::size_t u = 0; u < unknowns.size(); ++u) model.fields().at(unknowns[u]->name()).set(values[u]);
  };
  std::vector<Field*> solved;
  for (const Field* field : unknowns) solved.push_back(&model.fields().at(field->name()));
  const StepTime step{run.time(), 60, run.time() + 60};
  begin_step(model.parts(), step);
  std::mt19937 random(5);
  for (int trial = 0; trial < 4; ++trial) {
    const std::vector<Vector> here = random_values(unknowns, random);
    set(here);
    for (Part* part : model.parts())
      if (auto* follower = dynamic_cast<PiecewiseSmooth*>(part)) follower->observe_iterate(solved);
    const Terms first = terms_at(model.parts(), unknowns, step);
    for (int other = 0; other < 4; ++other) {
      set(random_values(unknowns, random));
      EXPECT_NE(terms_at(model.parts(), unknowns, step), first);
    }
    set(here);
    const Terms again = terms_at(model.parts(), unknowns, step);
    ASSERT_EQ(again.size(), first.size());
    for (const auto& [name, entries] : first) EXPECT_EQ(again.at(name), entries) << name << ", trial " << trial;
  }
}

/// The scene with heat in rock and fractures, which the fluid carries and which loads the rock.
std::vector<Override> with_heat(const std::string& type) {
  return {
      {"components.heat", "{type: matrix_heat/" + type +
                              ", conductivity: 2.5 W/(m*K), heat_capacity: 2.2e6 J/(m^3*K), initial_temperature: "
                              "350 K, boundary: {left: {temperature: 340 K}}}"},
      {"components.water",
       "{type: fracture_heat/tpfa, aperture: 0.1 mm, conductivity: 0.6 W/(m*K), "
       "heat_capacity: 4.2e6 J/(m^3*K), initial_temperature: 350 K}"},
      {"couplers",
       "[{type: biot, between: [pore, rock]}, {type: wall_exchange, between: [pore, conduit]}, {type: "
       "wall_traction, between: [rock, contact, conduit]}, {type: aperture, between: [contact, conduit]}, {type: "
       "two_level, between: [rock, conduit, tips, contact]}, {type: heat_advection, between: [pore, conduit, heat, "
       "water], fluid_heat_capacity: 4.2e6 J/(m^3*K)}, {type: heat_exchange, between: [heat, water]}, {type: "
       "thermal_stress, between: [heat, rock], expansion: 1e-5 1/K}, {type: thermal_viscosity, between: [pore, "
       "conduit, heat, water]}, {type: buoyancy, between: [pore, conduit, heat, water], fluid_expansion: 5e-4 1/K, "
       "compressibility: 1e-9 1/Pa}, {type: thermal_pressurization, between: [pore, conduit, heat, water], "
       "fluid_expansion: 5e-4 1/K, porosity: 0.1, expansion: 1e-5 1/K, biot_coefficient: 0.8}]"},
      {"materials.gravity", "[0 m/s^2, -9.81 m/s^2]"},
      {"components.rock.gravity", "[0 m/s^2, 0 m/s^2]"},
      {"schedule", "[{solve: [pore, rock, conduit, contact, heat, water]}, {grow: tips, settle: [rock, contact]}]"}};
}

/// The scene with a tracer in rock and fractures, which decays.
std::vector<Override> with_tracer(const std::string& type) {
  return {
      {"components.salt", "{type: matrix_transport/" + type +
                              ", porosity: 0.1, diffusion: 1e-9 m^2/s, decay: 1e-6 1/s, initial_concentration: 1 "
                              "kg/m^3, boundary: {left: {concentration: 2 kg/m^3}}}"},
      {"components.water",
       "{type: fracture_transport/tpfa, aperture: 0.1 mm, diffusion: 1e-9 m^2/s, decay: 1e-6 1/s, "
       "initial_concentration: 1 kg/m^3}"},
      {"couplers",
       "[{type: biot, between: [pore, rock]}, {type: wall_exchange, between: [pore, conduit]}, {type: "
       "wall_traction, between: [rock, contact, conduit]}, {type: aperture, between: [contact, conduit]}, {type: "
       "two_level, between: [rock, conduit, tips, contact]}, {type: tracer_advection, between: [pore, conduit, salt, "
       "water]}, {type: tracer_exchange, between: [salt, water]}]"},
      {"schedule", "[{solve: [pore, rock, conduit, contact, salt, water]}, {grow: tips, settle: [rock, contact]}]"}};
}

/// The scene with wells in rock and in the fracture, with limits.
std::vector<Override> with_wells() {
  return {
      {"components.wells",
       "{type: wells/limited, wells: {both: {rate: 1e-6 m^2/s, highest_pressure: 1 GPa, places: {rock: {at: [0.3 m, "
       "0.3 m], index: 1e-12 m^2/(Pa*s)}, fracture: {fracture: main, at: [1 m, 1 m]}}}}}"},
      {"couplers",
       "[{type: biot, between: [pore, rock]}, {type: wall_exchange, between: [pore, conduit]}, {type: "
       "wall_traction, between: [rock, contact, conduit]}, {type: aperture, between: [contact, conduit]}, {type: "
       "two_level, between: [rock, conduit, tips, contact]}, {type: well_exchange, between: [wells, pore, "
       "conduit]}]"},
      {"schedule", "[{solve: [pore, rock, conduit, contact, wells]}, {grow: tips, settle: [rock, contact]}]"}};
}

/// The scene with a second flow in the rock, and with a pressure and a temperature that are given.
std::vector<Override> with_other_flows() {
  return {{"components.blocks",
           "{type: matrix_flow/tpfa, permeability: 1e-21 m^2, storage: 1e-11 1/Pa, initial_pressure: 1 MPa}"},
          {"components.given", "{type: matrix_flow/prescribed, pressure: (1e6 + 1e3*x*t) Pa}"},
          {"components.warm", "{type: matrix_heat/prescribed, temperature: (350 + 0.01*t) K}"},
          {"couplers",
           "[{type: biot, between: [pore, rock]}, {type: wall_exchange, between: [pore, conduit]}, {type: "
           "wall_traction, between: [rock, contact, conduit]}, {type: aperture, between: [contact, conduit]}, {type: "
           "two_level, between: [rock, conduit, tips, contact]}, {type: matrix_exchange, between: [pore, blocks], "
           "exchange: "
           "1e-14 1/(Pa*s)}, {type: biot, between: [given, rock]}, {type: thermal_stress, between: [warm, rock], "
           "expansion: 1e-5 1/K}]"},
          {"schedule", "[{solve: [pore, blocks, rock, conduit, contact]}, {grow: tips, settle: [rock, contact]}]"}};
}

/// The scene with another flow in the upper quarter of the rock.
std::vector<Override> with_a_flow_beside() {
  return {{"geometry.regions", "{top: {polygon: [[0 m, 1.6 m], [2 m, 1.6 m], [2 m, 2 m], [0 m, 2 m]]}}"},
          {"components.pore.regions", "[rock]"},
          {"components.beside", "{type: matrix_flow/rt0, regions: [top]}"},
          {"couplers",
           "[{type: biot, between: [pore, rock]}, {type: biot, between: [beside, rock]}, {type: border_exchange, "
           "between: [beside, pore], resistance: 1e12 Pa*s/m}, {type: wall_exchange, between: [pore, conduit]}, {type: "
           "wall_traction, between: [rock, contact, conduit]}, {type: aperture, between: [contact, conduit]}, {type: "
           "two_level, between: [rock, conduit, tips, contact]}]"},
          {"schedule", "[{solve: [pore, beside, rock, conduit, contact]}, {grow: tips, settle: [rock, contact]}]"}};
}

/// The scene with sides and ends of fractures that leak, or let out only, in rock on springs.
std::vector<Override> with_leaky_sides() {
  return {
      {"components.pore.boundary",
       "{left: {outer_pressure: 1 MPa, conductance: 1e-15 m/(Pa*s)}, top: {outer_pressure: 1 MPa, only_out: true}}"},
      {"components.conduit.boundary", "{left: {as_rock: true}}"},
      {"components.rock.type", "poromechanics/fem"},
      {"components.rock.order", "second"},
      {"components.rock.boundary.left.displacement_x", ""},
      {"components.rock.boundary.left.spring_normal", "40 GPa/m"}};
}

/// The scene without flow in the rock, into which the fracture leaks by Carter's law.
std::vector<Override> with_leak_off() {
  return {{"components.pore", ""},
          {"output.probes", ""},
          {"couplers",
           "[{type: wall_traction, between: [rock, contact, conduit]}, {type: aperture, between: [contact, conduit]}, "
           "{type: two_level, between: [rock, conduit, tips, contact]}, {type: carter_leak_off, between: [conduit], "
           "leak_off_coefficient: 1e-6 m/s^0.5, spurt_loss: 1e-6 m}]"},
          {"schedule", "[{solve: [rock, conduit, contact]}, {grow: tips, settle: [rock, contact]}]"}};
}

const std::vector<std::vector<Override>> scenes = {
    {},
    {{"components.pore.type", "matrix_flow/tpfa"}},
    {{"components.pore.type", "matrix_flow/rt0"}},
    {{"components.pore.type", "matrix_flow/ntpfa"}},
    {{"materials.permeability", "5e-20 m^2*exp(tanh(p/(30 MPa)) + tanh(eps_v/0.01))"}},
    {{"components.pore.type", "matrix_flow/tpfa"},
     {"materials.permeability", "5e-20 m^2*exp(tanh(p/(30 MPa)) - tanh(eps_v/0.01))"}},
    {{"components.rock.type", "poromechanics/fem"}, {"components.rock.order", "second"}},
    {{"components.contact.type", "contact/penalty"}},
    {{"components.contact.type", "contact/augmented_lagrangian"}},
    {{"components.other_tips", "{type: fine_fracture/jump_fit}"}},
    {{"materials.dilation_angle", "20 deg"}, {"components.conduit.initial_aperture", "0.5 mm"}},
    with_heat("mpfa"),
    with_heat("tpfa"),
    with_tracer("mpfa"),
    with_tracer("tpfa"),
    with_wells(),
    with_other_flows(),
    with_a_flow_beside(),
    with_leaky_sides(),
    with_leak_off(),
    {{"components.tips.sectors", ""},
     {"components.tips.mesh_ratio", ""},
     {"components.tips.type", "fine_fracture/boundary_element"}},
    {{"components.contact.rate_and_state",
      "{a: 0.01, b: 0.015, distance: 10 um, reference_rate: 1 um/s, initial_slip_rate: 1e-9 m/s}"}}};
INSTANTIATE_TEST_SUITE_P(Scenes, RepeatedAssembly, ::testing::ValuesIn(scenes));

/// The scenes above have all that there is: a new type belongs into one of them.
TEST(AllTypes, AreInTheScenesOfRepeatedAssembly) {
  std::set<std::string> types = {"matrix_flow/tpfa",        "poromechanics/fem",
                                 "matrix_flow/rt0",         "matrix_flow/ntpfa",
                                 "contact/penalty",         "contact/augmented_lagrangian",
                                 "fine_fracture/jump_fit",  "matrix_heat/mpfa",
                                 "matrix_heat/tpfa",        "fracture_heat/tpfa",
                                 "heat_advection",          "heat_exchange",
                                 "thermal_stress",          "thermal_pressurization",
                                 "thermal_viscosity",       "buoyancy",
                                 "wells/limited",           "well_exchange",
                                 "matrix_exchange",         "border_exchange",
                                 "carter_leak_off",         "matrix_flow/prescribed",
                                 "matrix_heat/prescribed",  "fine_fracture/boundary_element",
                                 "matrix_transport/mpfa",   "matrix_transport/tpfa",
                                 "fracture_transport/tpfa", "tracer_advection",
                                 "tracer_exchange",         "outside/program",
                                 "given_friction",          "given_aperture"},
                        registered;
  SceneRun run("paper/wing_cracks.yaml", coarse);
  for (const std::string section : {"components", "couplers"}) {
    const Node& parts = *run.model().scene().whole.find(section);
    for (const Node& part : parts.items) types.insert(part.find("type")->scalar);
    for (const Node::Entry& part : parts.entries) types.insert(part.value.find("type")->scalar);
  }
  for (const ComponentType& type : Registry::instance().components())
    if (!type.type.starts_with("test/")) registered.insert(type.type);  // those are of other tests
  for (const CouplerType& type : Registry::instance().couplers()) registered.insert(type.type);
  EXPECT_EQ(types, registered);
}

}  // namespace
}  // namespace sprekk::testing
