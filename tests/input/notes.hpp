// The notes of a check or of a run of a scene in tests/input/base.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/input/program.hpp"

namespace sprekk::testing {

using Json = nlohmann::json;
using Settings = std::vector<std::string>;  ///< each as after --set

/// The words of a call of the program: COMMAND SCENE --set SETTING …
std::vector<std::string> call(const std::string& command, const std::string& scene, const Settings& settings);

/// What `check` says of a scene without mistakes: nothing but notes.
std::string notes_of_check(const std::string& scene, const Settings& settings);

/// A run that has succeeded.
struct Ended {
  Json record;  ///< run.json
  std::string err;
  /// The note whose topic holds this, or null.
  Json note(const std::string& topic) const;
  double result(const std::string& name) const { return record["results"][name]; }
};

/// A run without written fields; `more`: further words of the call.
Ended run_of(const std::string& scene, const Settings& settings, const std::vector<std::string>& more = {});

}  // namespace sprekk::testing
