#include "framework/output/atomic_file.hpp"

#include <sys/resource.h>

#include <csignal>

#include "tests/framework/output/small_case.hpp"

namespace sprekk {
namespace {

using AtomicFile = TemporaryFolder;

TEST_F(AtomicFile, ReplacesTheOldContentAndLeavesNothingElse) {
  const auto file = folder / "a.txt";
  write_atomically(file, "first, and longer than the second");
  write_atomically(file, "second");
  EXPECT_EQ(read_text(file), "second");
  EXPECT_FALSE(std::filesystem::exists(partial_name(file)));
}

TEST_F(AtomicFile, AFailedWriteNamesTheFileAndKeepsTheOldContent) {
  const auto file = folder / "a.txt";
  write_atomically(file, "old");
  std::filesystem::create_directory(partial_name(file));  // the place of the new content is taken
  try {
    write_atomically(file, "new");
    ADD_FAILURE() << "no exception";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find(file.string()), std::string::npos);
  }
  EXPECT_EQ(read_text(file), "old");
}

/// No file may grow, as on a full disk.
class FullDisk {
 public:
  FullDisk() : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit none{0, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &none);
  }
  ~FullDisk() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }

 private:
  void (*handler_)(int);
  rlimit before_{};
};

TEST_F(AtomicFile, AFullDiskIsNoticed) {
  const auto file = folder / "a.txt";
  write_atomically(file, "old");
  {
    const FullDisk full;
    EXPECT_THROW(write_atomically(file, "text"), std::runtime_error);
  }
  EXPECT_EQ(read_text(file), "old");
  EXPECT_FALSE(std::filesystem::exists(partial_name(file)));
}

TEST_F(AtomicFile, FollowsNoLinkOutOfItsFolder) {
  const auto outside = folder / "outside", results = folder / "results";
  std::filesystem::create_directory(results);
  for (const bool is_there : {true, false}) {
    if (is_there) write_text(outside, "of somebody else");
    for (const auto& name : {results / "a.txt", partial_name(results / "a.txt")}) {
      std::filesystem::remove(results / "a.txt");
      std::filesystem::create_symlink(outside, name);
      write_atomically(results / "a.txt", "mine");
      EXPECT_EQ(read_text(results / "a.txt"), "mine");
      EXPECT_FALSE(std::filesystem::is_symlink(results / "a.txt"));
      EXPECT_EQ(std::filesystem::exists(outside), is_there) << name;
      if (is_there) {
        EXPECT_EQ(read_text(outside), "of somebody else") << name;
      }
    }
    std::filesystem::remove(outside);
  }
}

}  // namespace
}  // namespace sprekk
