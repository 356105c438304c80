// Places in messages that name two of them.
#pragma once

#include <limits>
#include <sstream>
#include <string>

#include "framework/types.hpp"

namespace sprekk {

/// "(1.0000001, 2)": with as many digits as tell the point from another one, six at least.
inline std::string distinct_text(const Point& point, const Point& other) {
  const auto text_of = [](const Point& x, int digits) {
    std::ostringstream out;
    out.precision(digits);
    for (int i = 0; i < dimension; ++i) out << (i == 0 ? "(" : ", ") << x[i];
    out << ')';
    return out.str();
  };
  int digits = std::numeric_limits<float>::digits10;
  while (digits < std::numeric_limits<double>::max_digits10 && text_of(point, digits) == text_of(other, digits))
    ++digits;
  return text_of(point, digits);
}

}  // namespace sprekk
