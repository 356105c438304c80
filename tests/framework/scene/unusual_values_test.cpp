// Notes on values that no rock, fracture or fluid has.
#include "framework/scene/unusual_values.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <map>

#include "framework/config/yaml/load_scene.hpp"
#include "framework/config/yaml/parse_yaml.hpp"
#include "framework/scene/model.hpp"
#include "framework/scene/scene_dimension.hpp"

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
         "}\ncomponents:\n  pore: {type: matrix_flow/mpfa, boundary: {left: {pressure: 0 Pa}}}\n  rock: {type: "
         "poromechanics/mpsa, boundary: "
         "{left: {displacement: [0 m, 0 m]}}}\n  conduit: {type: "
         "fracture_flow/tpfa, " +
         conduit +
         "}\n  contact: {type: contact/coulomb}\ncouplers: [{type: biot, between: [pore, rock], biot_coefficient: 1}, "
         "{type: "
         "wall_exchange, between: [pore, conduit]}, {type: wall_traction, between: [rock, contact, conduit]}]\nmesh: "
         "{size: 0.2 m}\nschedule: [{solve: [pore, rock, conduit, contact]}]\ntime: {end: 1 s, "
         "step: 1 s}\n";
}

std::vector<PropertyValue> properties_of(const Scene& scene) {
  const Model model(scene);
  return properties_of(scene, {model.mesh(), model.fields(), model.components()});
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
              AllOf(testing::StartsWith("s.yaml:2:"), HasSubstr(fmt::format("'{}' is '{}'", name, value)),
                    HasSubstr(" (as a rule it is from"), HasSubstr(advice)));
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
  // In the cells at x = 1 m, whose centres are up to a cell of 0.2 m away.
  EXPECT_THAT(values_of("(1e-17*(1 + 1e12*x)) m^2"),
              ElementsAre(AllOf(testing::Gt(0.8e-17 * 1e12), testing::Lt(1e-17 * 1e12))));
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
              ElementsAre(HasSubstr("the scene is treated as one without dimensions")));
  // What has no dimension anyhow keeps its own note.
  EXPECT_THAT(notes_of(scene_with(std::string(of_order_one).replace(std::string(of_order_one).find("0.6"), 3, "60"))),
              testing::UnorderedElementsAre(HasSubstr("without dimensions"), HasSubstr("'friction' is '60'")));
}

TEST(UnusualValues, AreLookedForWhereTheyHold) {
  // The fracture reaches from x = 0.3 m to 0.7 m: 2.2 is the most there, and 10.6 in the corners of the box.
  EXPECT_THAT(notes_of(scene_with(but("friction", "(0.6 + 40*(x - 0.5)^2)"))), IsEmpty());
  EXPECT_THAT(notes_of(scene_with(but("friction", "(0.6 + 400*(x - 0.5)^2)"))),
              ElementsAre(AllOf(HasSubstr("'friction' is '(0.6 + 400*(x - 0.5)^2)', "), HasSubstr(" at x = 0."))));
  // The region reaches to x = 0.2 m.
  const std::string beyond = "(1e-17*(1 + 1e12*max(x - 0.3, 0))) m^2";
  EXPECT_THAT(notes_of(scene_with(but("permeability", "{regions: {core: '" + beyond + "', default: 1e-17 m^2}}"))),
              IsEmpty());
  EXPECT_THAT(notes_of(scene_with(but("permeability", "{regions: {core: 1e-17 m^2, default: '" + beyond + "'}}"))),
              ElementsAre(HasSubstr("'permeability' is")));
  EXPECT_THAT(notes_of(scene_with(usual, "initial_aperture: {fractures: {'cra*': (0.1*x) m, default: (9*x) m}}")),
              IsEmpty());
  EXPECT_THAT(notes_of(scene_with(usual, "initial_aperture: {fractures: {default: (9*x) m}}")),
              ElementsAre(HasSubstr("'initial_aperture' is")));
  // The second window begins after 0.5 s.
  const auto windows = [](const char* value) {
    return fmt::format("[{{value: 1 mPa*s, to: 0.5 s}}, {{value: '{}', from: 0.5 s}}]", value);
  };
  EXPECT_THAT(notes_of(scene_with(but("viscosity", windows("(max(0.3 - t, 1e-3)) Pa*s")))), IsEmpty());
  EXPECT_THAT(notes_of(scene_with(but("viscosity", windows("(max(t - 0.3, 1e-3)) Pa*s")))),
              ::testing::Each(HasSubstr(", 0.7 Pa*s at ")));
}

