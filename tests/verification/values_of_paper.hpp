// The wings of section 5.2 of the paper with its values.
#pragma once

#include <vector>

#include "framework/config/yaml/load_scene.hpp"

namespace sprekk::testing {

/// Overrides for configs/paper/wing_cracks.yaml, which has longer steps and increments and coarser rock, where it costs
/// least for its error: the steps and sizes of the paper, an increment of half a fracture cell, and fronts that are
/// found to the default tolerance. `more` comes last.
inline std::vector<Override> with_values_of_paper(const std::vector<Override>& more = {}) {
  std::vector<Override> all = {{"time.step", "1 h"},
                               {"mesh.size", "0.1 m"},
                               {"mesh.growth", "0.2"},
                               {"components.tips.size", "0.5 m"},
                               {"components.tips.growth", "{increment: 10 mm, front_tolerance: null}"}};
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

}  // namespace sprekk::testing
