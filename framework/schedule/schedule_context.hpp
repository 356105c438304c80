// The input for reading and building the steps of a schedule.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "framework/assembly/part.hpp"
#include "framework/config/spec.hpp"
#include "framework/schedule/newton.hpp"
#include "framework/schedule/schedule_step.hpp"
#include "framework/schedule/time_scheme.hpp"

namespace sprekk {

/// The mesh, fields and parts of the model that a schedule is built for.
struct ScheduleContext {
  const Mesh& mesh;
  FieldStore& fields;
  std::vector<Part*> parts;  ///< all components and couplers
  IterationLog log;
  std::map<std::string, Part*> named = {};           ///< the components by their names in the scene
  double start_time = 0;                             ///< s, of the run
  double standard_step = 0;                          ///< s
  std::vector<class GrowStep*>* growing = nullptr;   ///< collects the steps that change the mesh
  std::vector<class KeepsState*>* states = nullptr;  ///< collects the steps that learn from time steps
  std::shared_ptr<const int> pass = nullptr;         ///< of the innermost iteration around a step, if there is one

  /// The solved fields of the named components: their unknowns, and their inputs that a coupler determines.
  std::vector<Field*> solved_fields(const std::vector<std::string>& components) const;
};

/// The scene as far as it is known when its `schedule:` is read, before there is a mesh.
struct ScheduleReading {
  std::vector<std::string> component_names;  ///< what a `solve` may name
  LinearOptions linear;                      ///< for a `solve` without options of its own
  NewtonOptions newton;
  ReadContext read;
  TimeScheme scheme = TimeScheme::backward_euler;
  bool is_in_stages = false;       ///< whether a step around it takes the stages of the scheme
  std::string waiting = "linear";  ///< course of the waiting fields during the stages of a step
  bool is_iterated = false;        ///< whether the step that is being read is inside an `iterate`
  bool may_be_inexact = false;     ///< whether the `iterate` around checks the residuals of all equations inside
  double tightest_until = 1;       ///< of the `iterate` around it: its `until: relative`
  bool is_substep = false;         ///< whether it is inside a `subcycle` of several substeps
  bool is_over_substeps = false;   ///< whether steps of the innermost `iterate` around it take substeps
  bool is_followed = false;        ///< whether a step that solves or grows stands behind it
};
/// Makes a step once the model is there.
using ScheduleBuilder = std::function<std::unique_ptr<ScheduleStep>(const ScheduleContext& context)>;

/// Reads the steps of a `schedule:` (a list of steps, run one after the other; one step needs no list). Throws
/// InputError for unknown steps and components; the builder that it returns throws InputError for a stabilization that
/// no part offers.
ScheduleBuilder read_schedule(const Node& node, const ScheduleReading& reading);
/// Whether there is a step of that kind, also inside of others.
bool has_step(const Node& schedule, const std::string& key);

/// A kind of step, known by its key in the scene.
struct ScheduleKind {
  std::string key;
  ScheduleBuilder (*read)(const Node& node, const ScheduleReading& reading);
  Spec (*spec)();  ///< for `explain` and the schema
};
const std::vector<ScheduleKind>& schedule_kinds();  ///< all kinds of steps

}  // namespace sprekk
