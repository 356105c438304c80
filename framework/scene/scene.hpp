// A scene that has been read: every parameter is checked, nothing is built yet.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "framework/assembly/notes.hpp"
#include "framework/config/spec.hpp"
#include "framework/frame_output/registry.hpp"
#include "framework/meshing/geometry.hpp"
#include "framework/scene/probe.hpp"
#include "framework/scene/registry.hpp"
#include "framework/scene/start_options.hpp"
#include "framework/schedule/newton.hpp"
#include "framework/schedule/schedule_context.hpp"
#include "framework/schedule/step_controller.hpp"

namespace sprekk {

/// Parameters of a scene's `output:`.
struct OutputOptions {
  std::optional<double> every;  ///< s
  std::vector<double> times;    ///< s
  bool splitting_error = true;
  std::optional<double> checkpoint_every;  ///< s of wall time
  std::map<std::string, ProbeOptions> probes;
  Spec spec();
  /// What is written at the times of output.
  std::vector<FrameOutputChoice> chosen_outputs() const;

 private:
  std::vector<FrameOutputChoice> outputs_;  ///< all that are registered
};

/// A scene with checked parameters, and builders for its parts and its schedule.
struct Scene {
  /// A component of the scene, not built yet.
  struct ComponentEntry {
    std::string name, type;
    Origin origin;
    ComponentBuilder build;
  };
  /// A coupler of the scene, not built yet, and the names of the components that it stands between.
  struct CouplerEntry {
    std::string name, type;
    Origin origin;
    std::vector<std::string> between;
    CouplerBuilder build;
  };
  /// A parameter with its value and the origin of the value, for `show` and run.json.
  struct Resolved {
    std::string path, value, origin;
  };

  std::string name;
  std::string folder;  ///< in which tables and mesh files are looked for
  Node whole;
  Geometry geometry;
  MeshOptions mesh;
  std::vector<ComponentEntry> components;
  std::vector<CouplerEntry> couplers;
  ScheduleBuilder schedule;
  TimeOptions time;
  StartOptions start;
  OutputOptions output;
  NewtonOptions newton;
  LinearOptions linear;
  std::vector<Resolved> resolved;
  Notes notes;  ///< on valid input that may be a mistake

  const Origin& schedule_origin() const { return whole.find("schedule")->origin; }
};

/// Reads the tree of a scene. Files of tables are in `folder`; `default_name` is the name of a scene without one.
/// Throws InputError for every mistake that can be found without a mesh.
Scene read_scene(const Node& whole, const std::string& folder, const std::string& default_name = "scene");

/// The specs of a scene's sections, by key, with their defaults; for `explain` and the schema.
std::vector<Spec> scene_section_specs();

}  // namespace sprekk
