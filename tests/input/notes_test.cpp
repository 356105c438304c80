// The notes of runs and checks: each with a scene that has the note, and one that has not.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/input/program.hpp"

namespace sprekk::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using Json = nlohmann::json;
using Settings = std::vector<std::string>;

std::string base(const std::string& name) { return std::string(SPREKK_SOURCE_DIR) + "/tests/input/base/" + name; }

std::vector<std::string> call(const std::string& command, const std::string& scene, const Settings& settings) {
  std::vector<std::string> arguments = {command, base(scene)};
  for (const std::string& setting : settings) arguments.insert(arguments.end(), {"--set", setting});
  return arguments;
}

std::string notes_of_check(const std::string& scene, const Settings& settings) {
  const Folder folder;
  const Outcome outcome = sprekk_command(call("check", scene, settings), folder.path());
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  return outcome.err;
}

struct Ended {
  Json record;
  std::string err;
  /// The note whose topic holds this, or null.
  Json note(const std::string& topic) const {
    for (const Json& note : record["notes"])
      if (note["topic"].get<std::string>().find(topic) != std::string::npos) return note;
    return nullptr;
  }
  double result(const std::string& name) const { return record["results"][name]; }
};

Ended run_of(const std::string& scene, const Settings& settings, const std::vector<std::string>& more = {}) {
  const Folder folder;
  std::vector<std::string> arguments = call("run", scene, settings);
  arguments.insert(arguments.end(), {"-q", "-o", "out", "--set", "output.fields=false"});
  arguments.insert(arguments.end(), more.begin(), more.end());
  const Outcome outcome = sprekk_command(arguments, folder.path());
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  return {Json::parse(text_of(folder / "out/run.json")), outcome.err};
}

// Input without effect

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

Settings with_tips(const std::string& between) {
  return {"components.tips={type: fine_fracture/quarter_point, size: 0.4 m}",
          "couplers=[" + all_but_aperture +
              ", {type: wall_traction, between: [rock, contact, conduit]}, {type: aperture, between: [contact, "
              "conduit]}, {type: two_level, between: " +
              between + "}]",
          "schedule=[{solve: [pore, rock, conduit, contact]}, {grow: tips, settle: [rock, contact]}]"};
}

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
        Input{"rock.yaml", {"components.rock.gravity=[0, -9.81 m/s^2]"}, "gravity has no effect on 'rock'"},
        Input{
            "rock.yaml", {"components.rock.gravity=[0, -9.81 m/s^2]", "components.rock.rock_density=2500 kg/m^3"}, ""},
        Input{"rock.yaml", {"components.rock.rock_density=2500 kg/m^3"}, "'rock_density' of 'rock' has no effect"},
        Input{"rock.yaml", {"components.rock.bulk_modulus=1 GPa"}, "'bulk_modulus' of 'rock' has no effect"},
        Input{"flow.yaml",
              {"components.pore.gravity=[0, -9.81 m/s^2]", "components.pore.fluid_density=0 kg/m^3"},
              "gravity has no effect on the flow of 'pore'"},
        Input{"flow.yaml", {"components.pore.gravity=[0, -9.81 m/s^2]"}, ""},
        Input{"flow.yaml", {"components.pore.porosity=0.1"}, "'porosity' of 'pore' has no effect"},
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
              "the pressure of 'conduit' on side 'right' has no effect (no fracture ends there)"},
        Input{"fractured.yaml",
              {"components.conduit.boundary.right={pressure: 1 MPa}",
               "geometry.fractures.crack.points=[[0.3 m, 0.5 m], [1 m, 0.5 m]]"},
              ""},
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
        Input{"fractured.yaml", with_tips("[rock, tips]"), "walls that grow on the fine level carry no fluid pressure"},
        Input{"fractured.yaml", with_tips("[rock, tips, conduit]"), ""},
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
              "'rock' takes displacements for linear around 1 of 2 tips of fractures, the first at (0.3, 0.5) (the "
              "stiffness around it differs by more than 20 %)"},
        Input{"fractured.yaml", {"materials.young_modulus='(x < 0.3 ? 10e9 : 8.5e9) Pa'"}, ""},
        Input{"fractured.yaml",
              {"materials.permeability={xx: 1e-17 m^2, yy: 1e-18 m^2}"},
              "'pore' takes the pressure for linear around 2 of 2 tips of fractures, the first at (0.3, 0.5) (the "
              "permeability is anisotropic)"},
        Input{"fractured.yaml", {"materials.permeability={xx: 1e-17 m^2, yy: 1e-17 m^2}"}, ""},
        Input{"fractured.yaml",
              {"materials.permeability='(x > 0.7 ? 2e-17 : 1e-17) m^2'"},
              "'pore' takes the pressure for linear around 1 of 2 tips of fractures, the first at (0.7, 0.5) (the "
              "permeability around it differs by more than 20 %)"},
        // A fracture from side to side has no tip.
        Input{"fractured.yaml",
              {"materials.permeability={xx: 1e-17 m^2, yy: 1e-18 m^2}",
               "geometry.fractures.crack.points=[[0 m, 0.5 m], [1 m, 0.5 m]]"},
              ""},
        Input{"fractured.yaml", {}, ""}));

