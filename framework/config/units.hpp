// Quantities with units, and expressions of place and time.
#pragma once

#include <string>

#include "framework/config/data.hpp"
#include "framework/config/input_error.hpp"

namespace sprekk {

/// The value in SI units of "40 GPa", "5e-20 m^2", "1 deg", "30 h", "0.7 MPa*m^0.5", "2" where `unit` is the SI unit
/// expected ("" for a plain number; "rad" for angles). Only 0, and lengths in m (lists of points), need no
/// unit: a modulus of 20 or an angle of 45 is a mistake. Throws InputError when the dimension differs, the unit is
/// unknown or missing, or the number is not finite. `name` is the parameter's, for messages.
double parse_quantity(const std::string& text, const std::string& unit, const Origin& where,
                      const std::string& name = "");

/// A number with a unit, or an expression of x, y (m), in space also z, and t (s) with an optional unit behind it:
/// "20 MPa", "(1 + 0.1*sin(pi*x)) MPa", "if(t < 6*h, 0, 5e-9)". Throws InputError for anything malformed.
///
/// An expression may have + - * / ^, comparisons, && and ||, if(condition, then, else), sin cos tan asin acos atan
/// atan2 sinh cosh tanh exp log (natural) log10 sqrt abs sign floor ceil pow erf erfc min max, the constants pi and e,
/// and units as their SI values (h, day, MPa, …). Without a unit behind it, the value of an expression is in SI units.
/// A unit behind an expression applies to the whole expression, which must then be in parentheses or be a single name,
/// number or function. An expression without a variable is a constant. For a quantity with a dimension, an expression
/// needs a unit as a number does: a constant must have the dimension, and any other expression must contain a unit or
/// have one behind it. `at` throws DataError where an expression has no finite value.
Data parse_data(const std::string& text, const std::string& unit, const Origin& where, const std::string& name = "");

/// Throws InputError for what looks like a number and is none: "1d-17", "1,5 m", a minus or a space of another script.
void require_plain_number(const std::string& text, const Origin& where, const std::string& name);

/// `value` (SI) as a scene would write it: "1000 kg/m^3".
std::string quantity_text(double value, const std::string& unit);

}  // namespace sprekk
