// Units and their dimensions.
#pragma once

#include <array>
#include <string>
#include <vector>

namespace sprekk {

/// Exponents of m, kg, s, K and rad. An angle has a dimension here, so that 30 deg is refused as a friction
/// coefficient.
struct Dimension {
  std::array<double, 5> exponents{};

  bool operator==(const Dimension& other) const;  ///< up to rounding of fractional exponents
  std::string name() const;                       ///< "pressure", else the product of SI units, "kg*m^-1"
};

/// A unit: its factor to SI units and its dimension.
struct Unit {
  double scale = 1;  ///< the unit in SI units
  Dimension dimension;

  Unit operator*(const Unit& other) const;
  Unit to_the(double power) const;
};

/// Thrown for a text that is no unit: the message of an InputError without the place in the scene.
struct UnitProblem {
  std::string problem, why, suggestion;
};

/// "GPa", "m^2/s", "1/Pa", "MPa*m^0.5", "J/(kg*K)", "m^(1/2)", "%", "" (a plain number). Throws UnitProblem.
Unit parse_unit(const std::string& text);

bool is_unit(const std::string& text);
/// The unit that a name which is none was probably to be: "MPa" for "Mpa"; "" where none is near.
std::string nearest_unit(const std::string& name);
/// Whether both texts are units, and of one dimension.
bool have_one_dimension(const std::string& unit, const std::string& other);

/// The length of the unit that stands at the beginning of a text, in an expression: of "h" in "h && x > 2", of "MPa/m"
/// in "MPa/m*y"; 0 for none.
std::size_t unit_length(const std::string& text);

/// Units of the same dimension that are easily written for this one: with other prefixes of its first name ("MPa*s" for
/// "mPa*s"), and degrees for radians. Not itself.
std::vector<std::string> units_like(const std::string& unit);

/// Units that are written as one word, with their SI values, for expressions: "h", "MPa", … Not t, which is the time.
const std::vector<std::pair<std::string, double>>& unit_constants();

}  // namespace sprekk
