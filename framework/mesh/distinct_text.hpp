// Places in messages that name two of them.
#pragma once

#include <string>

#include "framework/types.hpp"

namespace sprekk {

/// "(1.0000001, 2)": with as many digits as tell the point from another one, six at least.
std::string distinct_text(const Point& point, const Point& other);

}  // namespace sprekk