/// The usual materials with those that a publication gives.
std::string with(const std::map<std::string, std::string>& given) {
  std::string text = usual;
  for (const auto& [name, value] : given) {
    const std::size_t begin = text.find(name + ": ");
    if (begin == std::string::npos) {
      text += ", " + name + ": " + value;
      continue;
    }
    const std::size_t first = begin + name.size() + 2;
    text.replace(first, std::min(text.find(',', first), text.size()) - first, value);
  }
  return text;
}

/// Published sets of parameters, as they are printed there.
TEST(UnusualValues, AreNotFoundInTheTablesOfPapers) {
  const struct {
    const char* source;
    std::map<std::string, std::string> materials;
    const char* conduit;
  } sets[] = {{"Dang-Trung et al. 2022, Table 1",
               {{"young_modulus", "40 GPa"},
                {"poisson_ratio", "0.2"},
                {"porosity", "0.01"},
                {"fluid_compressibility", "4.0e-10 1/Pa"},
                {"permeability", "5.0e-20 m^2"},
                {"viscosity", "1.0e-4 Pa*s"},
                {"friction", "0.5"},
                {"dilation_angle", "1 deg"}},
               "initial_aperture: 0.1 mm"},
              // 6000 and 3464 m/s, 2670 kg/m^3: E = 80.1 GPa, nu = 0.25.
              {"fault rupture benchmark SCEC TPV5, as in the documentation of SeisSol",
               {{"young_modulus", "80.1 GPa"}, {"poisson_ratio", "0.25"}, {"friction", "0.677"}},
               "initial_aperture: 0.1 mm"},
              // G = 15 GPa.
              {"Fluid pressure drops during stimulation of segmented faults, Geothermal Energy 2018, "
               "doi:10.1186/s40517-018-0110-7, Table 1",
               {{"young_modulus", "37.5 GPa"},
                {"poisson_ratio", "0.25"},
                {"viscosity", "0.001 Pa*s"},
                {"friction", "0.85"},
                {"dilation_angle", "5 deg"}},
               "initial_aperture: 1200 um"},
              // K = 51.7 GPa, G = 20 GPa.
              {"Utah FORGE, well 16B, an injection test, as in GEOS: inputFiles/hydraulicFracturing/FORGE_DFIT",
               {{"young_modulus", "53.15 GPa"},
                {"poisson_ratio", "0.3287"},
                {"porosity", "0.01"},
                {"fluid_compressibility", "5e-10 1/Pa"},
                {"permeability", "1e-16 m^2"},
                {"viscosity", "1e-3 Pa*s"}},
               "initial_aperture: 2e-5 m"},
              // Lame's 7.0208 and 14.8547 GPa. Its papers are named there.
              {"granite, as in PorePy: applications/material_values/solid_values.py",
               {{"young_modulus", "34.48 GPa"},
                {"poisson_ratio", "0.1605"},
                {"porosity", "1.3e-2"},
                {"permeability", "5.0e-18 m^2"},
                {"friction", "0.6"},
                {"dilation_angle", "0.1 rad"}},
               "initial_aperture: 1e-3 m"},
              // Lame's 31.2 and 31.2 GPa.
              {"basalt, as in PorePy: applications/material_values/solid_values.py",
               {{"young_modulus", "78 GPa"},
                {"poisson_ratio", "0.25"},
                {"porosity", "0.10"},
                {"permeability", "1e-16 m^2"},
                {"friction", "0.7"}},
               "initial_aperture: 1e-3 m"}};
  for (const auto& [source, materials, conduit] : sets)
    EXPECT_THAT(notes_of(scene_with(with(materials), conduit)), IsEmpty()) << source;
}

TEST(UnusualValues, AreNotFoundInTheScenesOfThisProject) {
  namespace fs = std::filesystem;
  int scenes = 0;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(fs::path(SPREKK_SOURCE_DIR) / "configs")) {
    if (entry.path().extension() != ".yaml" || entry.path().parent_path().filename() == "studies") continue;
    const Node whole = load_scene({entry.path().string()}, {});
    const std::string folder = entry.path().parent_path().string();
    if (dimension_of(whole, folder) != dimension) continue;  // flow_in_space_test.py runs those
    const Scene scene = read_scene(whole, folder, "scene");
    ++scenes;
    Notes found;
    note_unusual_values(properties_of(scene), found);
    for (const Notes::Note& note : found.all())
      EXPECT_THAT(note.topic, testing::Not(testing::StartsWith("unusual"))) << entry.path() << note.text;
  }
  EXPECT_GT(scenes, 20);
}

}  // namespace
}  // namespace sprekk
