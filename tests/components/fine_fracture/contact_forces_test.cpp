// The forces between walls that may touch.
#include "components/fine_fracture/fine_level/contact_forces.hpp"

#include <gtest/gtest.h>

#include "framework/schedule/growing.hpp"

namespace sprekk::fine_fracture {
namespace {

// All principal minors of the compliance have one sign, so there is one solution; Newton's method goes round in
// circles.
TEST(ContactForces, AreFoundWhereNewtonsMethodCycles) {
  const Eigen::Matrix3d compliance{{-1, -2, -5}, {4, -4, 3}, {3, -6, -3}};
  const Vector gaps = Eigen::Vector3d(-2, 6, 3);
  const Vector forces = contact_forces(compliance, gaps);
  EXPECT_LT((forces - Eigen::Vector3d(-7 / 6.0, 0, -1 / 6.0)).lpNorm<Eigen::Infinity>(), 1e-14);
}

TEST(ContactForces, OfWallsThatPartAreNone) {
  EXPECT_EQ(contact_forces(-Eigen::Matrix2d::Identity(), Eigen::Vector2d(1, 2)), Vector(Eigen::Vector2d::Zero()));
}

TEST(ContactForces, ThatDoNotExistAreAnUnsolvedStep) {
  EXPECT_THROW(contact_forces(Eigen::MatrixXd::Constant(1, 1, 1), Vector::Constant(1, -1)), UnsolvedGrowth);
}

}  // namespace
}  // namespace sprekk::fine_fracture
