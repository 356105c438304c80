// Apertures where fractures meet: against closed forms of channels, arms that are closed.
#include "components/fracture_flow/tpfa/junction_apertures.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace sprekk::fracture_flow {
namespace {

constexpr double length = 1;

/// w = mouth + slope s at the distance s from the junction.
struct Arm {
  double mouth, slope;
  double at(double s) const { return mouth + slope * s; }
  /// Int ds/w^3 from the junction.
  double resistance(double s) const {
    return slope == 0 ? s / std::pow(mouth, 3) : (1 / (mouth * mouth) - 1 / (at(s) * at(s))) / (2 * slope);
  }
};

/// 1 over the conductance between the centre of the last cell and the junction, of n cells an arm.
std::vector<double> resistances(const std::vector<Arm>& arms, const std::vector<int>& partners, int n) {
  const double h = 0.5 * length / n;
  const auto cell = [&](const Arm& arm, int k) {
    const double w = arm.at((2 * k + 1) * h);
    return CellAperture{h, w, w};
  };
  std::vector<CellAperture> first;
  for (const Arm& arm : arms) first.push_back(cell(arm, 0));
  const std::vector<ArmAperture> mouths = junction_apertures(first, partners);
  std::vector<double> all;
  for (std::size_t i = 0; i < arms.size(); ++i) {
    double sum = h / std::pow(mouths[i].value, 3);
    for (int k = 0; k + 1 < n; ++k)
      for (const HalfCellAperture& half : half_cell_apertures(cell(arms[i], k), cell(arms[i], k + 1)))
        sum += h / std::pow(half.value, 3);
    all.push_back(sum);
  }
  return all;
}

/// Fluxes out of the arms at these pressures through a star.
std::vector<double> star(const std::vector<double>& resistances, const std::vector<double>& pressures) {
  double sum = 0, weighted = 0;
  for (std::size_t i = 0; i < pressures.size(); ++i) {
    sum += 1 / resistances[i];
    weighted += pressures[i] / resistances[i];
  }
  std::vector<double> fluxes;
  for (std::size_t i = 0; i < pressures.size(); ++i) fluxes.push_back((pressures[i] - weighted / sum) / resistances[i]);
  return fluxes;
}

struct Network {
  std::string name;
  std::vector<Arm> arms;
  std::vector<int> partners;  ///< without a partner: -1
};

class LinearChannels : public ::testing::TestWithParam<Network> {};

// Steady flow by the cubic law, 12 mu = 1.
TEST_P(LinearChannels, CarryTheFlowOfTheClosedFormWithSecondOrder) {
  const Network& network = GetParam();
  const std::vector<double> pressures = {3, -1, 0.5, 2};
  const std::size_t count = network.arms.size();
  double before = 0;
  for (const int n : {8, 16, 32}) {
    std::vector<double> exact;
    for (const Arm& arm : network.arms) exact.push_back(arm.resistance(length - 0.5 * length / n));
    const std::vector<double> at_ends(pressures.begin(), pressures.begin() + static_cast<long>(count));
    const std::vector<double> right = star(exact, at_ends),
                              ours = star(resistances(network.arms, network.partners, n), at_ends);
    double error = 0, largest = 0, sum = 0;
    for (std::size_t i = 0; i < count; ++i) {
      error = std::max(error, std::abs(ours[i] - right[i]));
      largest = std::max(largest, std::abs(right[i]));
      sum += ours[i];
    }
    EXPECT_NEAR(sum, 0, 1e-14 * largest);
    EXPECT_LT(error, 4 * largest / n / n);
    if (before > 0) {
      EXPECT_GT(before / error, 3.4) << n;
    }
    before = error;
    // The same with the arms in another order.
    std::vector<Arm> arms(network.arms.rbegin(), network.arms.rend());
    std::vector<int> partners;
    for (auto p = network.partners.rbegin(); p != network.partners.rend(); ++p)
      partners.push_back(*p < 0 ? -1 : static_cast<int>(count) - 1 - *p);
    const std::vector<double> turned = resistances(arms, partners, n),
                              straight = resistances(network.arms, network.partners, n);
    for (std::size_t i = 0; i < count; ++i) EXPECT_EQ(turned[count - 1 - i], straight[i]);
  }
}

INSTANTIATE_TEST_SUITE_P(
    , LinearChannels,
    ::testing::Values(
        // A fracture that goes on, with another one that ends on it, or crosses it, or meets two more.
        Network{"T", {{1, 0.4}, {1, -0.4}, {0.5, 0.3}}, {1, 0, -1}},
        Network{"X", {{1, 0.4}, {1, -0.4}, {0.6, -0.2}, {0.6, 0.2}}, {1, 0, 3, 2}},
        Network{"Star", {{1, -0.5}, {0.7, 0.2}, {0.4, 0.4}}, {-1, -1, -1}},
        Network{"Widening", {{0.8, 0.4}, {0.8, 0.4}, {0.8, 0.4}}, {-1, -1, -1}}),
    [](const auto& info) { return info.param.name; });

TEST(JunctionApertures, OfTwoCellsAreThoseOfAFractureThatGoesOn) {
  const CellAperture first{0.3, 1e-3, 8e-4}, second{0.1, 4e-4, 1e-4};
  const auto halves = half_cell_apertures(first, second);
  const std::vector<ArmAperture> arms = junction_apertures({first, second}, {1, 0});
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(arms[i].value, halves[i].value);
    EXPECT_EQ(arms[i].by_aperture[i], halves[i].by_aperture[i]);
    EXPECT_EQ(arms[i].by_aperture[1 - i], halves[i].by_aperture[1 - i]);
  }
}

