// Numbers at the beginning of a text.
#pragma once

#include <optional>
#include <string>

namespace sprekk {

/// A decimal number at the beginning of a text, and the number of characters that it takes. `is_finite` is false for
/// infinities, NaN, and numbers beyond the range of a double.
struct LeadingNumber {
  double value = 0;
  std::size_t length = 0;
  bool is_finite = true;
};
std::optional<LeadingNumber> leading_number(const std::string& text);  ///< none where the text begins otherwise

/// "1e-17" for "1d-17", as Fortran writes it; "" for other texts.
std::string with_exponent_e(const std::string& text);

std::string trimmed(const std::string& text);  ///< without blanks at both ends

}  // namespace sprekk
