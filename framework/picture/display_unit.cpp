#include "framework/picture/display_unit.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>

namespace sprekk {
namespace {

using Step = std::pair<double, const char*>;  // SI value, name

// From large to small. A unit is taken when the largest number is at least half of it; times are taken from two on.
constexpr std::array<Step, 8> times = {{{365.25 * 86400, "a"},
                                        {86400, "d"},
                                        {3600, "h"},
                                        {60, "min"},
                                        {1, "s"},
                                        {1e-3, "ms"},
                                        {1e-6, "µs"},
                                        {1e-9, "ns"}}};
constexpr std::array<Step, 5> lengths = {{{1e3, "km"}, {1, "m"}, {1e-3, "mm"}, {1e-6, "µm"}, {1e-9, "nm"}}};
constexpr std::array<Step, 5> pascals = {{{1e9, "GPa"}, {1e6, "MPa"}, {1e3, "kPa"}, {1, "Pa"}, {1e-3, "mPa"}}};

const Step& fitting(std::span<const Step> steps, double largest, double from) {
  for (const Step& step : steps)
    if (largest >= from * step.first) return step;
  return steps.back();
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
  return text;
}

std::string superscript(int number) {
  static const std::array<const char*, 10> digits = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text;
  for (const char c : std::to_string(number)) text += c == '-' ? "⁻" : digits[static_cast<std::size_t>(c - '0')];
  return text;
}

}  // namespace

std::string power_of_ten(int exponent) { return "10" + superscript(exponent); }

std::string pretty_unit(const std::string& unit) {
  std::string text = unit == "1" ? "" : unit;
  text = replaced(text, "m^0.5", "√m");
  for (int power = -3; power <= 3; ++power) text = replaced(text, "^" + std::to_string(power), superscript(power));
  return replaced(text, "*", "·");
}

DisplayUnit display_unit(const std::string& si_unit, double largest) {
  if (!(largest > 0) || !std::isfinite(largest)) return {1, pretty_unit(si_unit)};
  if (si_unit == "s") {
    constexpr double years_from = 3 * 365.25 * 86400, days_from = 10 * 86400, minutes_from = 120;
    const std::size_t skipped = largest >= years_from ? 0 : largest >= days_from ? 1 : largest >= minutes_from ? 2 : 4;
    const Step& step = fitting(std::span<const Step>(times).subspan(skipped), largest, skipped < 4 ? 2 : 0.5);
    return {step.first, step.second};
  }
  if (si_unit == "m") {
    const Step& step = fitting(lengths, largest, 0.5);
    return {step.first, step.second};
  }
  if (si_unit.rfind("Pa", 0) == 0 && (si_unit.size() == 2 || si_unit[2] == '*' || si_unit[2] == '/')) {
    const Step& step = fitting(pascals, largest, 0.5);
    return {step.first, step.second + pretty_unit(si_unit.substr(2))};
  }
  if (si_unit == "rad") return {std::numbers::pi / 180, "°"};
  const std::string unit = pretty_unit(si_unit);
  if (largest >= 1e-2 && largest < 1e5) return {1, unit};
  const int exponent = static_cast<int>(std::floor(std::log10(largest)));
  return {std::pow(10.0, exponent), power_of_ten(exponent) + (unit.empty() ? "" : " " + unit)};
}

ColumnName column_name(const std::string& column) {
  const std::size_t bracket = column.rfind('[');
  if (bracket == std::string::npos || column.back() != ']') return {column, ""};
  const std::string unit = column.substr(bracket + 1, column.size() - bracket - 2);
  return {column.substr(0, bracket), unit == "1" ? "" : unit};
}

std::string display_text(double value, const std::string& si_unit, int digits) {
  return display_text(value, display_unit(si_unit, std::isfinite(value) ? std::abs(value) : 0), digits);
}

std::string display_text(double value, const DisplayUnit& unit, int digits) {
  if (!std::isfinite(value)) return "–";
  const std::string number = fmt::format("{:.{}g}", value / unit.scale, digits);
  if (unit.text.rfind("10", 0) == 0) return number + "·" + unit.text;
  return unit.text.empty() ? number : number + " " + unit.text;
}

}  // namespace sprekk
