#include "framework/mesh/geometry.hpp"

#include <sstream>

namespace sprekk {

std::string to_text(const Point& point) {
  std::ostringstream out;
  const char* before = "(";
  for (const double coordinate : point) {
    out << before << coordinate;
    before = ", ";
  }
  out << ')';
  return out.str();
}

}  // namespace sprekk
