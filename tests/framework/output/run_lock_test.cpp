#include "framework/output/run_lock.hpp"

#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <optional>

#include "tests/framework/output/small_case.hpp"

namespace sprekk {
namespace {

using RunLockTest = TemporaryFolder;

TEST_F(RunLockTest, IsHeldByOneAndNamesIt) {
  std::optional<RunLock> lock(folder);
  const std::string text = read_text(folder / RunLock::file_name);
  EXPECT_THAT(text, testing::StartsWith("process " + std::to_string(getpid()) + " on "));
  EXPECT_THAT(input_error_of([&] { RunLock{folder}; }),
              testing::HasSubstr("another run is at work in " + folder.string() + " (process " +
                                 std::to_string(getpid()) + " on "));
  lock.reset();
  EXPECT_TRUE(std::filesystem::is_empty(folder));
  const RunLock again(folder);
}

TEST_F(RunLockTest, EndsWithItsProcess) {
  const pid_t child = fork();
  if (child == 0) {
    const RunLock lock(folder);
    _exit(0);  // like a process that was killed: nothing is tidied up
  }
  waitpid(child, nullptr, 0);
  EXPECT_TRUE(std::filesystem::exists(folder / RunLock::file_name));
  const RunLock lock(folder);
  EXPECT_THAT(read_text(folder / RunLock::file_name), testing::HasSubstr(std::to_string(getpid())));
}

TEST_F(RunLockTest, OfManyAtOnceOneHasIt) {
  // Each holds the lock for a moment and adds a mark to a file; marks never mix.
  constexpr int processes = 6, turns = 40;
  std::vector<pid_t> children;
  for (int i = 0; i < processes; ++i) {
    children.push_back(fork());
    if (children.back() != 0) continue;
    alarm(20);  // a child that never gets the lock ends
    for (int done = 0; done < turns;) {
      try {
        const RunLock lock(folder);
        const std::string seen = std::filesystem::exists(folder / "count") ? read_text(folder / "count") : "0";
        write_text(folder / "count", std::to_string(std::stoi(seen) + 1));
        ++done;
      } catch (const InputError&) {
        usleep(100);
      } catch (...) {
        _exit(1);  // two were in the folder at once
      }
    }
    _exit(0);
  }
  for (const pid_t child : children) {
    int status = 0;
    waitpid(child, &status, 0);
    EXPECT_EQ(status, 0);
  }
  EXPECT_EQ(read_text(folder / "count"), std::to_string(processes * turns));
}

TEST_F(RunLockTest, NeedsAFolder) {
  EXPECT_THAT(input_error_of([&] { RunLock{folder / "none"}; }), testing::HasSubstr("cannot be written to"));
}

}  // namespace
}  // namespace sprekk
