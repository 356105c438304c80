// A flow in a square of bent triangles or quadrilaterals, in a plane and extruded in space, and what MPFA makes of it.
#pragma once

#include <array>
#include <cmath>
#include <vector>

namespace sprekk::test {

/// 4 × 4 quadrilaterals, or two triangles in place of each.
struct BentSquare {
  static constexpr int count = 4;
  std::vector<std::array<double, 2>> nodes;
  std::vector<std::vector<int>> cells;  ///< counter-clockwise

  explicit BentSquare(bool has_triangles) {
    for (int j = 0; j <= count; ++j)
      for (int i = 0; i <= count; ++i) {
        const double inside = i % count != 0 && j % count != 0 ? 0.07 : 0;
        nodes.push_back({0.25 * i + inside * std::sin(3.0 * i + 5 * j), 0.25 * j + inside * std::cos(2.0 * i - 3 * j)});
      }
    for (int j = 0; j < count; ++j)
      for (int i = 0; i < count; ++i) {
        const int a = i + (count + 1) * j, b = a + 1, c = b + count + 1, d = c - 1;
        if (has_triangles) {
          cells.push_back({a, b, c});
          cells.push_back({a, c, d});
        } else {
          cells.push_back({a, b, c, d});
        }
      }
  }

  /// The side on which an edge lies: 0 to 3 for x = 0, x = 1, y = 0, y = 1; -1 inside.
  int side_of(int one, int other) const {
    const auto at = [&](int axis, double place) { return nodes[one][axis] == place && nodes[other][axis] == place; };
    for (int side = 0; side < 4; ++side)
      if (at(side / 2, side % 2)) return side;
    return -1;
  }

  // The mobility (xx, yy, xy), the pressure at x = 0 and 1, the flux density out at y = 0 and 1, and the source.
  static constexpr double xx = 1.5, yy = 0.4, xy = 0.6;
  static double pressure(double x, double y) { return x + 2 * y; }
  static double outflow(double y) { return y == 0 ? -0.3 : 0.2; }
  static double source(double x, double y) { return 1 + x * y; }
};

/// Pressures of the cells by MPFA in a plane.
inline const std::vector<double>& answer_in_plane(bool has_triangles) {
  static const std::vector<double> triangles{
      0.958261146269885, 0.560192290840057, 1.49817784111131,  1.12381798331291,  1.52809545275671, 1.61674840226255,
      1.31626137954649,  1.46183244492208,  0.939544276600268, 0.922379585723293, 1.26999271930997, 1.27696493481072,
      1.66238797706311,  1.58329631147283,  1.65842961878731,  1.85118846015495,  1.3058100182371,  1.39515655353633,
      1.63406182428931,  1.62287658477453,  1.88897316512349,  1.91342556951863,  2.19019268879419, 2.21351531004748,
      1.64774334432931,  1.75555403728305,  1.70553028516584,  1.68959830344313,  2.0815248339563,  1.85072694737609,
      2.52999523007518,  2.31955740629482};
  static const std::vector<double> quadrilaterals{
      0.874368592571173, 1.39734271789108, 1.67105024281679, 1.35434515432448, 0.912028089927427, 1.31308285075574,
      1.68445062774632,  1.80520639057884, 1.32750454354578, 1.6029849410289,  1.89523766574351,  2.22403460303558,
      1.70519949699557,  1.6316306775771,  1.92052960985013, 2.394990227396};
  return has_triangles ? triangles : quadrilaterals;
}

}  // namespace sprekk::test
