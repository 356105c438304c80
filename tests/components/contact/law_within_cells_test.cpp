// The law of walls that slide, for the places within a cell, where the walls of a part of the cell have parted.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/components/contact/contact_alone.hpp"

namespace sprekk::contact {
namespace {

constexpr double friction = 0.6, pressure = 10;  // between all walls that touch

/// Fracture `a`, whose walls have slipped to one side (1 or -1) and touch everywhere, but in the cell in its middle.
class PartlyParted : public ::testing::TestWithParam<int> {
 protected:
  PartlyParted() : mesh_(crossing()), contact_(mesh_, {friction, 0}) {
    contact_.law().set_wall_stiffness(Vector::Ones(2 * cells()));
    contact_.law().begin_step(Contact::step);
  }
  int cells() const { return mesh_.fracture_cell_count(); }
  int middle() const { return mesh_.fractures[0].first_cell + mesh_.fractures[0].cell_count / 2; }
  int side() const { return GetParam(); }

  /// The law of the cell in the middle, whose walls touch over this share of its length. Its shear was at the bound of
  /// friction, and `taken` of it is gone since the walls rest.
  SlidingWalls law(double share, double taken) {
    Vector traction(2 * cells()), jump(2 * cells());
    for (int i = 0; i < cells(); ++i) {
      const double part = i == middle() ? share : 1, gone = i == middle() ? taken : 0;
      traction.segment<2>(2 * i) << -part * pressure, side() * (part * friction * pressure - gone);
      jump.segment<2>(2 * i) << (part > 0 ? 0 : 0.1), side();
    }
    contact_.set(traction, jump);
    const std::optional<SlidingWalls> law = contact_.law().sliding(middle());
    EXPECT_TRUE(law.has_value());
    return law.value_or(SlidingWalls{});
  }

  const Mesh mesh_;
  Contact contact_;
};

INSTANTIATE_TEST_SUITE_P(Slip, PartlyParted, ::testing::Values(1, -1));

TEST_P(PartlyParted, WallsThatSlideHaveTheirFriction) {
  for (const double share : {1.0, 0.5, 1e-3, 1e-9, 0.0}) {
    EXPECT_NEAR(law(share, 0).friction, friction, 1e-12) << share;
    EXPECT_EQ(law(share, 0).direction, side()) << share;
  }
}

// A cell that touches everywhere, and presses less than those beside it, has its mean shear on the fine level, too.
TEST_P(PartlyParted, WallsThatRestHaveTheirMobilisedFriction) {
  for (const double share : {1.0, 0.5, 0.21})
    for (const double part :
         {0.1, 0.9, 1.1, 2.0}) {  // of the shear at the bound that is gone; above 1 the shear has turned
      const SlidingWalls found = law(share, part * share * friction * pressure);
      EXPECT_NEAR(found.friction, friction * std::abs(1 - part), 1e-12) << share;
      EXPECT_EQ(found.direction, side() * (part < 1 ? 1 : -1)) << share;
    }
}

// Where a cell has parted over most of its length, the pressure at the places that touch is that of the cells beside
// it: a fifth, here, for the law to be continuous in the share. What holds walls back is the rock, which takes as much
// shear from places that press much as from others, so that the mean of a cell may slide back while its places rest.
TEST_P(PartlyParted, ATraceOfBackSlipTurnsNoFriction) {
  for (const double share : {0.05, 1e-3, 1e-9}) {
    const double back = 2 * share * friction * pressure;  // the bound of the mean in the other direction
    EXPECT_NEAR(law(share, back).friction, friction * (1 - 2 * share / 0.2), 1e-12) << share;
    EXPECT_EQ(law(share, back).direction, side()) << share;
  }
}

TEST_P(PartlyParted, TheLawIsContinuousInTheShare) {
  for (const double part : {0.5, 2.0}) {
    const auto signed_friction = [&](double share) {
      const SlidingWalls found = law(share, part * share * friction * pressure);
      return found.direction * found.friction;
    };
    EXPECT_NEAR(signed_friction(0.2 * (1 - 1e-9)), signed_friction(0.2 * (1 + 1e-9)), 1e-8);
    EXPECT_NEAR(signed_friction(1e-10), signed_friction(0), 1e-8);
  }
}

}  // namespace
}  // namespace sprekk::contact
