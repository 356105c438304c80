// Quantities with units, and expressions of x, y, t.
#pragma once

#include <string>

#include "framework/config/data.hpp"
#include "framework/config/input_error.hpp"

namespace sprekk {

/// The value in SI units of "40 GPa", "5e-20 m^2", "1 deg", "30 h", "0.7 MPa*m^0.5", "2" where `unit` is the SI unit
/// expected ("" for a plain number; "rad" for angles). A plain number is taken as SI. Throws InputError when the
/// dimension differs, the unit is unknown, or the number is not finite.
double parse_quantity(const std::string& text, const std::string& unit, const Origin& where);

/// A number with a unit, or an expression of x, y (m) and t (s) with an optional unit behind it:
/// "20 MPa", "(1 + 0.1*sin(pi*x)) MPa", "if(t < 6*h, 0, 5e-9)". Throws InputError for anything malformed.
Data parse_data(const std::string& text, const std::string& unit, const Origin& where);

}  // namespace sprekk
