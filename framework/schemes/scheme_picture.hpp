// Pictures of schemes and of maps over parameters, as SVG.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "framework/schemes/scheme_result.hpp"

namespace sprekk {

/// The groups of a scheme as boxes, in their order, with the way that a pass takes.
std::string scheme_svg(const Scheme& scheme);

/// A map of one number, dark where it is small, bright where it is large, grey where there is none.
struct MapFigure {
  std::string name;                                  ///< "passes"
  std::optional<double> (*of)(const SchemeResult&);  ///< nothing where a run does not converge
  double bright;                                     ///< numbers from here on are bright; 0: from the largest on
};

/// The passes of a map's runs, its measured and its predicted factors.
const std::vector<MapFigure>& map_figures();

std::string map_svg(const AtlasMap& map, const MapFigure& figure);

}  // namespace sprekk
