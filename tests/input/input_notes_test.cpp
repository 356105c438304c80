// Notes on input without effect: each with a scene that has the note, and one that has not.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <ostream>

#include "tests/input/notes.hpp"

namespace sprekk::testing {
namespace {

using ::testing::HasSubstr;

struct Input {
  const char* scene;
  Settings settings;
  const char* note;  ///< "" for none
};

/// The name that ctest shows.
void PrintTo(const Input& input, std::ostream* text) {
  *text << input.scene;
  for (const std::string& setting : input.settings) *text << ", " << setting;
}

const std::string all_but_aperture =
    "{type: biot, between: [pore, rock]}, {type: wall_exchange, between: [pore, conduit]}";

Settings with_tips(const std::string& between, const std::string& grow = ", {grow: tips, settle: [rock, contact]}") {
  return {"components.tips={type: fine_fracture/quarter_point, size: 0.4 m}",
          "couplers=[" + all_but_aperture +
              ", {type: wall_traction, between: [rock, contact, conduit]}, {type: aperture, between: [contact, "
              "conduit]}, {type: two_level, between: " +
              between + "}]",
          "schedule=[{solve: [pore, rock, conduit, contact]}" + grow + "]"};
}

/// Heat in rock and fracture, which fluid carries between these components.
Settings with_heat(const std::string& between, const std::string& aperture) {
  return {"components.heat={type: matrix_heat/tpfa, conductivity: 2 W/(m*K), heat_capacity: 2e6 J/(m^3*K)}",
          "components.water={type: fracture_heat/tpfa, conductivity: 0.6 W/(m*K), heat_capacity: 4.2e6 J/(m^3*K), "
          "aperture: " +
              aperture + "}",
          "components.heat.initial_temperature=300 K",
          "components.water.initial_temperature=300 K",
          "couplers=[" + all_but_aperture +
              ", {type: wall_traction, between: [rock, contact, conduit]}, {type: aperture, between: [contact, "
              "conduit]}, {type: heat_exchange, between: [heat, water]}, {type: heat_advection, fluid_heat_capacity: "
              "4.2e6 J/(m^3*K), between: " +
              between +
              "}, {type: thermal_pressurization, between: [pore, conduit, heat, water], fluid_expansion: 3e-4 1/K, "
              "porosity: 0.1}]",
          "schedule=[{solve: [pore, rock, conduit, contact, heat, water]}]"};
}

std::string table(const char* name) {
  return (std::filesystem::path(SPREKK_SOURCE_DIR) / "tests/input/tables" / name).string();
}

/// A crack through a sealed fracture, in rock.
Settings with_seal(const Settings& more) {
  Settings settings = {"components.rock=",
                       "components.contact=",
                       "output=",
                       "materials.young_modulus=",
                       "materials.poisson_ratio=",
                       "materials.biot_coefficient=",
                       "materials.friction=",
                       "couplers=[{type: wall_exchange, between: [pore, conduit]}]",
                       "schedule=[{solve: [pore, conduit]}]",
                       "geometry.fractures.seal={points: [[0.5 m, 0.1 m], [0.5 m, 0.9 m]]}",
                       "components.conduit.normal_permeability=constant"};
  settings.insert(settings.end(), more.begin(), more.end());
  return settings;
}

const std::string tight_seal =
    "components.conduit.normal_permeability_value={fractures: {seal: 1e-15 m/(Pa*s), crack: 1e-3 m/(Pa*s)}}";

class InputNotes : public ::testing::TestWithParam<Input> {};

TEST_P(InputNotes, AreToldByCheck) {
  const auto& [scene, settings, note] = GetParam();
  const std::string told = notes_of_check(scene, settings);
  if (std::string(note).empty())
    EXPECT_EQ(told, "");
  else
    EXPECT_THAT(told, HasSubstr(note));
}

INSTANTIATE_TEST_SUITE_P(
    all, InputNotes,
    ::testing::Values(
        Input{
            "rock.yaml", {"components.rock.boundary.left.normal_stress=-1 MPa"}, "the x component of 'normal_stress'"},
        Input{"rock.yaml", {"components.rock.boundary.left.normal_stress=0 MPa"}, ""},
        Input{"fractured.yaml",
              {"geometry.fractures.branch={points: [[0.5 m, 0.5005 m], [0.5 m, 0.8 m]]}"},
              "lines nearer than 0.001 m were joined: 1 point moved onto a point, a line or a side nearby, by up to "
              "0.0005 m at (0.5, 0.5)"},
        Input{"fractured.yaml", {"geometry.fractures.branch={points: [[0.5 m, 0.5 m], [0.5 m, 0.8 m]]}"}, ""},
        Input{"fractured.yaml",
              {"geometry.fractures.speck={points: [[0.1 m, 0.8 m], [0.15 m, 0.8 m]]}"},
              "fracture 'speck' is 0.05 m long, shorter than the cell of 0.1 m"},
        Input{"fractured.yaml", {"geometry.fractures.speck={points: [[0.1 m, 0.8 m], [0.2 m, 0.8 m]]}"}, ""},
        Input{"fractured.yaml",
              {"components.pore.wells={w: {at: [0.43, 0.5], rate: 0 m^2/s}}"},
              "lies on the fracture 'crack'"},
        Input{"fractured.yaml", {"components.pore.wells={w: {at: [0.43, 0.5001], rate: 0 m^2/s}}"}, ""},
        Input{"fractured.yaml", {"components.pore.wells={w: {at: [0.73, 0.5], rate: 0 m^2/s}}"}, ""},
        Input{"flow.yaml",
              {"components.pore.boundary.right.pressure={table: " + table("pulse.csv") + ", of: t}"},
              "has rows that are 60 s apart"},
        Input{"flow.yaml",
              {"components.pore.boundary.right.pressure={table: " + table("pulse.csv") + ", of: t}", "time.step=60 s"},
              ""},
        Input{
            "flow.yaml", {"components.pore.boundary.right.pressure={table: " + table("along_x.csv") + ", of: x}"}, ""},
        Input{"fractured.yaml",
              {"geometry.regions={a: {polygon: [[0.1, 0.1], [0.2, 0.1], [0.2, 0.2]]}, b: {polygon: [[0, 0], [0.3, 0], "
               "[0.3, 0.3], [0, 0.3]]}}"},
              "no cell belongs to a"},
        Input{"fractured.yaml",
              {"geometry.regions={b: {polygon: [[0, 0], [0.3, 0], [0.3, 0.3], [0, 0.3]]}, a: {polygon: [[0.1, 0.1], "
               "[0.2, 0.1], [0.2, 0.2]]}}"},
              ""},
        Input{"rock.yaml", {"components.rock.boundary.top.displacement_x=0 m"}, ""},  // the load is along y
        Input{"rock.yaml", {"components.rock.boundary.top.displacement_y=0 m"}, "the y component of 'normal_stress'"},
        Input{"rock.yaml",
              {"components.rock.boundary.right={displacement_x: 0 m, traction: [1 MPa, 0]}"},
              "the x component of 'traction' on side 'right' has no effect"},
        Input{"rock.yaml", {"components.rock.boundary.right={displacement_x: 0 m, traction: [0, 1 MPa]}"}, ""},
        Input{"rock.yaml",
              {"components.rock.boundary.right={displacement_y: 0 m, shear_stress: 1 MPa}"},
              "the y component of 'shear_stress' on side 'right' has no effect"},
        Input{"rock.yaml", {"components.rock.boundary.right={displacement_x: 0 m, shear_stress: 1 MPa}"}, ""},
        Input{"rock.yaml", {"components.rock.boundary.right={displacement_normal: 0 m, shear_stress: 1 MPa}"}, ""},
        Input{"rock.yaml",
              {"components.rock.boundary.right={normal_stress: -1 MPa, traction_x: -2 MPa}"},
              "'normal_stress' and 'traction_x' on side 'right' act in the same direction, and are added"},
        Input{"rock.yaml", {"components.rock.boundary.right={normal_stress: -1 MPa, traction_y: -2 MPa}"}, ""},
        Input{"rock.yaml", {"components.rock.gravity=[0, -9.81 m/s^2]"}, "gravity has no effect on 'rock'"},
        Input{"rock.yaml",
              {"components.rock.gravity=[0, -9.81 m/s^2]", "components.rock.rock_density=2500 kg/m^3"},
              "'rock' is out of balance at the start by 1 MPa"},
        Input{
            "rock.yaml", {"components.rock.rock_density=2500 kg/m^3"}, "'rock_density' of 'rock' does not weigh on it"},
        Input{"rock.yaml", {"components.rock.bulk_modulus=1 GPa"}, "'bulk_modulus' of 'rock' has no effect"},
        Input{"flow.yaml",
              {"components.pore.gravity=[0, -9.81 m/s^2]", "components.pore.fluid_density=0 kg/m^3"},
              "gravity has no effect on the flow of 'pore'"},
        Input{"flow.yaml",
              {"components.pore.gravity=[0, -9.81 m/s^2]"},
              "the fluid of 'pore' is out of balance at the start by 9.81e+03 Pa/m"},
        Input{"flow.yaml",
              {"components.pore.gravity=[0, -9.81 m/s^2]"},
              "or give one, such as 'initial_pressure: \"(9810*(1 - y)) Pa\"'"},
        Input{"flow.yaml",
              {"components.pore.gravity=[0, -9.81 m/s^2]", "components.pore.initial_pressure=(9810*(y - 1)) Pa"},
              "let gravity or the pressure act the other way"},
        Input{"flow.yaml",
              {"components.pore.gravity=[9.81 m/s^2, 0]", "components.pore.initial_pressure=(9810*(1 - y)) Pa"},
              "along gravity its initial_pressure grows by 0 Pa/m"},
        Input{"flow.yaml",
              {"components.pore.gravity=[0, -9.81 m/s^2]", "components.pore.initial_pressure=(9810*(1 - y)) Pa"},
              ""},
        Input{"flow.yaml", {"components.pore.gravity=[0, -9.81 m/s^2]", "start={settle: [pore]}"}, ""},
        Input{"flow.yaml",
              {"components.pore.gravity=[0, -9.81 m/s^2]", "components.pore.initial_pressure=(5000*(1 - y)) Pa",
               "components.pore.boundary.left=", "components.pore.boundary.right=",
               "components.pore.boundary.top={pressure: 0 Pa}", "components.pore.boundary.bottom={pressure: 5 kPa}"},
              ""},  // steady seepage, as it is given
        Input{"fractured.yaml", {"components.pore.initial_pressure=1 MPa"}, "begins with 0 Pa in the fracture 'crack'"},
        Input{"fractured.yaml",
              {"components.pore.initial_pressure=1 MPa", "components.conduit.initial_pressure=1 MPa"},
              ""},
        Input{"fractured.yaml",
              {"geometry.fractures.crack.points=[[0.5 m, 0.2 m], [0.5 m, 0.7 m]]",
               "components.conduit.gravity=[0, -9.81 m/s^2]"},
              "the fluid of 'conduit' is out of balance at the start by 9.81e+03 Pa/m in the fracture 'crack'"},
        Input{"fractured.yaml", {"components.conduit.gravity=[0, -9.81 m/s^2]"}, ""},  // the fracture lies level
        Input{"flow.yaml", {"components.pore.porosity=0.1"}, "'porosity' of 'pore' has no effect"},
        Input{"flow.yaml",
              {"components.pore.source=(if(t < 6, 0, 1e-9)) 1/s", "time.step=10 min"},
              "'t < 6' of 'source' is the same throughout the run (it compares with 6 s, and the first step is 600 s "
              "long)"},
        Input{
            "flow.yaml",
            {"components.pore.source=(if(t >= 7200, 0, 1e-9)) 1/s"},
            "'t >= 7200' of 'source' is the same throughout the run (it compares with 7200 s, and the run goes from 0 "
            "to 3600 s)"},
        Input{"flow.yaml", {"components.pore.source=(if(t < 6 h, 0, 1e-9)) 1/s"}, ""},
        Input{"flow.yaml", {"components.pore.source=(if(t < 2000, 0, 1e-9)) 1/s"}, ""},
        Input{"flow.yaml",
              {"components.pore.permeability=(if(x < 500, 1, 2)*1e-14) m^2"},
              "and the mesh goes from 0 to 1 m"},
        Input{"flow.yaml", {"components.pore.permeability=(if(x < 0.5, 1, 2)*1e-14) m^2"}, ""},
        Input{"flow.yaml",
              {"components.pore.source=[{value: 1e-9 1/s, from: 2 h, to: 3 h}]"},
              "a window of 'source' has no effect (it begins at 7200 s, and the run ends at 3600 s)"},
        Input{"flow.yaml",
              {"components.pore.source=[{value: 1e-9 1/s, to: 10 min}, {value: 1e-9 1/s, from: 5 min}]"},
              "two windows of 'source' overlap from 300 to 600 s"},
        Input{"flow.yaml",
              {"components.pore.source=[{value: 1e-9 1/s, to: 10 min}, {value: 1e-9 1/s, from: 10 min}]"},
              ""},
        Input{"flow.yaml", {"time.step=2 h"}, "'step' is 7200 s (the run is 3600 s long"},
        Input{"flow.yaml", {"time.step=1 h"}, ""}, Input{"flow.yaml", {"output.every=2 h"}, "'every' has no effect"},
        Input{"flow.yaml", {"output.every=1 h"}, ""},
        Input{"flow.yaml",
              {"time.start=10 min", "output.times=[5 min, 40 min, 2 h]"},
              "no fields are written at 300 s, 7200 s (the run begins at 600 s and ends at 3600 s)"},
        Input{"flow.yaml", {"output.times=[10 min, 1 h]"}, ""},
        Input{"fractured.yaml",
              {"components.conduit.prescribed.all={pressure: 1 MPa}"},
              "injection 'well' has no effect in 1 of its 1 fracture cells"},
        Input{"fractured.yaml", {"components.conduit.prescribed.there={at: [0.32 m, 0.5 m], pressure: 1 MPa}"}, ""},
        Input{"fractured.yaml",
              {"components.conduit.boundary.right={pressure: 1 MPa}"},
              "the end of 'conduit' on side 'right' has no effect (no fracture ends there)"},
        Input{"fractured.yaml",
              {"components.conduit.boundary.right={pressure: 1 MPa}",
               "geometry.fractures.crack.points=[[0.3 m, 0.5 m], [1 m, 0.5 m]]"},
              ""},
        Input{"fractured.yaml",
              {"geometry.fractures.crack.points=[[0 m, 0.5 m], [0.7 m, 0.5 m]]"},
              "nothing flows out of the fracture 'crack' at the side 'left', where the rock is open"},
        Input{"fractured.yaml",
              {"geometry.fractures.crack.points=[[0 m, 0.5 m], [0.7 m, 0.5 m]]",
               "components.conduit.boundary.left={closed: true}"},
              ""},
        Input{"fractured.yaml",
              {"geometry.fractures.crack.points=[[0 m, 0.5 m], [0.7 m, 0.5 m]]",
               "components.conduit.boundary.left={pressure: 0 Pa}"},
              ""},
        Input{"fractured.yaml", {"geometry.fractures.crack.points=[[0.3 m, 0.5 m], [1 m, 0.5 m]]"}, ""},
        Input{"fractured.yaml",
              {"geometry.fractures.crack.points=[[0 m, 0.5 m], [0.7 m, 0.5 m]]",
               "components.conduit.injection=", "components.conduit.prescribed.all={pressure: 1 MPa}"},
              ""},
        Input{"fractured.yaml",
              {"components.conduit.crossings.x={permeability: 1e-12 m^2}"},
              "'x' of 'conduit.crossings' has no effect (its fractures do not meet)"},
        Input{"fractured.yaml", with_seal({tight_seal}),
              "fluid of 'conduit' in the fracture 'crack' passes 'seal' at (0.5, 0.5) as if 'seal' had no walls"},
        Input{"fractured.yaml", with_seal({tight_seal, "components.conduit.crossings.x={through: seal}"}), ""},
        Input{"fractured.yaml", with_seal({"components.conduit.normal_permeability_value=1e-15 m/(Pa*s)"}), ""},
        Input{"fractured.yaml",
              {"couplers=[" + all_but_aperture + ", {type: wall_traction, between: [rock, contact, conduit]}]"},
              "the aperture in conduit stays what it is at the start, however far contact opens"},
        Input{"fractured.yaml",
              {"couplers=[" + all_but_aperture + ", {type: wall_traction, between: [rock, contact, conduit]}]",
               "components.conduit.transmissivity=constant", "components.conduit.transmissivity_value=1e-12 m^3"},
              ""},
        Input{"fractured.yaml",
              {"couplers=[" + all_but_aperture + ", {type: wall_traction, between: [rock, contact, conduit]}]",
               "components.conduit.prescribed.all={pressure: 1 MPa}", "components.conduit.injection="},
              ""},
        Input{"fractured.yaml",
              {"couplers=[" + all_but_aperture +
               ", {type: aperture, between: [contact, conduit]}, {type: wall_traction, between: [rock, contact]}]"},
              "the pressure of conduit does not push the walls of fractures apart"},
        Input{
            "fractured.yaml",
            {"geometry.regions={a: {polygon: [[0, 0], [0.2, 0], [0.2, 1], [0, 1]]}, b: {polygon: [[0.1, 0], [0.25, 0], "
             "[0.25, 0.3], [0.1, 0.3]]}}"},
            "regions 'a' and 'b' overlap in"},
        Input{"fractured.yaml", with_heat("[pore, heat]", "0.1 mm"), "the fluid of conduit carries no heat of water"},
        Input{"fractured.yaml", with_heat("[pore, conduit, heat, water]", "0.3 mm"),
              "the fracture 'crack' is 0.0003 m wide for its heat and 0.0001 m for its fluid"},
        Input{"fractured.yaml", with_heat("[pore, conduit, heat, water]", "0.1 mm"), ""},
        Input{"fractured.yaml", with_tips("[rock, tips]"), "walls that grow on the fine level carry no fluid pressure"},
        Input{"fractured.yaml", with_tips("[rock, tips, conduit]"), ""},
        Input{"fractured.yaml", with_tips("[rock, tips, conduit]", ""), "no step looks at the fractures of tips"},
        // Strains under an equal pressure: C^-1 (1, 1, 0) = (7, 41, 0)/431 GPa.
        Input{"rock.yaml",
              {"components.rock.young_modulus=null", "components.rock.poisson_ratio=null",
               "components.rock.bulk_modulus=10 GPa",
               "components.rock.stiffness={xxxx: 44 GPa, yyyy: 10 GPa, xxyy: 3 GPa, xyxy: 10 GPa, xxxy: 0 GPa, yyxy: 0 "
               "GPa}",
               "components.heat={type: matrix_heat/tpfa, conductivity: 2 W/(m*K), heat_capacity: 2e6 J/(m^3*K), "
               "initial_temperature: 300 K, boundary: {left: {temperature: 310 K}}}",
               "couplers=[{type: thermal_stress, between: [heat, rock], expansion: 1e-5 1/K}]",
               "schedule=[{solve: [rock, heat]}]"},
              "free rock expands 5.86 times as much along one axis"},
        Input{"fractured.yaml",
              {"components.conduit.transmissivity_value=1e-12 m^3"},
              "'transmissivity_value' of 'conduit' has no effect"},
        Input{"fractured.yaml",
              {"components.conduit.transmissivity_value=1e-12 m^3", "components.conduit.transmissivity=constant"},
              ""},
        Input{"fractured.yaml",
              {"couplers=[{type: biot, between: [pore, rock]}, {type: wall_traction, between: [rock, contact, "
               "conduit]}, {type: aperture, between: [contact, conduit]}]"},
              "no fluid flows between pore and conduit"},
        Input{"fractured.yaml",
              {"materials.young_modulus='(x < 0.3 ? 10e9 : 5e9) Pa'"},
              "the correction of displacements around 1 of 2 tips of fractures in 'rock' is switched off, the first at "
              "(0.3, 0.5) (the stiffness around it differs by more than 20 %)"},
        Input{"fractured.yaml", {"materials.young_modulus='(x < 0.3 ? 10e9 : 8.5e9) Pa'"}, ""},
        Input{
            "fractured.yaml",
            {"materials.permeability={xx: 1e-17 m^2, yy: 1e-18 m^2}"},
            "the correction of the flow around 2 of 2 tips of fractures in 'pore' is switched off, the first at (0.3, "
            "0.5) (the permeability is anisotropic)"},
        Input{"fractured.yaml", {"materials.permeability={xx: 1e-17 m^2, yy: 1e-17 m^2}"}, ""},
        Input{
            "fractured.yaml",
            {"materials.permeability='(x > 0.7 ? 2e-17 : 1e-17) m^2'"},
            "the correction of the flow around 1 of 2 tips of fractures in 'pore' is switched off, the first at (0.7, "
            "0.5) (the permeability around it differs by more than 20 %)"},
        // A fracture from side to side has no tip.
        Input{"fractured.yaml",
              {"materials.permeability={xx: 1e-17 m^2, yy: 1e-18 m^2}",
               "geometry.fractures.crack.points=[[0 m, 0.5 m], [1 m, 0.5 m]]",
               "components.conduit.boundary.left={pressure: 0 Pa}"},
              ""},
        Input{"fractured.yaml",
              {"components.heat={type: matrix_heat/mpfa, conductivity: 2 W/(m*K), heat_capacity: 2e6 J/(m^3*K)}",
               "couplers=[" + all_but_aperture +
                   ", {type: aperture, between: [contact, conduit]}, {type: wall_traction, between: [rock, contact, "
                   "conduit]}, {type: thermal_stress, between: [heat, rock], expansion: 8e-6 1/K}]",
               "schedule=[{solve: heat}, {solve: [pore, rock, conduit, contact]}]"},
              "the fluid of 'pore' keeps its volume when it is warmed"},
        Input{"fractured.yaml", {}, ""}));

TEST(InputNotesOfARun, WhatAPrescribedPressureLetsInIsCounted) {
  const Settings prescribed = {"components.conduit.prescribed.all={pressure: 1 MPa}"};
  const Ended given = run_of("fractured.yaml", prescribed);
  EXPECT_GT(given.result("fluid_injected[m^2]"), 0);
  EXPECT_NEAR(given.result("fluid_balance_error[m^2]"), 0, 1e-8 * given.result("fluid_injected[m^2]"));
  // 1e-9 m^2/s for an hour.
  const double injected = run_of("fractured.yaml", {}).result("fluid_injected[m^2]");
  EXPECT_NEAR(injected, 3.6e-6, 1e-18);
  // At a point the pressure lets in and out what it takes, and all that is injected counts.
  const Ended spread =
      run_of("fractured.yaml", {"components.conduit.injection.well={fracture: crack, rate: 1e-9 m^2/s}",
                                "components.conduit.injection.well.at=",
                                "components.conduit.prescribed.end={at: [0.69 m, 0.5 m], pressure: 0}"});
  EXPECT_NEAR(spread.result("conduit.well.rate[m^2/s]"), 1e-9, 1e-18);
  EXPECT_LT(spread.result("conduit.end.rate[m^2/s]"), 0);
  EXPECT_NEAR(spread.result("fluid_balance_error[m^2]"), 0, 1e-14);
}

}  // namespace
}  // namespace sprekk::testing