TEST(Notes, OfTheInputAreShownByARunAtItsStartAndAtItsEnd) {
  const Folder folder;
  std::vector<std::string> arguments = call("run", "flow.yaml", {"components.pore.porosity=0.1"});
  arguments.insert(arguments.end(), {"-o", "out"});
  const Outcome outcome = sprekk_command(arguments, folder.path());
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const std::string text = "note: ";
  const std::size_t first = outcome.err.find(text), step = outcome.err.find(" %  step 1"),
                    last = outcome.err.rfind("'porosity' of 'pore' has no effect");
  EXPECT_LT(first, step);
  EXPECT_LT(step, last);
  const Json notes = Json::parse(text_of(folder / "out/run.json"))["notes"];
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_EQ(notes[0]["steps"], 0);
}

TEST(Notes, InjectionIntoAPrescribedPressureIsNotCounted) {
  const Settings prescribed = {"components.conduit.prescribed.all={pressure: 1 MPa}"};
  EXPECT_EQ(run_of("fractured.yaml", prescribed).result("fluid_injected[m^2]"), 0);
  // 1e-9 m^2/s for an hour.
  const double injected = run_of("fractured.yaml", {}).result("fluid_injected[m^2]");
  EXPECT_NEAR(injected, 3.6e-6, 1e-18);
  // Of an injection that is spread over the fracture, the share of its last cell of four is lost.
  const Ended spread =
      run_of("fractured.yaml", {"components.conduit.injection.well={fracture: crack, rate: 1e-9 m^2/s}",
                                "components.conduit.injection.well.at=",
                                "components.conduit.prescribed.end={at: [0.69 m, 0.5 m], pressure: 0}"});
  EXPECT_NEAR(spread.result("fluid_injected[m^2]"), 3.6e-6 * 3 / 4, 1e-12);
}

// The state

TEST(Notes, APressureThatFallsBelowZeroIsToldWithPlaceAndSize) {
  // Without storage p = 1 MPa − q (mu/k) (1 − x), with mu/k = 1e11 Pa s/m^2. The centres next to the left side are at
  // x = 1/12 m: −2.93 MPa.
  const Settings begins = {"components.pore.initial_pressure=1 MPa", "components.pore.storage=0 1/Pa"};
  Settings drained = begins, gentle = begins, any_level = {"components.pore.storage=0 1/Pa"};
  const std::string flux = "components.pore.boundary.left.flux=";
  drained.push_back(flux + "(3.93/11*12*1e-5) m/s");
  any_level.push_back(flux + "(3.93/11*12*1e-5) m/s");
  gentle.push_back(flux + "1e-6 m/s");
  const Ended run = run_of("flow.yaml", drained);
  const Json note = run.note("pressure below zero");
  ASSERT_FALSE(note.is_null());
  EXPECT_THAT(note["text"].get<std::string>(), HasSubstr("falls to -2.93e+06 Pa at (0.0833333, "));
  EXPECT_EQ(note["steps"], 2);
  EXPECT_EQ(note["first_time"], 1800);
  EXPECT_EQ(note["last_time"], 3600);
  EXPECT_THAT(run.err, HasSubstr("note: pore.pressure falls to"));  // in spite of -q
  EXPECT_EQ(run_of("flow.yaml", gentle).record["notes"].size(), 0U);
  // From a start at 0 Pa the constant in the pressure is not known.
  EXPECT_TRUE(run_of("flow.yaml", any_level).note("pressure below zero").is_null());
}

