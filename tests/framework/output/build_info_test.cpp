#include "framework/output/build_info.hpp"

#include <gtest/gtest.h>
#include <vtkVersionMacros.h>

#include <thread>

namespace sprekk {
namespace {

TEST(BuildInfo, VersionsAreThoseOfTheHeadersInUse) {
  const BuildInfo& info = build_info();
  EXPECT_FALSE(info.version.empty());
  EXPECT_FALSE(info.compiler.empty());
  EXPECT_EQ(info.libraries.at("VTK"), VTK_VERSION);
  EXPECT_TRUE(info.libraries.contains("HDF5"));
  for (const auto& [name, version] : info.libraries) EXPECT_FALSE(version.empty()) << name;
}

TEST(BuildInfo, CoresAreThoseThatThisProcessMayUse) {
  EXPECT_GE(host().cores, 1);
  EXPECT_LE(host().cores, static_cast<int>(std::thread::hardware_concurrency()));
}

}  // namespace
}  // namespace sprekk
