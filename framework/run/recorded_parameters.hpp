// The parameters of a scene as run.json has them.
#pragma once

#include <vector>

#include "framework/output/run_record.hpp"
#include "framework/scene/scene.hpp"

namespace sprekk {

/// Each with its path, value and origin.
inline std::vector<RunRecord::Parameter> recorded_parameters(const Scene& scene) {
  std::vector<RunRecord::Parameter> parameters;
  for (const Scene::Resolved& r : scene.resolved) parameters.push_back({r.path, r.value, r.origin});
  return parameters;
}

}  // namespace sprekk