TEST(Notes, APressureBeyondEveryLoadIsTold) {
  const Settings fast = {"components.pore.storage=0 1/Pa", "components.pore.boundary.left.flux=-1 m/s"};  // 1e11 Pa/m
  EXPECT_FALSE(run_of("flow.yaml", fast).note("beyond every load").is_null());
  EXPECT_TRUE(run_of("flow.yaml", {}).note("beyond every load").is_null());
}

TEST(Notes, WallsThatOverlapByMoreThanTheApertureAreTold) {
  const auto note = [](const char* factor) {
    return run_of("fractured.yaml", {"components.conduit.initial_aperture=0.01 mm", "materials.permeability=1e-12 m^2",
                                     "components.contact={type: contact/penalty, friction: 0.5, stiffness_factor: " +
                                         std::string(factor) + "}"})
        .note("aperture below zero");
  };
  EXPECT_FALSE(note("1e-3").is_null());
  EXPECT_TRUE(note("100").is_null());
}

TEST(Notes, TrianglesOfFirstOrderInIncompressibleRockAreTold) {
  const auto notes = [](const std::string& order, const std::string& poisson) {
    return notes_of_check("rock.yaml", {"components.rock.type=poromechanics/fem", "components.rock.order=" + order,
                                        "components.rock.poisson_ratio=" + poisson, "mesh={size: 0.3 m}"});
  };
  EXPECT_THAT(notes("first", "0.46"), HasSubstr("nearly incompressible"));
  EXPECT_THAT(notes("first", "0.44"), Not(HasSubstr("nearly incompressible")));
  EXPECT_THAT(notes("second", "0.499"), Not(HasSubstr("nearly incompressible")));
}

/// Rock that conducts 10,000 times better at 30 degrees to the x axis than across; `mirrored`: at -30 degrees.
std::string anisotropic(bool mirrored = false) {
  return std::string("components.pore.permeability={xx: 7.50025e-14 m^2, yy: 2.50075e-14 m^2, xy: ") +
         (mirrored ? "-" : "") + "4.32969e-14 m^2}";
}

TEST(Notes, APressureBeyondItsSurroundingsIsTold) {
  // Sides at 0 and a band at 1 MPa that spreads: what is not between them is wrong.
  const Settings band = {"components.pore.boundary.left.flux=",
                         "components.pore.boundary.left.pressure=0 MPa",
                         "components.pore.boundary.right.pressure=0 MPa",
                         "components.pore.initial_pressure='(abs(y - 0.4) < 0.15 ? 1 : 0) MPa'",
                         "mesh={size: 0.12 m}",
                         "time={step: 0.1 s, end: 0.1 s}"};
  const auto note = [&](const std::string& flux, const Settings& rock) {
    Settings settings = band;
    settings.push_back("components.pore.type=matrix_flow/" + flux);
    settings.insert(settings.end(), rock.begin(), rock.end());
    return run_of("flow.yaml", settings).note("pressure beyond its surroundings");
  };
  for (const bool mirrored : {false, true}) {
    const Json told = note("mpfa", {anisotropic(mirrored)});
    ASSERT_FALSE(told.is_null());
    EXPECT_THAT(told["text"].get<std::string>(), HasSubstr("cells without a source, by up to"));
    EXPECT_TRUE(note("tpfa", {anisotropic(mirrored)}).is_null());  // which keeps bounds
  }
  EXPECT_TRUE(note("mpfa", {}).is_null());
}

