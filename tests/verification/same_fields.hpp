// Compares two runs of one scene field by field.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>

#include "tests/verification/scene_run.hpp"

namespace sprekk::testing {

/// Fields of one unit are compared with the largest of them: where a jump is zero, its size is that of displacements.
inline void expect_same_fields(SceneRun& a, SceneRun& b, double tolerance) {
  std::map<std::string, double> scale;
  for (const auto& field : a.model().fields().all())
    if (field->size() > 0) {
      double& s = scale[field->spec().unit];
      s = std::max(s, field->now().lpNorm<Eigen::Infinity>());
    }
  for (const auto& field : a.model().fields().all()) {
    if (field->size() == 0) continue;
    const Vector difference = field->now() - b.field(field->name());
    EXPECT_LE(difference.lpNorm<Eigen::Infinity>(), tolerance * scale[field->spec().unit]) << field->name();
  }
}

}  // namespace sprekk::testing
