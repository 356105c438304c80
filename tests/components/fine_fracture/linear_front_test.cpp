// The front for linear loads: its conditions, from all over the parameters, and that the order of tips does not matter.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "components/fine_fracture/growth/linear_front.hpp"
#include "components/fine_fracture/growth/most_equal_front.hpp"

namespace sprekk::fine_fracture {
namespace {

constexpr double error = 1e-3;

/// Tips that unload themselves by `own` more than others, by `shared` all alike (1/increment).
LinearLoads loads_of(const std::vector<double>& rises, double own, double shared) {
  const auto count = static_cast<Eigen::Index>(rises.size());
  LinearLoads model;
  model.loads = Eigen::Map<const Eigen::VectorXd>(rises.data(), count);
  model.slopes = -shared * Eigen::MatrixXd::Ones(count, count) - own * Eigen::MatrixXd::Identity(count, count);
  model.at = Eigen::VectorXd::Zero(count);
  return model;
}

void expect_front(const LinearLoads& model, const Eigen::VectorXd& advances) {
  const FrontEquations front = most_equal_front(model.loads + model.slopes * (advances - model.at), advances, error);
  for (Eigen::Index i = 0; i < advances.size(); ++i) {
    EXPECT_GE(advances[i], 0);
    if (advances[i] > 0)
      EXPECT_NEAR(front.residual[i], 0, 1e-10);
    else
      EXPECT_LE(front.residual[i], 1e-10);
  }
}

TEST(LinearFront, WithoutAnErrorItIsTheComplementarityProblem) {
  const auto advances = linear_front(loads_of({0.3, 0.33}, 0.2, 0.3), 0);
  ASSERT_TRUE(advances);
  const double sum = 0.63 / 0.8;
  EXPECT_NEAR((*advances)[0], (0.3 - 0.3 * sum) / 0.2, 1e-11);
  EXPECT_NEAR((*advances)[1], (0.33 - 0.3 * sum) / 0.2, 1e-11);
  const auto alone = linear_front(loads_of({0.3, 0.05}, 0.2, 0.3), 0);
  ASSERT_TRUE(alone);
  EXPECT_NEAR((*alone)[0], 0.6, 1e-11);
  EXPECT_EQ((*alone)[1], 0);
}

/// Any two tips, from neutral ones on: there is one front, from wherever it is sought, and it is found.
TEST(LinearFront, TwoTipsHaveOneFront) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int k = 0; k < 300; ++k) {
    const double own = k % 3 == 0 ? 0 : std::pow(10, -3 + 3 * unit(random)),
                 apart = std::pow(10, -5 + 4 * unit(random));
    LinearLoads model = loads_of({0.2 * unit(random), 0}, own, 0.05 + 0.5 * unit(random));
    model.loads[1] = model.loads[0] - apart;
    const auto advances = linear_front(model, error);
    if (model.loads.sum() < 0 && apart < 2 * error) continue;  // at rest
    ASSERT_TRUE(advances) << k;
    expect_front(model, *advances);
    // The same loads, sought from elsewhere.
    LinearLoads other = model;
    other.at << unit(random), unit(random);
    other.loads += other.slopes * other.at;
    const auto again = linear_front(other, error);
    ASSERT_TRUE(again) << k;
    EXPECT_LT((*again - *advances).lpNorm<Eigen::Infinity>(), 1e-7) << k;
    // The other order.
    LinearLoads reverse = model;
    reverse.loads.reverseInPlace();
    const auto back = linear_front(reverse, error);
    ASSERT_TRUE(back) << k;
    EXPECT_LT((back->reverse() - *advances).lpNorm<Eigen::Infinity>(), 1e-7) << k;
  }
}

TEST(LinearFront, FourTips) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int k = 0; k < 100; ++k) {
    const double own = 0.01 + 0.3 * unit(random);
    LinearLoads model = loads_of({0.1, 0.1, 0.1, 0.1}, own, 0.3 * unit(random));
    for (double& load : model.loads) load += (k % 2 == 0 ? 0.1 : 0.004) * unit(random);
    const auto advances = linear_front(model, error);
    ASSERT_TRUE(advances) << k;
    expect_front(model, *advances);
  }
}

TEST(LinearFront, WhereLoadsRiseWithLengthsThereIsNone) { EXPECT_FALSE(linear_front(loads_of({0.1}, -0.2, 0), error)); }

}  // namespace
}  // namespace sprekk::fine_fracture
