#include "framework/mesh/distinct_text.hpp"

#include <limits>
#include <sstream>

namespace sprekk {
namespace {

std::string text_of(const Point& point, int digits) {
  std::ostringstream out;
  out.precision(digits);
  out << '(' << point.x() << ", " << point.y() << ')';
  return out.str();
}

}  // namespace

std::string distinct_text(const Point& point, const Point& other) {
  int digits = std::numeric_limits<float>::digits10;
  while (digits < std::numeric_limits<double>::max_digits10 && text_of(point, digits) == text_of(other, digits))
    ++digits;
  return text_of(point, digits);
}

}  // namespace sprekk
