// Numbers at the beginning of a text.
#pragma once

#include <optional>
#include <string>

namespace sprekk {

/// A decimal number; `length` is what it takes of the text. Not a number: nothing. Infinite, NaN, or beyond the range
/// of a double: `is_finite` is false.
struct LeadingNumber {
  double value = 0;
  std::size_t length = 0;
  bool is_finite = true;
};
std::optional<LeadingNumber> leading_number(const std::string& text);

std::string trimmed(const std::string& text);  ///< without blanks at both ends

}  // namespace sprekk
