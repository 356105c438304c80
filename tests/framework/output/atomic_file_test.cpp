#include "framework/output/atomic_file.hpp"

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

TEST_F(AtomicFile, AFullDiskIsNoticed) {
  // Every write to /dev/full fails as on a full disk.
  const auto file = folder / "a.txt";
  std::filesystem::create_symlink("/dev/full", partial_name(file));
  EXPECT_THROW(write_atomically(file, "text"), std::runtime_error);
  EXPECT_FALSE(std::filesystem::exists(file));
}

}  // namespace
}  // namespace sprekk