TEST(Notes, FluxesThatAreNotExactAreTold) {
  // Triangles lose energy whatever the rock is, quadrilaterals in ordinary rock.
  const auto note = [](const std::string& shape, const Settings& rock) {
    Settings settings = {"components.pore.type=matrix_flow/mpfa",
                         "mesh={kind: structured, cells: [4, 4], distortion: 0.4, shape: " + shape + "}"};
    settings.insert(settings.end(), rock.begin(), rock.end());
    return run_of("flow.yaml", settings).note("not exact for linear pressures");
  };
  for (const bool mirrored : {false, true}) {
    const Json told = note("quadrilaterals", {anisotropic(mirrored)});
    ASSERT_FALSE(told.is_null());
    EXPECT_THAT(told["text"].get<std::string>(), HasSubstr("use triangles"));
    EXPECT_TRUE(note("triangles", {anisotropic(mirrored)}).is_null());
  }
  EXPECT_TRUE(note("quadrilaterals", {}).is_null());
}

TEST(Notes, ASmallAngleOfTheMeshIsTold) {
  // Fractures that cross at an angle leave a mesh no larger one there.
  const auto note = [](const std::string& angle) {
    return run_of("fractured.yaml",
                  {"geometry.fractures.other={center: [0.5 m, 0.5 m], length: 0.3 m, angle: " + angle + "}"})
        .note("small angle of the mesh");
  };
  for (const char* angle : {"3 deg", "-3 deg"}) {
    const Json told = note(angle);
    ASSERT_FALSE(told.is_null()) << angle;
    const std::string text = told["text"], before = "the mesh has an angle of ";
    ASSERT_EQ(text.find(before), 0U) << text;
    EXPECT_LE(std::stod(text.substr(before.size())), 3) << text;
  }
  EXPECT_TRUE(note("30 deg").is_null());
}

TEST(Notes, FracturesThatMeetAtASmallAngleAreNamed) {
  const auto note = [](const std::string& angle) {
    return run_of("fractured.yaml",
                  {"geometry.fractures.other={center: [0.5 m, 0.5 m], length: 0.3 m, angle: " + angle + "}"})
        .note("small angle between fractures");
  };
  for (const char* angle : {"3 deg", "-3 deg"}) {
    const Json told = note(angle);
    ASSERT_FALSE(told.is_null()) << angle;
    EXPECT_THAT(told["text"].get<std::string>(), HasSubstr("'crack', 'other' meet at 3 degrees at (0.5, 0.5)"));
  }
  EXPECT_TRUE(note("6 deg").is_null());
}

TEST(Notes, APocketOfFewCellsIsTold) {
  const auto note = [](const std::string& size) {
    return run_of("fractured.yaml", {"geometry.fractures={crack: {points: [[0.3 m, 0.4 m], [0.7 m, 0.4 m]]}, "
                                     "b: {points: [[0.4 m, 0.35 m], [0.55 m, 0.65 m]]}, "
                                     "c: {points: [[0.62 m, 0.35 m], [0.47 m, 0.65 m]]}}",
                                     "components.conduit.injection.well.at=[0.5 m, 0.4 m]",
                                     "mesh={size: 0.2 m, fracture_size: " + size + "}"})
        .note("small pocket between fractures");
  };
  const Json told = note("0.1 m");
  ASSERT_FALSE(told.is_null());
  EXPECT_THAT(told["text"].get<std::string>(),
              ::testing::AllOf(HasSubstr("fractures 'crack', 'b', 'c' enclose 0.0"), HasSubstr("fracture_size")));
  EXPECT_TRUE(note("0.02 m").is_null());
}

