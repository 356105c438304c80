// Numbers for people: SI values in units of a sensible size.
#pragma once

#include <string>

namespace sprekk {

/// A unit in which values are shown: shown value = SI value / scale.
struct DisplayUnit {
  double scale = 1;
  std::string text;  ///< "MPa", "h", "10⁻⁹ m²/s"; "" for a plain number
};

/// The unit in which numbers up to `largest` (SI, an absolute value) are shown: "s" becomes h from two hours on, "Pa"
/// MPa, "m" mm, "rad" °; a unit that takes no prefix gets a power of ten when the numbers would be long.
DisplayUnit display_unit(const std::string& si_unit, double largest);

/// "m^2/s" as "m²/s", "Pa*m^0.5" as "Pa·√m".
std::string pretty_unit(const std::string& unit);

/// 10⁻⁹
std::string power_of_ten(int exponent);

/// The parts of a column's name "p_C[Pa]"; a unit "1", or none, stands for a plain number.
struct ColumnName {
  std::string quantity;
  std::string unit;  ///< SI, "" for a plain number
};
ColumnName column_name(const std::string& column);

/// "7.98 MPa": an SI value with `digits` significant digits; "–" if it is not finite.
std::string display_text(double value, const std::string& si_unit, int digits = 4);
/// The same in a unit that several values share.
std::string display_text(double value, const DisplayUnit& unit, int digits = 4);

}  // namespace sprekk
