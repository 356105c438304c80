// Thins curves of very many points to what can be seen.
#pragma once

#include "framework/picture/curve.hpp"

namespace sprekk {

/// Divides the points into `bins` equal groups, and keeps the first, lowest, highest and last point of each, in their
/// order: a picture of that many pixels shows no more. Short curves, and gaps, stay as they are.
Curve thinned(const Curve& curve, std::size_t bins = 600);

}  // namespace sprekk
