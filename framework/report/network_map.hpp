// Many fractures in their places, coloured by a value: where a curve for each would be too many.
#pragma once

#include <string>
#include <vector>

#include "framework/picture/display_unit.hpp"
#include "framework/picture/line_plot.hpp"
#include "framework/report/fracture_path.hpp"

namespace sprekk {

/// The paths with colours by classes of values with as many cells each, which the legend names; what has no finite
/// value is grey. `values`: one for each cell of the grid of the paths, in SI units.
Panel network_map(const std::vector<FracturePath>& paths, const std::vector<double>& values, const std::string& title,
                  const DisplayUnit& unit);

}  // namespace sprekk
