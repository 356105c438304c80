// Apertures of half cells: order of convergence, jumps of the initial aperture, cells that are closed.
#include "components/fracture_flow/tpfa/half_cell_apertures.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

namespace sprekk::fracture_flow {
namespace {

/// The sum of h/a^3 over the half cells between the centres of the first and the last cell: with equal fluxes the drop
/// of pressure over 12 mu q.
double resistance(const std::vector<double>& edges, const std::function<double(double)>& initial,
                  const std::function<double(double)>& opening) {
  double sum = 0;
  const auto cell = [&](std::size_t i) {
    const double middle = 0.5 * (edges[i] + edges[i + 1]);
    return CellAperture{0.5 * (edges[i + 1] - edges[i]), initial(middle) + opening(middle), opening(middle)};
  };
  for (std::size_t i = 0; i + 2 < edges.size(); ++i) {
    const CellAperture first = cell(i), second = cell(i + 1);
    const auto halves = half_cell_apertures(first, second);
    sum += first.half_length / std::pow(halves[0].value, 3) + second.half_length / std::pow(halves[1].value, 3);
  }
  return sum;
}

/// Cells of an even size, or of sizes that alternate by 1:3.
std::vector<double> edges_of(int cells, double unevenness) {
  std::vector<double> edges;
  for (int i = 0; i <= cells; ++i) edges.push_back((i + (i % 2) * unevenness) / cells);
  return edges;
}

TEST(HalfCellApertures, are_of_second_order_where_the_opening_is_smooth) {
  // a = 1 + x^2 with a part of it initial: Int dx/(1 + x^2)^3 = x/(4 (1 + x^2)^2) + 3 x/(8 (1 + x^2)) + 3/8 atan x.
  const auto integral = [](double x) {
    const double r = 1 + x * x;
    return x / (4 * r * r) + 3 * x / (8 * r) + 0.375 * std::atan(x);
  };
  for (const double part : {0.0, 0.7})  // of the aperture that is initial
    for (const double unevenness : {0.0, -0.5}) {
      double before = 0;
      for (const int cells : {20, 40, 80}) {
        const std::vector<double> edges = edges_of(cells, unevenness);
        const double from = 0.5 * (edges[0] + edges[1]), to = 0.5 * (edges[cells - 1] + edges[cells]);
        const double error = std::abs(resistance(
                                          edges, [&](double x) { return part * (1 + x * x); },
                                          [&](double x) { return (1 - part) * (1 + x * x); }) /
                                          (integral(to) - integral(from)) -
                                      1);
        EXPECT_LT(error, 10.0 / cells / cells);
        if (before > 0) {
          EXPECT_GT(before / error, 3.4) << part << " " << unevenness << " " << cells;
        }
        before = error;
      }
    }
}

TEST(HalfCellApertures, are_those_of_the_cells_where_nothing_opens) {
  const auto halves = half_cell_apertures({0.3, 1e-3, 0}, {0.1, 1e-5, 0});
  EXPECT_EQ(halves[0].value, 1e-3);
  EXPECT_EQ(halves[1].value, 1e-5);
}

TEST(HalfCellApertures, an_open_cell_lets_fluid_into_a_closed_one) {
  for (const double initial : {0.0, 1e-6}) {
    const auto halves = half_cell_apertures({0.25, initial + 1e-4, 1e-4}, {0.25, initial, 0});
    EXPECT_DOUBLE_EQ(halves[0].value, initial + 0.75e-4);
    EXPECT_DOUBLE_EQ(halves[1].value, initial + 0.25e-4);
  }
}

TEST(HalfCellApertures, have_the_derivatives_of_their_differences) {
  const CellAperture first{0.3, 2e-4, 1.5e-4}, second{0.1, 5e-5, 4e-5};
  const auto halves = half_cell_apertures(first, second);
  const double step = 1e-8;
  CellAperture more = first;
  more.aperture += step;
  more.opening += step;
  const auto by_first = half_cell_apertures(more, second);
  more = second;
  more.aperture += step;
  more.opening += step;
  const auto by_second = half_cell_apertures(first, more);
  for (int i = 0; i < 2; ++i) {
    EXPECT_NEAR((by_first[i].value - halves[i].value) / step, halves[i].by_aperture[0], 1e-7);
    EXPECT_NEAR((by_second[i].value - halves[i].value) / step, halves[i].by_aperture[1], 1e-7);
  }
}

}  // namespace
}  // namespace sprekk::fracture_flow
