// Factors of a pass over one value of the scene: curves, and where they are smallest.
#pragma once

#include <string>
#include <vector>

#include "framework/picture/line_plot.hpp"
#include "framework/schemes/scheme_result.hpp"

namespace sprekk {

/// Where a factor is smallest.
struct Optimum {
  std::size_t place = 0;  ///< in the results of the map
  double factor = 0;
};

/// Nothing where there are no factors, or all are alike.
std::optional<Optimum> optimum(const AtlasMap& map, SchemeResult::Factor factor);

/// A head and a row for each scheme without acceleration: its smallest measured and predicted factor, and for which
/// values of the scene.
std::vector<std::vector<std::string>> optimum_rows(const std::vector<AtlasMap>& maps);

/// A panel for each split, over the values of the first axis (one set of curves for each value of the second): measured
/// factors as points, predicted ones as lines, one colour for each stabilization.
std::vector<Panel> factor_panels(const std::vector<AtlasMap>& maps);

/// The panels as a file.
std::string factors_svg(const std::vector<AtlasMap>& maps);

}  // namespace sprekk
