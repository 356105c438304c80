#include "framework/formula/jumps.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace sprekk::formula {
namespace {

/// Values at which a variable is tested, in SI units, from zero upwards, and then those below zero.
std::array<std::vector<double>, 2> tested_values() {
  constexpr int first_decade = -12, last_decade = 9;  // from apertures squared to moduli, in SI units
  constexpr int a_decade = 200;                       // steps of 1.2 %: pieces that are narrower are not seen
  std::vector<double> values = {0};
  for (int i = first_decade * a_decade; i <= last_decade * a_decade; ++i)
    values.push_back(std::pow(10, static_cast<double>(i) / a_decade));
  std::vector<double> below = values;
  for (double& value : below) value = -value;
  std::ranges::reverse(below);
  return {std::move(values), std::move(below)};
}

/// Neighbours in floating-point numbers between which the piece of the program changes, found between two values.
struct Threshold {
  double before, behind;
};

template <class Pieces>
Threshold threshold_between(double before, double behind, const Pieces& pieces) {
  const std::vector<double> first = pieces(before);
  for (;;) {
    const double middle = before + (behind - before) / 2;
    if (!(middle > before && middle < behind)) return {before, behind};
    (pieces(middle) == first ? before : behind) = middle;
  }
}

}  // namespace

std::optional<Jump> find_jump(const Program& program, std::size_t first, std::size_t count) {
  constexpr double of_others[] = {1.618e-3, 0.5772, 9.071e7};  // small, usual and large, and no round numbers
  constexpr double place = 1.4142;                             // m and s: no condition is likely to name it
  constexpr double round_off = 1e-9;                           // of the value: powers and functions of large arguments
  std::vector<double> at(count, place);
  if (program.pieces(at).empty()) return std::nullopt;
  const auto all_values = tested_values();
  for (std::size_t k = first; k < count; ++k) {
    if (!program.uses(static_cast<int>(k))) continue;
    for (const double other : of_others) {
      std::fill(at.begin() + static_cast<std::ptrdiff_t>(first), at.end(), other);
      const auto with = [&](double value) -> const std::vector<double>& {
        at[k] = value;
        return at;
      };
      const auto pieces = [&](double value) { return program.pieces(with(value)); };
      for (const std::vector<double>& values : all_values) {
        std::vector<double> last = pieces(values.front());
        for (std::size_t i = 1; i < values.size(); ++i) {
          std::vector<double> next = pieces(values[i]);
          if (next == last) continue;
          last = std::move(next);
          const auto [before, behind] = threshold_between(values[i - 1], values[i], pieces);
          const double from = program.at(with(before)), to = program.at(with(behind));
          if (!std::isfinite(from) || !std::isfinite(to)) continue;
          if (std::abs(to - from) > round_off * std::max(std::abs(from), std::abs(to)))
            return Jump{k, behind, from, to};
        }
      }
    }
  }
  return std::nullopt;
}

}  // namespace sprekk::formula
