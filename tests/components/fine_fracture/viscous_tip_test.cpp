// The opening near a moving tip: both ends in closed form, and between them the table that is computed without Sprekk.
#include "components/fine_fracture/growth/viscous_tip.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace sprekk::fine_fracture {
namespace {

/// Rows (s, w, mean of w) of the table, in units in which K', E' and mu' V are 1.
std::vector<std::vector<double>> table() {
  std::ifstream file(SPREKK_SOURCE_DIR "/tests/verification/references/near_tip.csv");
  std::vector<std::vector<double>> rows;
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || !std::isdigit(line[0])) continue;
    std::vector<double> row;
    std::istringstream cells(line);
    for (std::string cell; std::getline(cells, cell, ',');) row.push_back(std::stod(cell));
    rows.push_back(row);
  }
  return rows;
}

const double unit_toughness = std::sqrt(M_PI / 2) / 4;  // K' = 1

TEST(ViscousTip, is_that_of_the_table_between_toughness_and_viscosity) {
  const ViscousTip tip{unit_toughness, 1, 1.0 / 12};
  const auto rows = table();
  ASSERT_GT(rows.size(), 20U);
  for (const auto& row : rows) {
    EXPECT_NEAR(tip.opening(row[0], 1) / row[1], 1, 1.3e-3) << row[0];
    EXPECT_NEAR(tip.mean_opening(row[0], 1) / row[2], 1, 1.3e-3) << row[0];
  }
}

TEST(ViscousTip, has_both_ends_in_other_units) {
  const double e = 32e9, k = 1.3e6, mu = 2e-3;
  const ViscousTip tough{k, e, mu}, viscous{0, e, mu};
  for (const double h : {1e-3, 0.7}) {
    // At rest 2/3 (K'/E') sqrt(h); without toughness 3/5 (2·3^2.5 mu' V/E')^(1/3) h^(2/3).
    const double at_rest = 2.0 / 3 * 4 * std::sqrt(2 / M_PI) * k / e * std::sqrt(h);
    EXPECT_NEAR(tough.mean_opening(h, 0) / at_rest, 1, 1e-12);
    EXPECT_EQ(tough.apparent_toughness(h, 0), 1);
    const double moving = 0.6 * std::cbrt(2 * std::pow(3, 2.5) * 12 * mu * 0.4 / e) * std::cbrt(h * h);
    EXPECT_NEAR(viscous.mean_opening(h, 0.4) / moving, 1, 1e-6);
    // So fast or long that toughness has no part.
    EXPECT_NEAR(tough.mean_opening(1e8, 1e3) / viscous.mean_opening(1e8, 1e3), 1, 1e-3);
  }
}

TEST(ViscousTip, speed_is_the_inverse_and_rests_below_the_toughness) {
  const ViscousTip tip{1.3e6, 32e9, 2e-3};
  for (const double v : {1e-3, 0.1, 1.0, 30.0})
    for (const double h : {0.01, 0.5}) {
      const double factor = tip.apparent_toughness(h, v);
      EXPECT_GT(factor, 1);
      // The speed that follows from the opening is as accurate as round-off of the opening allows.
      EXPECT_NEAR(tip.speed(tip.mean_opening(h, v), h) / v, 1, 1e-13 / (factor - 1) + 1e-9) << v << " " << h;
    }
  EXPECT_EQ(tip.speed(tip.mean_opening(0.5, 0), 0.5), 0);
  EXPECT_EQ(tip.speed(0.3 * tip.mean_opening(0.5, 0), 0.5), 0);
  EXPECT_EQ(tip.speed(-1e-6, 0.5), 0);
}

}  // namespace
}  // namespace sprekk::fine_fracture
