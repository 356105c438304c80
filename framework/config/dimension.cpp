#include <fmt/format.h>

#include <cmath>

#include "framework/config/unit.hpp"
#include "framework/round_off.hpp"

namespace sprekk {
namespace {

struct NamedDimension {
  const char* name;
  Dimension dimension;
};

// Exponents of m, kg, s, K, rad.
const std::array<NamedDimension, 27> named_dimensions = {{
    {"plain number", {{0, 0, 0, 0, 0}}},
    {"length", {{1, 0, 0, 0, 0}}},
    {"area", {{2, 0, 0, 0, 0}}},
    {"volume", {{3, 0, 0, 0, 0}}},
    {"inverse length", {{-1, 0, 0, 0, 0}}},
    {"mass", {{0, 1, 0, 0, 0}}},
    {"density", {{-3, 1, 0, 0, 0}}},
    {"mass rate", {{0, 1, -1, 0, 0}}},
    {"time", {{0, 0, 1, 0, 0}}},
    {"rate", {{0, 0, -1, 0, 0}}},
    {"velocity", {{1, 0, -1, 0, 0}}},
    {"acceleration", {{1, 0, -2, 0, 0}}},
    {"area rate", {{2, 0, -1, 0, 0}}},
    {"volume rate", {{3, 0, -1, 0, 0}}},
    {"temperature", {{0, 0, 0, 1, 0}}},
    {"angle", {{0, 0, 0, 0, 1}}},
    {"pressure", {{-1, 1, -2, 0, 0}}},
    {"inverse pressure", {{1, -1, 2, 0, 0}}},
    {"pressure gradient", {{-2, 1, -2, 0, 0}}},
    {"pressure rate", {{-1, 1, -3, 0, 0}}},
    {"viscosity", {{-1, 1, -1, 0, 0}}},
    {"force", {{1, 1, -2, 0, 0}}},
    {"force per length", {{0, 1, -2, 0, 0}}},
    {"energy", {{2, 1, -2, 0, 0}}},
    {"power", {{2, 1, -3, 0, 0}}},
    {"stress intensity", {{-0.5, 1, -2, 0, 0}}},
    {"mobility", {{3, -1, 1, 0, 0}}},
}};

}  // namespace

bool Dimension::operator==(const Dimension& other) const {
  for (std::size_t i = 0; i < exponents.size(); ++i) {
    if (!(std::abs(exponents[i] - other.exponents[i]) < rounding::same)) return false;
  }
  return true;
}

std::string Dimension::name() const {
  for (const NamedDimension& named : named_dimensions) {
    if (named.dimension == *this) return named.name;
  }
  static const std::array<const char*, 5> base = {"m", "kg", "s", "K", "rad"};
  std::string result;
  for (std::size_t i = 0; i < exponents.size(); ++i) {
    if (exponents[i] == 0) continue;
    if (!result.empty()) result += "*";
    result += base[i];
    if (exponents[i] != 1) result += fmt::format("^{:.4g}", exponents[i]);
  }
  return result;
}

}  // namespace sprekk
