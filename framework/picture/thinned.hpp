// Curves of very many points, as far as they can be seen.
#pragma once

#include "framework/picture/line_plot.hpp"

namespace sprekk {

/// Of each of `bins` equal groups of points the first, the lowest, the highest and the last, in their order: what a
/// picture of that many pixels can show. Short curves, and gaps, stay as they are.
Curve thinned(const Curve& curve, std::size_t bins = 600);

}  // namespace sprekk
