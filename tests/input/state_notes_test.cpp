// Notes on the state of a run: each with a scene that has the note, and one that has not.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/input/notes.hpp"

namespace sprekk::testing {
namespace {

using ::testing::HasSubstr;

TEST(StateNotes, APressureThatFallsBelowZeroIsToldWithPlaceAndSize) {
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

TEST(StateNotes, APressureBeyondEveryLoadIsTold) {
  const Settings fast = {"components.pore.storage=0 1/Pa", "components.pore.boundary.left.flux=-1 m/s"};  // 1e11 Pa/m
  EXPECT_FALSE(run_of("flow.yaml", fast).note("beyond every load").is_null());
  EXPECT_TRUE(run_of("flow.yaml", {}).note("beyond every load").is_null());
}

TEST(StateNotes, APorePressureOfTwiceTheLoadsIsTold) {
  // A side that is held at 1 MPa, the load, or at 2 MPa, a pressure that is given; and a well that brings 1 GPa.
  const std::string well = "components.pore.wells.feed={at: [0.5 m, 0.2 m], rate: ";
  const Ended beyond = run_of("fractured.yaml", {well + "1e-6 m^2/s}"});
  EXPECT_FALSE(beyond.note("beyond the loads").is_null());
  EXPECT_TRUE(
      run_of("fractured.yaml", {"components.pore.boundary.left.pressure=2 MPa"}).note("beyond the loads").is_null());
}

TEST(StateNotes, WallsThatOverlapByMoreThanTheApertureAreTold) {
  const auto note = [](const char* factor) {
    return run_of("fractured.yaml", {"components.conduit.initial_aperture=0.01 mm", "materials.permeability=1e-12 m^2",
                                     "components.contact={type: contact/penalty, friction: 0.5, stiffness_factor: " +
                                         std::string(factor) + "}"})
        .note("aperture below zero");
  };
  EXPECT_FALSE(note("1e-3").is_null());
  EXPECT_TRUE(note("100").is_null());
}

// A crack at 45 degrees slides under a vertical load; the softer the springs of a penalty, the more of its slip is
// theirs. Where it sticks there is no such note.
TEST(StateNotes, SlipOfSpringsIsTold) {
  const auto note = [](const std::string& contact, const std::string& friction) {
    return run_of("fractured.yaml", {"geometry.fractures.crack.points=[[0.35 m, 0.35 m], [0.65 m, 0.65 m]]",
                                     "components.contact={type: contact/" + contact + ", friction: " + friction + "}"})
        .note("slips by springs");
  };
  const Json soft = note("penalty, stiffness_factor: 2", "0.6");
  ASSERT_FALSE(soft.is_null());
  EXPECT_THAT(soft["text"].get<std::string>(), HasSubstr("raise 'stiffness_factor'"));
  EXPECT_TRUE(note("penalty, stiffness_factor: 1e4", "0.6").is_null());
  EXPECT_TRUE(note("penalty, stiffness_factor: 2", "2").is_null());
  EXPECT_TRUE(note("coulomb", "0.6").is_null());
}

TEST(StateNotes, LargeStrainsAreTold) {
  // Uniaxial plane strain: (1 − nu^2)/E = 0.9375e-10 1/Pa of the load.
  const Ended large = run_of("rock.yaml", {"components.rock.boundary.top.normal_stress=-200 MPa"});
  const Json note = large.note("large strain");
  ASSERT_FALSE(note.is_null());
  EXPECT_THAT(note["text"].get<std::string>(), HasSubstr("changes by 0.0188 of the distance"));
  EXPECT_TRUE(
      run_of("rock.yaml", {"components.rock.boundary.top.normal_stress=-100 MPa"}).note("large strain").is_null());
}

TEST(StateNotes, AScenesOwnBoundForStrainsIsTaken) {
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

TEST(StateNotes, LargeJumpsAreTold) {
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

TEST(StateNotes, AFractureThatHasOpenedAltogetherIsTold) {
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

TEST(StateNotes, SuctionInAFractureIsTold) {
  const std::string well = "components.conduit.injection.well.rate=";
  const Ended sucked = run_of("fractured.yaml", {well + "-1e-8 m^2/s"});
  ASSERT_FALSE(sucked.note("suction").is_null());
  EXPECT_THAT(sucked.note("suction")["text"].get<std::string>(), HasSubstr("pulls the walls"));
  EXPECT_TRUE(run_of("fractured.yaml", {}).note("suction").is_null());
}

}  // namespace
}  // namespace sprekk::testing
