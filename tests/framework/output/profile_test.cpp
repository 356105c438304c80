#include "framework/output/profile.hpp"

#include <gmock/gmock.h>

#include <thread>

namespace sprekk {
namespace {

TEST(Profile, CountsCallsReusesAndSkips) {
  Profile profile;
  { const ScopedTimer timer(profile, "mesh"); }
  { const ScopedTimer timer(profile, "factorization"); }
  { const ScopedTimer timer(profile, "factorization"); }
  profile.reused("factorization");
  profile.skipped("tips");
  ASSERT_EQ(profile.entries().size(), 3u);
  const Profile::Entry& factorization = profile.entries()[1];
  EXPECT_EQ(factorization.name, "factorization");
  EXPECT_EQ(factorization.calls, 2);
  EXPECT_EQ(factorization.reuses, 1);
  EXPECT_EQ(factorization.skips, 0);
  EXPECT_EQ(profile.entries()[2].skips, 1);
}

TEST(Profile, ATimerInsideAnotherIsNotCountedTwice) {
  using namespace std::chrono;
  Profile profile;
  const auto start = steady_clock::now();
  {
    const ScopedTimer outer(profile, "outer");
    std::this_thread::sleep_for(milliseconds(10));
    {
      const ScopedTimer inner(profile, "inner");
      std::this_thread::sleep_for(milliseconds(30));
    }
  }
  const double total = duration<double>(steady_clock::now() - start).count();
  const double outer = profile.at("outer").seconds, inner = profile.at("inner").seconds;
  EXPECT_GE(outer, 0.010);
  EXPECT_GE(inner, 0.030);
  EXPECT_LE(outer + inner, total);
}

TEST(Profile, TheTableIsAlignedSortedAndAddsUp) {
  Profile profile;
  profile.at("mesh") = {"mesh", 1, 0, 0, 0.5};
  profile.at("rock+pore: factorization") = {"rock+pore: factorization", 3, 97, 0, 2.0, true};
  profile.at("tips") = {"tips", 4, 5, 1991, 1.0};
  EXPECT_EQ(profile.table(4.0),
            "                                calls    reuses     skips    seconds   share\n"
            "rock+pore: factorization            3        97         0      2.000  50.0 %\n"
            "tips                                4         5      1991      1.000  25.0 %\n"
            "mesh                                1         0         0      0.500  12.5 %\n"
            "set-up and others                                              0.500  12.5 %\n"
            "total                                                          4.000 100.0 %\n"
            "factorizations, back-solves                                    2.000  50.0 %\n"
            "everything else                                                2.000  50.0 %\n");
}

TEST(Profile, ARunThatTookNoTimeHasATableToo) { EXPECT_THAT(Profile().table(0), testing::HasSubstr("total")); }

}  // namespace
}  // namespace sprekk
