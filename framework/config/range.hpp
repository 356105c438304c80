// The values that a parameter may take.
#pragma once

#include <limits>
#include <string>

namespace sprekk {

/// An interval of the values that a number may take; bounds in SI units.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_allowed = true;
  bool high_allowed = true;
  bool contains(double value) const;
  std::string text() const;  ///< "> 0", "from 0 to 1", …
};
Range positive();                                 ///< > 0
Range non_negative();                             ///< >= 0
Range between(double low, double high);           ///< both ends allowed
Range strictly_between(double low, double high);  ///< neither end allowed

}  // namespace sprekk
