// Pictures of schemes and of maps over parameters, as SVG.
#pragma once

#include <string>

#include "framework/schemes/scheme_result.hpp"

namespace sprekk {

/// The groups of a scheme as boxes, in their order, with the way that a pass takes.
std::string scheme_svg(const Scheme& scheme);

/// The passes of a map's runs in colours: dark for few, bright for many, grey where a run does not converge.
std::string map_svg(const AtlasMap& map);

}  // namespace sprekk
