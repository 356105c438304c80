#include "framework/picture/colours.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace sprekk {

LineStyle line_style(int i) {
  static const std::array<const char*, 8> colours = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                                     "#000000", "#56b4e9", "#e69f00", "#808080"};
  static const std::array<const char*, 4> dashes = {"", "6 3", "2 2", "8 3 2 3"};
  const int n = static_cast<int>(colours.size());
  return {colours[static_cast<std::size_t>(i % n)], dashes[static_cast<std::size_t>(i / n) % dashes.size()]};
}

std::string viridis(double fraction) {
  static const std::array<std::array<double, 3>, 9> stops = {{{68, 1, 84},
                                                              {71, 44, 122},
                                                              {59, 81, 139},
                                                              {44, 113, 142},
                                                              {33, 144, 141},
                                                              {39, 173, 129},
                                                              {92, 200, 99},
                                                              {170, 220, 50},
                                                              {253, 231, 37}}};
  const double position = std::clamp(fraction, 0.0, 1.0) * (stops.size() - 1);
  const std::size_t i = std::min(static_cast<std::size_t>(position), stops.size() - 2);
  const double rest = position - static_cast<double>(i);
  std::array<int, 3> rgb{};
  for (std::size_t k = 0; k < 3; ++k)
    rgb[k] = static_cast<int>(std::lround(stops[i][k] * (1 - rest) + stops[i + 1][k] * rest));
  return fmt::format("#{:02x}{:02x}{:02x}", rgb[0], rgb[1], rgb[2]);
}

}  // namespace sprekk
