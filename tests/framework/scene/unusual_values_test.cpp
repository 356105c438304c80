// Notes on values that no rock, fracture or fluid has.
#include "framework/scene/unusual_values.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <set>

#include "framework/config/yaml/load_scene.hpp"
#include "framework/config/yaml/parse_yaml.hpp"

namespace sprekk {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// A fractured scene with these materials, and further entries of components in place of usual ones.
std::string scene_with(const std::string& materials, const std::string& conduit = "initial_aperture: 0.1 mm",
                       const std::string& fracture = "points: [[0.3, 0.5], [0.7, 0.5]]") {
  return "geometry: {box: {x: [0, 1], y: [0, 1]}, fractures: {crack: {" + fracture +
         "}}, regions: {core: {polygon: [[0, 0], [0.2, 0], [0.2, 0.2]]}}}\nmaterials: {" + materials +
         "}\ncomponents:\n  pore: {type: matrix_flow/mpfa}\n  rock: {type: poromechanics/mpsa}\n  conduit: {type: "
         "fracture_flow/tpfa, " +
         conduit +
         "}\n  contact: {type: contact/coulomb}\nschedule: [{solve: [pore, rock, conduit, contact]}]\ntime: {end: 1 s, "
         "step: 1 s}\n";
}

std::vector<std::string> notes_of(const std::string& text) {
  const Scene scene = read_scene(parse_yaml(text, "s.yaml"), ".", "scene");
  Notes found;
  note_unusual_values(properties_of(scene), found);
  std::vector<std::string> notes;
  for (const Notes::Note& note : found.all()) notes.push_back(note.text);
  return notes;
}

const char* const usual =
    "young_modulus: 10 GPa, poisson_ratio: 0.25, porosity: 0.05, fluid_compressibility: 4e-10 1/Pa, permeability: "
    "1e-17 "
    "m^2, viscosity: 1 mPa*s, friction: 0.6, dilation_angle: 5 deg";

/// The usual materials with another value of one.
std::string but(const std::string& name, const std::string& value) {
  std::string text = usual;
  const std::size_t begin = text.find(name + ": ") + name.size() + 2;
  return text.replace(begin, std::min(text.find(',', begin), text.size()) - begin, value);
}

struct Slip {
  const char *name, *value, *advice;
};
void PrintTo(const Slip& slip, std::ostream* text) { *text << slip.name << ": " << slip.value; }

class Slips : public testing::TestWithParam<Slip> {};

TEST_P(Slips, AreTold) {
  const auto& [name, value, advice] = GetParam();
  const std::vector<std::string> notes = notes_of(scene_with(but(name, value)));
  ASSERT_EQ(notes.size(), 1U) << testing::PrintToString(notes);
  EXPECT_THAT(notes.front(),
              AllOf(testing::StartsWith("s.yaml:2:"),
                    HasSubstr(fmt::format("'{}' is '{}' (as a rule it is from", name, value)), HasSubstr(advice)));
}

INSTANTIATE_TEST_SUITE_P(all, Slips,
                         testing::Values(Slip{"young_modulus", "2e19 Pa", "check its unit and its power of ten"},
                                         Slip{"young_modulus", "40 Pa", "did you mean '40 MPa' or '40 GPa'?"},
                                         Slip{"friction", "50", "check its unit and its power of ten"},
                                         Slip{"dilation_angle", "80 deg", "check its unit"},
                                         Slip{"permeability", "1e-3 m^2", "did you mean '1e-3 um^2'"},
                                         Slip{"permeability", "100 MD", "did you mean '100 mD'"},
                                         Slip{"fluid_compressibility", "0.45 1/Pa", "check its unit"},
                                         Slip{"viscosity", "1 Pa*s", "did you mean '1 mPa*s'?"},
                                         Slip{"young_modulus", "(10 + y) Pa", "check its unit"},
                                         Slip{"porosity", "1e-7", "check its unit"}));

TEST(UnusualValues, AreFoundInEveryFormOfADatum) {
  const auto values_of = [](const std::string& permeability) {
    std::vector<double> values;
    const Scene scene = read_scene(parse_yaml(scene_with(but("permeability", permeability)), "s.yaml"), ".", "scene");
    for (const PropertyValue& property : properties_of(scene))
      if (property.name == "permeability") values.push_back(property.value);
    return values;
  };
  EXPECT_THAT(values_of("1e-17 m^2"), ElementsAre(1e-17));
  EXPECT_THAT(values_of("(1e-17*(1 + 1e12*x)) m^2"), ElementsAre(1e-17 * (1 + 1e12)));
  EXPECT_THAT(values_of("{regions: {core: 1e-17 m^2, default: 1e-3 m^2}}"), ElementsAre(1e-17, 1e-3));
  EXPECT_THAT(values_of("{xx: 2e-17 m^2, yy: 1e-17 m^2, xy: 0}"), ElementsAre(2e-17, 1e-17));
  EXPECT_THAT(values_of("[{value: 1e-17 m^2, to: 1 h}, {value: 2e-17 m^2, from: 1 h}]"), ElementsAre(1e-17, 2e-17));
}

TEST(UnusualValues, AreToldOfAperturesAndAngles) {
  EXPECT_THAT(
      notes_of(scene_with(usual, "initial_aperture: 2 m")),
      ElementsAre(AllOf(HasSubstr("'initial_aperture' is '2 m'"), HasSubstr("did you mean '2 um' or '2 mm'?"))));
  EXPECT_THAT(notes_of(scene_with(usual, "initial_aperture: {fractures: {crack: 2 m}}")),
              ElementsAre(HasSubstr("'initial_aperture' is '2 m'")));
  EXPECT_THAT(notes_of(scene_with(usual, "initial_aperture: 0.1 mm", "center: [0.5, 0.5], length: 0.4, angle: 65 rad")),
              ElementsAre(AllOf(HasSubstr("'angle' is '65 rad'"), HasSubstr("did you mean '65 deg'?"))));
  const auto notes = notes_of(scene_with(but("permeability", "{along: 2e-17 m^2, across: 1e-17 m^2, angle: 65 rad}")));
  EXPECT_THAT(notes, ElementsAre(HasSubstr("'permeability.angle' is '65 rad'")));
}

TEST(UnusualValues, HaveOneNoteInASceneWithoutDimensions) {
  const char* const of_order_one =
      "young_modulus: 1 Pa, poisson_ratio: 0.25, porosity: 0.5, fluid_compressibility: 1 1/Pa, permeability: 1 m^2, "
      "viscosity: 1 Pa*s, friction: 0.6, dilation_angle: 5 deg";
  EXPECT_THAT(notes_of(scene_with(of_order_one)),
              ElementsAre(HasSubstr("the scene is taken for one without dimensions")));
  // What has no dimension anyhow keeps its own note.
  EXPECT_THAT(notes_of(scene_with(std::string(of_order_one).replace(std::string(of_order_one).find("0.6"), 3, "60"))),
              testing::UnorderedElementsAre(HasSubstr("without dimensions"), HasSubstr("'friction' is '60'")));
}

/// Published sets of parameters.
TEST(UnusualValues, AreNotFoundInTheTablesOfPapers) {
  const std::string sets[] = {
      // Dang-Trung et al. 2022, Table 1.
      "young_modulus: 40 GPa, poisson_ratio: 0.2, porosity: 0.01, fluid_compressibility: 4e-10 1/Pa, permeability: "
      "5e-20 "
      "m^2, viscosity: 1e-4 Pa*s, friction: 0.5, dilation_angle: 1 deg",
      // Flemisch et al. 2018, their case 4 (a network at Sotra), in rock.
      "young_modulus: 10 GPa, poisson_ratio: 0.25, porosity: 0.1, fluid_compressibility: 0 1/Pa, permeability: 1e-14 "
      "m^2, "
      "viscosity: 1e-3 Pa*s, friction: 0.6, dilation_angle: 0 deg",
      // Harris et al. 2009, TPV5: 2670 kg/m^3, 6000 and 3464 m/s, friction 0.677.
      "young_modulus: 80.1 GPa, poisson_ratio: 0.25, porosity: 0 %, fluid_compressibility: 0 1/Pa, permeability: 0 "
      "m^2, "
      "viscosity: 1 mPa*s, friction: 0.677, dilation_angle: 0 deg",
      // Rutqvist et al. 2013: a fault in shale.
      "young_modulus: 30 GPa, poisson_ratio: 0.2, porosity: 0.01, fluid_compressibility: 4.5e-10 1/Pa, permeability: "
      "1e-19 m^2, viscosity: 1 mPa*s, friction: 0.6, dilation_angle: 10 deg"};
  for (const std::string& set : sets)
    EXPECT_THAT(notes_of(scene_with(set, "initial_aperture: 1e-2 m")), IsEmpty()) << set;
  // Detournay and Cheng 1993, Table 2: G (GPa), nu, porosity, k (m^2) of nine rocks.
  const struct {
    double g, nu, porosity, k;
  } rocks[] = {{13, 0.12, 0.02, 2e-16},    {24, 0.25, 0.02, 1e-19},  {19, 0.27, 0.02, 1e-19},
               {6, 0.20, 0.19, 1.9e-13},   {15, 0.25, 0.01, 4e-19},  {12, 0.15, 0.06, 1e-15},
               {6.8, 0.18, 0.19, 5.6e-15}, {5.9, 0.16, 0.20, 8e-16}, {4.2, 0.15, 0.26, 8e-13}};
  for (const auto& [g, nu, porosity, k] : rocks)
    EXPECT_THAT(
        notes_of(scene_with(fmt::format("young_modulus: {} GPa, poisson_ratio: {}, porosity: {}, "
                                        "fluid_compressibility: 4.5e-10 1/Pa, permeability: {} m^2, viscosity: 1 "
                                        "cP, friction: 0.6, dilation_angle: 0 deg",
                                        2 * g * (1 + nu), nu, porosity, k))),
        IsEmpty());
}

TEST(UnusualValues, AreNotFoundInTheScenesOfThisProject) {
  namespace fs = std::filesystem;
  int scenes = 0;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(fs::path(SPREKK_SOURCE_DIR) / "configs")) {
    if (entry.path().extension() != ".yaml" || entry.path().parent_path().filename() == "studies") continue;
    const Scene scene =
        read_scene(load_scene({entry.path().string()}, {}), entry.path().parent_path().string(), "scene");
    ++scenes;
    // Made up, so that their closed forms have round numbers, or benchmarks in units of their own; none of them is a
    // rock or a fluid.
    const std::set<std::string> made_up = {"barry_mercer", "injection_fault", "lauwerier", "hydrocoin",
                                           "complex_network"};
    if (made_up.count(entry.path().stem().string()) > 0) continue;
    Notes found;
    note_unusual_values(properties_of(scene), found);
    for (const Notes::Note& note : found.all())
      EXPECT_THAT(note.topic, testing::Not(testing::StartsWith("unusual"))) << entry.path() << note.text;
  }
  EXPECT_GT(scenes, 20);
}

}  // namespace
}  // namespace sprekk
