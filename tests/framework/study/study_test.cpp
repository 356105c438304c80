#include "framework/study/study.hpp"
#include "framework/config/yaml/parse_yaml.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "framework/study/scene_identity.hpp"

namespace sprekk {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;

class StudyFile : public testing::Test {
 protected:
  StudyFile() {
    std::string name = (fs::temp_directory_path() / "sprekk_study_XXXXXX").string();
    folder_ = mkdtemp(name.data());
    fs::copy_file(fs::path(SPREKK_SOURCE_DIR) / "configs/tutorial/first_scene.yaml", folder_ / "scene.yaml");
  }
  ~StudyFile() override { fs::remove_all(folder_); }

  Study read(const std::string& yaml) {
    std::ofstream(folder_ / "study.yaml") << yaml;
    return read_study((folder_ / "study.yaml").string());
  }
  std::string refusal(const std::string& yaml) {
    try {
      read(yaml);
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  }

  fs::path folder_;
};

std::vector<std::string> names(const Study& study) {
  std::vector<std::string> result;
  for (const StudyRun& run : study.runs) result.push_back(run.name);
  return result;
}

TEST_F(StudyFile, has_a_run_for_each_combination_and_each_named_run) {
  const Study study = read(
      "scene: scene.yaml\nset: {time.end: 1 day}\ngrid:\n  time.step: [1 h, 2 h]\n  mesh.size: [0.5 m, 1 m]\n"
      "runs: {fine: {time.step: 30 min}}\n");
  EXPECT_EQ(study.name, "study");
  EXPECT_THAT(names(study),
              ElementsAre("step=1h,size=0.5m", "step=1h,size=1m", "step=2h,size=0.5m", "step=2h,size=1m", "fine"));
  EXPECT_THAT(study.keys, ElementsAre("time.step", "mesh.size"));
  EXPECT_THAT(study.runs[3].values, ElementsAre("2 h", "1 m"));
  EXPECT_THAT(study.runs[4].values, ElementsAre("30 min", "0.5 m"));  // the size is that of the scene
  const Scene scene = study.scene_of(study.runs[2]);
  EXPECT_EQ(scene.time.step, 7200);
  EXPECT_EQ(scene.time.end, 86400);
  EXPECT_EQ(scene.mesh.size, 0.5);
}

TEST_F(StudyFile, takes_maps_lists_and_components_as_values) {
  const Study study = read(
      "scene: scene.yaml\ngrid:\n  components.pore.type: [matrix_flow/mpfa, matrix_flow/tpfa]\n"
      "  time: [{step: 1 h}, {step: 2 h, end: 6 h}]\n");
  EXPECT_EQ(study.scene_of(study.runs[3]).time.end, 6 * 3600);
  EXPECT_EQ(study.scene_of(study.runs[3]).components[0].type, "matrix_flow/tpfa");
}

TEST_F(StudyFile, names_the_place_of_a_mistake_in_any_run) {
  const std::string head = "scene: scene.yaml\ngrid:\n  ";
  EXPECT_THAT(refusal(head + "mesh.sise: [1 m]\n"), HasSubstr("study.yaml:3:3: unknown key 'sise' in 'mesh'"));
  EXPECT_THAT(refusal(head + "mesh.sise: [1 m]\n"), HasSubstr("did you mean 'size'?"));
  EXPECT_THAT(refusal(head + "mesh.size: [1 m, 1 Pa]\n"), HasSubstr("study.yaml:3:20: '1 Pa' for 'size'"));
  EXPECT_THAT(refusal(head + "mesh.size: 1 m\n"), HasSubstr("study.yaml:3:14: 'mesh.size' in 'grid' has no list"));
  EXPECT_THAT(refusal(head + "mesh.size: [1 m, 1 m]\n"), HasSubstr("'1 m' stands twice"));
  EXPECT_THAT(refusal(head + "couplers.9.type: [biot]\n"), HasSubstr("study.yaml:3:3: 'couplers' has no item '9'"));
  EXPECT_THAT(refusal("scene: scene.yaml\nruns: {a: {mesh.size: 1 Pa}, b: {time.ends: 1 h}}\n"),
              testing::AllOf(HasSubstr("'1 Pa'"), HasSubstr("'ends'")));
}

TEST_F(StudyFile, names_the_place_of_its_own_mistakes) {
  EXPECT_THAT(refusal("scene: scene.yaml\n"), HasSubstr("the study has no runs"));
  EXPECT_THAT(refusal("grid: {mesh.size: [1 m]}\n"), HasSubstr("'scene' is missing in 'study'"));
  EXPECT_THAT(refusal("scene: sceen.yaml\nruns: {a: }\n"), HasSubstr("study.yaml:1:8: there is no scene 'sceen.yaml'"));
  EXPECT_THAT(refusal("scene: scene.yaml\ngird: {mesh.size: [1 m]}\n"), HasSubstr("did you mean 'grid'?"));
  EXPECT_THAT(refusal("scene: scene.yaml\nruns: {a/b: }\n"), HasSubstr("a run cannot be called 'a/b'"));
  EXPECT_THAT(refusal("scene: scene.yaml\nruns: {fine: }\ncompare: {reference: fin}\n"),
              HasSubstr("study.yaml:3:22: unknown run 'fin' (it is not one of: fine) did you mean 'fine'?"));
}

TEST_F(StudyFile, identifies_a_run_by_what_it_reads) {
  const std::string yaml = "scene: scene.yaml\nruns: {a: , b: {mesh.size: 1 m}}\n";
  const Study study = read(yaml);
  EXPECT_NE(study.runs[0].identity, study.runs[1].identity);
  std::ofstream(folder_ / "scene.yaml", std::ios::app) << "# a comment\n";
  EXPECT_EQ(read(yaml).runs[0].identity, study.runs[0].identity);
}

TEST_F(StudyFile, identifies_a_run_by_the_files_that_it_reads) {
  const Node scene = parse_yaml("{pressure: {table: p.csv}, name: a}", "s.yaml");
  std::ofstream(folder_ / "p.csv") << "t,p\n0,1\n";
  const std::string before = scene_identity(scene, folder_);
  EXPECT_EQ(scene_identity(parse_yaml("{name: b, pressure: {table: p.csv}}", "s.yaml"), folder_), before);
  std::ofstream(folder_ / "p.csv") << "t,p\n0,2\n";
  EXPECT_NE(scene_identity(scene, folder_), before);
}

}  // namespace
}  // namespace sprekk
