// Files, merging and overrides.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "framework/config/node.hpp"
#include "framework/config/yaml/load_scene.hpp"
#include "tests/framework/config/messages.hpp"

namespace sprekk {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

class LoadScene : public testing::Test {
 protected:
  LoadScene() {
    folder_ = std::filesystem::temp_directory_path() / ("sprekk_load_scene_" + std::to_string(getpid()) + "_" +
                                                        testing::UnitTest::GetInstance()->current_test_info()->name());
    std::filesystem::create_directories(folder_);
  }
  ~LoadScene() override { std::filesystem::remove_all(folder_); }

  std::string file(const std::string& name, const std::string& content) const {
    const std::string path = (folder_ / name).string();
    std::ofstream(path, std::ios::binary) << content;
    return path;
  }

  std::filesystem::path folder_;
};

TEST_F(LoadScene, merges_maps_key_by_key_and_replaces_the_rest) {
  const std::string base = file("base.yaml", "a: {x: 1, y: {p: 1, q: 2}}\nlist: [1, 2, 3]\nb: 5\n");
  const std::string later = file("later.yaml", "a: {y: {q: 7}, z: 3}\nlist: [9]\nb: {c: 1}\n");
  const Node scene = load_scene({base, later}, {});
  EXPECT_EQ(scene.text(), "{a: {x: 1, y: {p: 1, q: 7}, z: 3}, list: [9], b: {c: 1}}");
  EXPECT_EQ(scene.find("a")->find("y")->find("q")->origin.text(), later + ":1:12");
  EXPECT_EQ(scene.find("a")->find("y")->find("p")->origin.text(), base + ":1:18");
  EXPECT_EQ(scene.find("a")->find("y")->find("q")->path, "a.y.q");
}

TEST_F(LoadScene, null_in_a_later_file_removes) {
  const std::string base = file("base.yaml", "components: {pore: {type: a}, contact: {type: b}}\n");
  const std::string later = file("later.yaml", "components: {contact: ~}\n");
  EXPECT_EQ(load_scene({base, later}, {}).text(), "{components: {pore: {type: a}}}");
}

TEST_F(LoadScene, an_empty_later_file_changes_nothing) {
  const std::string base = file("base.yaml", "a: 1\n");
  EXPECT_EQ(load_scene({base, file("later.yaml", "# nothing\n")}, {}).text(), "{a: 1}");
}

TEST_F(LoadScene, overrides_win) {
  const std::string base = file("base.yaml", "a: {x: 1}\ncouplers: [{type: p}, {type: q}]\nempty:\n");
  const Node scene = load_scene({base}, {{"a.x", "2 MPa"},
                                         {"a.new.deep", "[1, 2]"},
                                         {"couplers.1.type", "r"},
                                         {"empty.x", "1"},
                                         {"a", "{y: 4}"},
                                         {"couplers.0.type", ""}});
  EXPECT_EQ(scene.text(), "{a: {x: 2 MPa, new: {deep: [1, 2]}, y: 4}, couplers: [{}, {type: r}], empty: {x: 1}}");
  EXPECT_EQ(scene.find("a")->find("x")->origin.text(), "--set");
  EXPECT_EQ(scene.find("a")->find("new")->find("deep")->items[1].path, "a.new.deep.1");
}

TEST_F(LoadScene, wrong_overrides_are_refused) {
  const std::string base = file("base.yaml", "a: {x: 1}\nlist: [1, 2]\n");
  const auto message = [&](const Override& change) { return input_error_of([&] { load_scene({base}, {change}); }); };
  EXPECT_EQ(message({"a.x.y", "1"}), "--set a.x.y: 'a.x' has no keys (it is the value '1', from " + base + ":1:8)");
  EXPECT_EQ(message({"a..y", "1"}), "--set a..y: empty name in the path 'a..y' write --set section.key=value");
  EXPECT_THAT(message({"", "1"}), HasSubstr("empty name in the path"));
  EXPECT_EQ(message({"list.2", "1"}), "--set list.2: 'list' has no item '2' (it is a list of 2, counted from 0)");
  EXPECT_THAT(message({"list.first", "1"}), HasSubstr("'list' has no item 'first'"));
  EXPECT_THAT(message({"a.x", "[1"}), StartsWith("--set a.x:1:"));
  EXPECT_THAT(message({"a.z", ""}), HasSubstr("there is no 'a.z' to remove"));
  std::string deep = "a";
  for (int i = 0; i < 100; ++i) deep += ".a";
  EXPECT_THAT(message({deep, "1"}), HasSubstr("the path is too long"));
}

TEST_F(LoadScene, unreadable_files_are_refused) {
  const auto message = [](const std::string& path) { return input_error_of([&] { load_scene({path}, {}); }); };
  const std::string missing = (folder_ / "missing.yaml").string();
  EXPECT_EQ(message(missing), missing + ": cannot be read (No such file or directory)");
  EXPECT_EQ(message(folder_.string()), folder_.string() + ": cannot be read (it is a folder) give a file");
  const std::string binary = file("mesh.vtu", std::string("\x7f"
                                                          "ELF\0\0",
                                                          6));
  EXPECT_EQ(message(binary), binary + ":1: not a text file (it has a control byte here) save it as UTF-8 text");
  const std::string list = file("list.yaml", "[1, 2]\n");
  EXPECT_THAT(message(list), StartsWith(list + ":1:1: a scene is a map of keys"));
  const std::string empty = file("empty.yaml", "");
  EXPECT_THAT(message(empty), StartsWith(empty + ": the scene is empty"));
}

TEST_F(LoadScene, an_oversized_file_is_refused) {
  const std::string path = file("large.yaml", "a: 1\n");
  std::filesystem::resize_file(path, (std::size_t{64} << 20U) + 1);
  EXPECT_EQ(input_error_of([&] { load_scene({path}, {}); }),
            path + ": the file is too large (at most 64 MiB are read)");
}

}  // namespace
}  // namespace sprekk
