#include "framework/output/output_folder.hpp"

#include "tests/framework/output/small_case.hpp"

namespace sprekk {
namespace {

using testing::Test;
namespace fs = std::filesystem;

class OutputFolderTest : public TemporaryFolder {
 protected:
  fs::path used(const std::string& name) {
    fs::create_directories(folder / name);
    write_text(folder / name / "run.json", "{}");
    return folder / name;
  }
};

TEST_F(OutputFolderTest, ChoosingWritesNothing) {
  const auto chosen = OutputFolder::for_scene("mandel", folder / "results");
  EXPECT_EQ(chosen.path(), folder / "results" / "mandel");
  const auto given = OutputFolder::given(folder / "mine" / "deep");
  EXPECT_EQ(given.path(), folder / "mine" / "deep");
  EXPECT_TRUE(fs::is_empty(folder));
}

TEST_F(OutputFolderTest, IsNumberedWhenTheNameIsTaken) {
  EXPECT_EQ(OutputFolder::for_scene("a", folder).create(), folder / "a");
  EXPECT_EQ(OutputFolder::for_scene("a", folder).create(), folder / "a") << "an empty folder may be used";
  used("a");
  EXPECT_EQ(OutputFolder::for_scene("a", folder).create(), folder / "a-2");
  used("a-2");
  used("a-3");
  EXPECT_EQ(OutputFolder::for_scene("a", folder).create(), folder / "a-4");
  EXPECT_TRUE(fs::is_directory(folder / "a-4"));
}

TEST_F(OutputFolderTest, AFileOfThatNameIsNotOverwritten) {
  write_text(folder / "a", "mine");
  EXPECT_EQ(OutputFolder::for_scene("a", folder).create(), folder / "a-2");
  EXPECT_EQ(read_text(folder / "a"), "mine");
}

TEST_F(OutputFolderTest, TakesTheNextNumberWhenAnotherRunWasFaster) {
  auto mine = OutputFolder::for_scene("a", folder);
  used("a");
  EXPECT_EQ(mine.create(), folder / "a-2");
  EXPECT_EQ(mine.create(), folder / "a-2");
}

TEST_F(OutputFolderTest, ANameCannotLeaveTheResults) {
  EXPECT_EQ(OutputFolder::for_scene("../x y", folder).path(), folder / "_._x_y");
  EXPECT_EQ(OutputFolder::for_scene("..", folder).path(), folder / "_.");
  EXPECT_EQ(OutputFolder::for_scene("", folder).path(), folder / "scene");
}

TEST_F(OutputFolderTest, AGivenFolderWithContentIsRefused) {
  const auto path = used("a");
  const auto message = [&] { return input_error_of([&] { OutputFolder::given(path); }); };
  EXPECT_NE(message().find(path.string() + " is not empty"), std::string::npos) << message();
  EXPECT_NE(message().find("-o"), std::string::npos) << message();
  EXPECT_EQ(message().find("--restart"), std::string::npos) << "there is nothing to go on from: " << message();
  write_text(path / "checkpoint.h5", "");
  EXPECT_NE(message().find("--restart"), std::string::npos) << message();
}

TEST_F(OutputFolderTest, WhatARunLeavesThatWasKilledAtOnceIsNoResult) {
  const auto path = folder / "a";
  std::filesystem::create_directory(path);
  for (const char* const name : {".lock", "checkpoint.h5.partial"}) write_text(path / name, "");
  EXPECT_FALSE(OutputFolder::holds_results(path));
  EXPECT_EQ(OutputFolder::given(path).create(), path);
  write_text(path / "run.json", "");
  EXPECT_TRUE(OutputFolder::holds_results(path));
}

TEST_F(OutputFolderTest, ARestartContinuesInAFolderWithContent) {
  const auto path = used("a");
  auto continued = OutputFolder::given(path, OutputFolder::Purpose::restart);
  EXPECT_EQ(continued.create(), path);
  EXPECT_EQ(read_text(path / "run.json"), "{}");
}

TEST_F(OutputFolderTest, AGivenFileIsRefused) {
  write_text(folder / "a", "mine");
  const std::string message = input_error_of([&] { OutputFolder::given(folder / "a"); });
  EXPECT_NE(message.find("is a file"), std::string::npos) << message;
}

TEST_F(OutputFolderTest, WhatCannotBeMadeIsAnInputError) {
  write_text(folder / "file", "mine");
  auto below_a_file = OutputFolder::given(folder / "file" / "results");
  EXPECT_NE(input_error_of([&] { below_a_file.create(); }).find("cannot be made"), std::string::npos);
  auto numbered = OutputFolder::for_scene("a", folder / "file");
  EXPECT_NE(input_error_of([&] { numbered.create(); }).find("cannot be made"), std::string::npos);
}

}  // namespace
}  // namespace sprekk