TEST(Notes, APorePressureOfTwiceTheLoadsIsTold) {
  // A side that is held at 1 MPa, the load, or at 2 MPa, a pressure that is given; and a well that brings 1 GPa.
  const std::string well = "components.pore.wells.feed={at: [0.5 m, 0.2 m], rate: ";
  const Ended beyond = run_of("fractured.yaml", {well + "1e-6 m^2/s}"});
  EXPECT_FALSE(beyond.note("beyond the loads").is_null());
  EXPECT_TRUE(
      run_of("fractured.yaml", {"components.pore.boundary.left.pressure=2 MPa"}).note("beyond the loads").is_null());
}

TEST(Notes, LargeStrainsAreTold) {
  // Uniaxial plane strain: (1 − nu^2)/E = 0.9375e-10 1/Pa of the load.
  const Ended large = run_of("rock.yaml", {"components.rock.boundary.top.normal_stress=-200 MPa"});
  const Json note = large.note("large strain");
  ASSERT_FALSE(note.is_null());
  EXPECT_THAT(note["text"].get<std::string>(), HasSubstr("changes by 0.0188 of the distance"));
  EXPECT_TRUE(
      run_of("rock.yaml", {"components.rock.boundary.top.normal_stress=-100 MPa"}).note("large strain").is_null());
}

TEST(Notes, AScenesOwnBoundForStrainsIsTaken) {
  // 0.0094 under 100 MPa and 0.0188 under 200 MPa, as above.
  const auto note = [](const std::string& load, const std::string& bound) {
    return run_of("rock.yaml",
                  {"components.rock.boundary.top.normal_stress=" + load, "components.rock.large_strain=" + bound})
        .note("large strain");
  };
  EXPECT_TRUE(note("-200 MPa", "0.019").is_null());
  EXPECT_THAT(note("-200 MPa", "0.018")["text"].get<std::string>(), HasSubstr("strains over 0.018 are large"));
  EXPECT_FALSE(note("-100 MPa", "0.9 %").is_null());
}

/// A fracture of 0.4 m in rock that nothing else loads, blown up to `pressure` from inside.
Settings blown_up(const std::string& pressure) {
  return {"components.conduit.injection=", "components.conduit.initial_pressure=" + pressure,
          "components.conduit.prescribed.all={pressure: " + pressure + "}", "materials.biot_coefficient=0",
          "components.rock.boundary.top.normal_stress=0 MPa"};
}

TEST(Notes, LargeJumpsAreTold) {
  // In an infinite rock the crack opens by 4 p l (1 − nu^2)/E with l = 0.2 m, here somewhat more.
  const Ended small = run_of("fractured.yaml", blown_up("10 MPa")),
              large = run_of("fractured.yaml", blown_up("200 MPa"));
  EXPECT_TRUE(small.note("large jump").is_null());
  ASSERT_FALSE(large.note("large jump").is_null());
  EXPECT_THAT(large.note("large jump")["text"].get<std::string>(), HasSubstr("fracture 'crack'"));
  EXPECT_FALSE(large.note("large strain").is_null());
  // 15 mm in an infinite rock, 0.0375 of the length.
  Settings own = blown_up("200 MPa");
  own.push_back("components.contact.large_jump=0.2");
  EXPECT_TRUE(run_of("fractured.yaml", own).note("large jump").is_null());
}

TEST(Notes, AFractureThatHasOpenedAltogetherIsTold) {
  // The load of 1 MPa closes the fracture; the pressure of its fluid rises to 2 MPa, or to 0.5 MPa.
  const auto pressed_open = [](const std::string& pressure) {
    return Settings{"components.conduit.injection=", "components.conduit.prescribed.all={pressure: " + pressure + "}",
                    "couplers=[{type: wall_traction, between: [rock, contact, conduit]}, {type: aperture, between: "
                    "[contact, conduit]}, {type: wall_exchange, between: [pore, conduit]}]",
                    "materials.biot_coefficient="};
  };
  const Ended opened = run_of("fractured.yaml", pressed_open("(2*t/3600) MPa"));
  EXPECT_EQ(opened.result("contact.cells_open[1]"), 4);
  const Json note = opened.note("all open");
  ASSERT_FALSE(note.is_null());
  EXPECT_GT(note["first_time"], 600);
  EXPECT_TRUE(run_of("fractured.yaml", pressed_open("(0.5*t/3600) MPa")).note("all open").is_null());
  // Without a load the fracture is open from the start, as it is meant to be.
  EXPECT_TRUE(run_of("fractured.yaml", blown_up("1 MPa")).note("all open").is_null());
}