TEST(JunctionApertures, LetFluidIntoArmsThatAreClosedAndLeaveTheOthersAlone) {
  for (const double initial : {0.0, 1e-6}) {
    const auto cell = [&](double opening) { return CellAperture{0.05, initial + opening, opening}; };
    const std::vector<CellAperture> cells = {cell(1e-4), cell(1e-4), cell(0), cell(0)};
    const std::vector<ArmAperture> arms = junction_apertures(cells, {1, 0, 3, 2});
    EXPECT_EQ(arms[0].value, initial + 1e-4);
    EXPECT_EQ(arms[1].value, initial + 1e-4);
    EXPECT_DOUBLE_EQ(arms[2].value, initial + 1e-5);
    EXPECT_DOUBLE_EQ(arms[3].value, initial + 1e-5);
    // If all arms are closed none is widened.
    for (const ArmAperture& arm : junction_apertures({cell(0), cell(0), cell(0)}, {1, 0, -1}))
      EXPECT_EQ(arm.value, initial);
  }
}

TEST(JunctionApertures, HaveTheDerivativesOfTheirValues) {
  const std::vector<int> partners = {1, 0, -1, -1};
  const auto at = [&](const std::vector<double>& openings) {
    std::vector<CellAperture> cells;
    for (int i = 0; i < 4; ++i) cells.push_back({0.05 + 0.01 * i, 0.2 + openings[i], openings[i]});
    return junction_apertures(cells, partners);
  };
  constexpr double step = 1e-6;
  for (const std::vector<double>& openings :
       {std::vector<double>{1, 0.5, 0.3, 0.01}, {0.02, 0.01, 1, 0.4}, {0.6, 0.7, 0, 0.1}})
    for (int k = 0; k < 4; ++k) {
      std::vector<double> more = openings, less = openings;
      more[k] += step;
      less[k] -= step;
      const auto arms = at(openings), up = at(more), down = at(less);
      for (int i = 0; i < 4; ++i)
        EXPECT_NEAR(arms[i].by_aperture[k], (up[i].value - down[i].value) / (2 * step), 1e-9) << i << " by " << k;
    }
}

}  // namespace
}  // namespace sprekk::fracture_flow
