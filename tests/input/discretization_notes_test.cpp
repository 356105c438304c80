// Notes on meshes and discretizations: each with a scene that has the note, and one that has not.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/input/notes.hpp"

namespace sprekk::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

/// Rock that conducts 10,000 times better at 30 degrees to the x axis than across; `mirrored`: at -30 degrees.
std::string anisotropic(bool mirrored = false) {
  return std::string("components.pore.permeability={xx: 7.50025e-14 m^2, yy: 2.50075e-14 m^2, xy: ") +
         (mirrored ? "-" : "") + "4.32969e-14 m^2}";
}

TEST(DiscretizationNotes, APressureBeyondItsSurroundingsIsTold) {
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

TEST(DiscretizationNotes, FluxesThatAreNotExactAreTold) {
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

TEST(DiscretizationNotes, ASmallAngleOfTheMeshIsTold) {
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

TEST(DiscretizationNotes, FlatCellsTellBetweenWhichFracturesTheyLie) {
  // Parallel lines 1e-5 m apart: along x, along y, the mirror image of the first, and along a line between.
  const auto fractured = [](const std::string& crack, const std::string& other) {
    return run_of("fractured.yaml", {"geometry.snap=0 m", "geometry.fractures.crack.points=" + crack,
                                     "geometry.fractures.other={points: " + other + "}"});
  };
  const auto told = [&](const std::string& crack, const std::string& other) {
    const Json note = fractured(crack, other).note("small angle of the mesh");
    return note.is_null() ? std::string() : note["text"].get<std::string>();
  };
  const char* between = "between fractures 'crack' and 'other', which are 1e-05 m apart there";
  EXPECT_THAT(told("[[0.3 m, 0.5 m], [0.7 m, 0.5 m]]", "[[0.3 m, 0.50001 m], [0.7 m, 0.50001 m]]"), HasSubstr(between));
  EXPECT_THAT(told("[[0.5 m, 0.3 m], [0.5 m, 0.7 m]]", "[[0.50001 m, 0.3 m], [0.50001 m, 0.7 m]]"), HasSubstr(between));
  EXPECT_THAT(told("[[0.3 m, 0.5 m], [0.7 m, 0.5 m]]", "[[0.3 m, 0.49999 m], [0.7 m, 0.49999 m]]"), HasSubstr(between));
  EXPECT_THAT(told("[[0.3 m, 0.3 m], [0.7 m, 0.6 m]]", "[[0.299994 m, 0.300008 m], [0.699994 m, 0.600008 m]]"),
              HasSubstr(between));
  EXPECT_THAT(told("[[0.3 m, 0.5 m], [0.7 m, 0.5 m]]", "[[0.3 m, 0.6 m], [0.7 m, 0.6 m]]"), Not(HasSubstr("apart")));
}

TEST(DiscretizationNotes, CellsTooFlatForMpsaAreRefusedWithTheirPlace) {
  // Lines that cross at 2e-5 rad in (1, 1) m: as given, turned by 90 degrees, and turned by 37 degrees.
  const struct {
    const char *crack, *other, *place;
  } crossings[] = {
      {"[[0.5 m, 1 m], [1.5 m, 1 m]]", "[[0.5 m, 0.99999 m], [1.5 m, 1.00001 m]]", "at (0.96"},
      {"[[1 m, 0.5 m], [1 m, 1.5 m]]", "[[1.00001 m, 0.5 m], [0.99999 m, 1.5 m]]", "at (1, 0.96"},
      {"[[0.600682245 m, 0.699092489 m], [1.399317755 m, 1.300907511 m]]",
       "[[0.600688263 m, 0.699084502 m], [1.399311737 m, 1.300915498 m]]", "at (0.97"},
  };
  for (const auto& crossing : crossings) {
    const Folder folder;
    const Outcome outcome =
        sprekk_command(call("run", "fractured.yaml",
                            {"geometry.snap=0 m", "geometry.box={x: [0 m, 2 m], y: [0 m, 2 m]}",
                             "mesh={size: 0.2 m, fracture_size: 50 mm}",
                             std::string("geometry.fractures.crack.points=") + crossing.crack,
                             std::string("geometry.fractures.other={points: ") + crossing.other + "}",
                             "components.conduit.injection.well.at=[1 m, 1 m]"}),
                       folder.path());
    EXPECT_EQ(outcome.code, 1) << crossing.crack;
    EXPECT_THAT(outcome.err, AllOf(HasSubstr(std::string("the mesh has an angle of 0.00057 degrees ") + crossing.place),
                                   HasSubstr("between fractures 'crack' and 'other', which are "),
                                   HasSubstr("move lines apart, join them, or let them meet at a larger angle")));
  }
}

TEST(DiscretizationNotes, FracturesThatMeetAtASmallAngleAreNamed) {
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

TEST(DiscretizationNotes, APocketOfFewCellsIsTold) {
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

}  // namespace
}  // namespace sprekk::testing