TEST(Notes, SuctionInAFractureIsTold) {
  const std::string well = "components.conduit.injection.well.rate=";
  const Ended sucked = run_of("fractured.yaml", {well + "-1e-8 m^2/s"});
  ASSERT_FALSE(sucked.note("suction").is_null());
  EXPECT_THAT(sucked.note("suction")["text"].get<std::string>(), HasSubstr("pulls the walls"));
  EXPECT_TRUE(run_of("fractured.yaml", {}).note("suction").is_null());
}

TEST(Notes, GoOnWithARestart) {
  const Folder folder;
  const Settings scene = {"components.pore.initial_pressure=1 MPa", "components.pore.storage=0 1/Pa",
                          "components.pore.boundary.left.flux=1e-4 m/s", "output.fields=false"};
  const auto run = [&](const std::string& out, const std::vector<std::string>& more) {
    std::vector<std::string> arguments = call("run", "flow.yaml", scene);
    arguments.insert(arguments.end(), {"-q", "-o", out});
    arguments.insert(arguments.end(), more.begin(), more.end());
    ASSERT_EQ(sprekk_command(arguments, folder.path()).code, 0);
  };
  run("whole", {});
  run("parts", {"--set", "time.end=30 min"});
  run("parts", {"--restart"});
  const auto notes = [&](const std::string& out) {
    return Json::parse(text_of(folder / (out + "/run.json")))["notes"];
  };
  ASSERT_EQ(notes("whole").size(), 1U);
  EXPECT_EQ(notes("whole"), notes("parts"));
}

TEST(Notes, AreOnThePageOfARunBeforeItsFigures) {
  const Folder folder;
  std::vector<std::string> arguments = call("run", "rock.yaml", {"components.rock.boundary.top.normal_stress=-1 GPa"});
  arguments.insert(arguments.end(), {"-q", "-o", "out"});
  ASSERT_EQ(sprekk_command(arguments, folder.path()).code, 0);
  ASSERT_EQ(sprekk_command({"report", "out"}, folder.path()).code, 0);
  const std::string page = text_of(folder / "out/report.html");
  const std::size_t note = page.find("of the distance at");
  ASSERT_NE(note, std::string::npos);
  EXPECT_LT(note, page.find("mesh at the start"));
}

// Ends before the end

TEST(Stop, IsTheReasonOfTheEnd) {
  const Folder folder;
  std::vector<std::string> arguments =
      call("run", "fractured.yaml", {"time.stop={of: fluid_injected, reaches: 1e-6 m^2}"});
  arguments.insert(arguments.end(), {"-o", "out"});
  const Outcome outcome = sprekk_command(arguments, folder.path());
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const Json record = Json::parse(text_of(folder / "out/run.json"));
  EXPECT_EQ(record["exit"]["reason"], "stopped: fluid_injected has reached 1e-6 m^2");
  EXPECT_EQ(record["counters"]["steps accepted"], 2);  // 0.6e-6 m^2 each
  EXPECT_THAT(outcome.err, HasSubstr("ended after step 2 at t = 20 min 0 s: fluid_injected has reached 1e-6 m^2"));
}

TEST(Stop, ThatIsNotReachedIsTold) {
  const Ended run = run_of("fractured.yaml", {"time.stop={of: fluid_injected, reaches: 1 m^2}"});
  EXPECT_EQ(run.record["exit"]["reason"], "done");
  EXPECT_THAT(run.note("time.stop")["text"].get<std::string>(), HasSubstr("has not reached 1 m^2"));
}

}  // namespace
}  // namespace sprekk::testing
