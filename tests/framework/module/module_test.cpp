#include "framework/module/module.hpp"

#include <gmock/gmock.h>

#include <stdexcept>
#include <string>

namespace sprekk::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

std::string message_of(const char* name) {
  try {
    open_module(name);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "no error";
}

TEST(Module, MissingFileIsNamedWithWhatToDo) {
  EXPECT_EQ(
      message_of("that_is_not_there"),
      "cannot open the module sprekk_that_is_not_there.so (cannot open shared object file: No such file or directory) "
      "build or install Sprekk anew: the folder lib/sprekk belongs to the program");
}

TEST(Module, DamagedFileIsRefused) {
  EXPECT_THAT(message_of("damaged"), AllOf(HasSubstr("sprekk_damaged.so ("), HasSubstr("file too short")));
}

TEST(Module, LibraryThatIsNoModuleIsRefused) {
  EXPECT_THAT(message_of("without_entry"), HasSubstr("undefined symbol: sprekk_module"));
}

TEST(Module, OtherVersionIsRefusedEachTime) {
  for (int time = 0; time < 2; ++time)
    EXPECT_THAT(message_of("of_another_version"), HasSubstr("(it is of version 0.0.0, the program of "));
}

}  // namespace
}  // namespace sprekk::test
