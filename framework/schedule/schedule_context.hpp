// What the steps of a schedule are built from.
#pragma once

#include <string>
#include <vector>

#include "framework/assembly/part.hpp"
#include "framework/config/node.hpp"
#include "framework/schedule/newton.hpp"
#include "framework/schedule/schedule_step.hpp"

namespace sprekk {

struct ScheduleContext {
  const Mesh& mesh;
  FieldStore& fields;
  std::vector<Part*> parts;                  ///< all components and couplers
  std::vector<std::string> component_names;  ///< what a `solve` may name
  LinearOptions linear;
  NewtonOptions newton;
  IterationLog log;

  /// The solved fields of the named components: their unknowns, and their inputs that a coupler determines.
  std::vector<Field*> solved_fields(const std::vector<std::string>& components) const;
};

/// Builds the steps of a `schedule:` (a list of steps, run one after the other; one step needs no list).
/// Throws InputError for unknown steps and components.
std::unique_ptr<ScheduleStep> build_schedule(const Node& node, const ScheduleContext& context);

/// A kind of step, known by its key in the scene. Kinds register themselves.
using ScheduleFactory = std::unique_ptr<ScheduleStep> (*)(const Node& node, const ScheduleContext& context);
class Spec;
struct ScheduleKind {
  std::string key;
  ScheduleFactory build;
  Spec (*spec)();  ///< for `explain` and the schema
};
const std::vector<ScheduleKind>& schedule_kinds();

}  // namespace sprekk
