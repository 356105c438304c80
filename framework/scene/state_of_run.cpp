#include "framework/scene/state_of_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "framework/assembly/counts_from_here.hpp"
#include "framework/assembly/keeps_state.hpp"
#include "framework/assembly/keeps_totals.hpp"
#include "framework/config/input_error.hpp"
#include "framework/mesh/topology_hash.hpp"
#include "framework/output/checkpoint.hpp"

namespace sprekk {
namespace {

using Parameters = std::map<std::string, std::string>;  ///< values by path

/// The record and the checkpoint of another run.
struct OtherRun {
  std::filesystem::path folder, file;
  Checkpoint checkpoint;
  Parameters parameters;
};

InputError unfit(const Model& model, const std::string& problem, const std::string& why,
                 const std::string& suggestion) {
  return {model.scene().start.origin, problem, why, suggestion};
}

Parameters parameters_of(const std::filesystem::path& run_json) {
  std::ifstream file(run_json);
  const auto record = nlohmann::json::parse(file, nullptr, false);
  const nlohmann::json::json_pointer place("/scene/parameters");
  Parameters parameters;
  if (!record.is_discarded() && record.contains(place))
    for (const auto& [path, value] : record.at(place).items()) parameters[path] = value.value("value", "");
  return parameters;
}

OtherRun read_run(const std::string& from, const Model& model) {
  OtherRun run;
  std::error_code error;
  run.file = from;
  if (std::filesystem::is_directory(run.file, error)) run.file /= "checkpoint.h5";
  run.folder = run.file.parent_path();
  const std::string suggestion =
      "give the folder of the results of a run that has ended, relative to the working directory";
  if (!std::filesystem::exists(from, error))
    throw unfit(model, "the run does not start from '" + from + "'", "there is no such folder or file", suggestion);
  if (!std::filesystem::is_regular_file(run.file, error))
    throw unfit(model, "the run does not start from '" + from + "'", "it has no checkpoint.h5", suggestion);
  run.parameters = parameters_of(run.folder / "run.json");
  if (run.parameters.empty())
    throw unfit(model, "the run does not start from '" + from + "'",
                "beside the checkpoint there is no run.json with the parameters of its scene", suggestion);
  try {
    run.checkpoint = read_checkpoint(run.file);
  } catch (const InputError& problem) {
    throw unfit(model, "the run does not start from '" + from + "'", problem.what(), suggestion);
  }
  return run;
}

void require_same_mesh(const OtherRun& run, const Model& model) {
  const Mesh &there = run.checkpoint.mesh, &here = model.mesh();
  const std::string suggestion =
      "give both scenes the same geometry and mesh; on another mesh the state would not be in equilibrium";
  const std::string problem = "the mesh is not that of the run in '" + run.folder.string() + "'";
  if (there.cell_count() != here.cell_count() || there.fracture_cell_count() != here.fracture_cell_count() ||
      there.node_count() != here.node_count())
    throw unfit(model, problem,
                fmt::format("it has {} cells, {} fracture cells and {} nodes there, and {}, {} and {} here",
                            there.cell_count(), there.fracture_cell_count(), there.node_count(), here.cell_count(),
                            here.fracture_cell_count(), here.node_count()),
                suggestion);
  if (topology_hash(there) != topology_hash(here))
    throw unfit(model, problem, "it has as many cells, which are joined in another way", suggestion);
  double farthest = 0;
  for (int node = 0; node < here.node_count(); ++node)
    farthest = std::max(farthest, (there.nodes[node] - here.nodes[node]).norm());
  if (farthest > 0)
    throw unfit(model, problem, fmt::format("its nodes lie elsewhere, up to {:.3g} m away", farthest), suggestion);
}

bool is_initial(const std::string& path) { return path.find(".initial_") != std::string::npos; }

/// The definition of each variable of a `history`, by its path.
Parameters memories_of(const Parameters& parameters) {
  const std::string section = ".history.";
  Parameters memories;
  for (const auto& [path, value] : parameters) {
    const std::size_t at = path.find(section);
    if (at == std::string::npos) continue;
    const std::size_t end = path.find('.', at + section.size());
    memories[path.substr(0, end)] += " " + path.substr(std::min(end, path.size() - 1) + 1) + ": " + value;
  }
  return memories;
}

/// Refuses components of other types, and other values of parameters from which changes are counted.
void require_same_parameters(const OtherRun& run, const Model& model) {
  Parameters here;
  for (const Scene::Resolved& parameter : model.scene().resolved) here[parameter.path] = parameter.value;
  for (const Scene::ComponentEntry& component : model.scene().components) {
    const auto type = run.parameters.find("components." + component.name + ".type");
    if (type == run.parameters.end() || type->second == here[type->first]) continue;
    throw unfit(model,
                "component '" + component.name + "' is of another type in the run in '" + run.folder.string() + "'",
                "it is " + type->second + " there and " + here[type->first] + " here", "use one type, or another name");
  }
  for (const auto& [path, value] : here) {
    const auto before = run.parameters.find(path);
    if (!is_initial(path) || before == run.parameters.end() || before->second == value) continue;
    throw unfit(model, "'" + path + "' is not that of the run in '" + run.folder.string() + "'",
                "it is " + before->second + " there and " + value + " here, and the state is counted from it",
                "give it the same value: the fields themselves come from the other run");
  }
  // What is remembered under one name goes on only as the same.
  const Parameters there = memories_of(run.parameters);
  for (const auto& [path, definition] : memories_of(here))
    if (const auto before = there.find(path); before != there.end() && before->second != definition)
      throw unfit(model, "'" + path + "' is not that of the run in '" + run.folder.string() + "'",
                  "it is" + before->second + " there and" + definition + " here, and its values come from there",
                  "give it the same definition, or another name");
}

std::string owner_of(const std::string& field) { return field.substr(0, field.find('.')); }

/// Names of components and couplers with fields.
std::set<std::string> owners(const OtherRun& run) {
  std::set<std::string> names;
  for (const auto& [field, values] : run.checkpoint.fields) names.insert(owner_of(field));
  return names;
}

/// A new coupler between components of the other run would count what happened before the start as if it happened in
/// the first step.
void require_couplers(const OtherRun& run, const Model& model) {
  const std::set<std::string> there = owners(run);
  for (const Scene::CouplerEntry& coupler : model.scene().couplers) {
    const bool has_fields = std::ranges::any_of(model.fields().all(),
                                                [&](const auto& field) { return field->spec().owner == coupler.name; });
    const bool is_between_old =
        std::ranges::all_of(coupler.between, [&](const std::string& name) { return there.contains(name); });
    if (has_fields && is_between_old && !there.contains(coupler.name))
      throw unfit(model, "the run in '" + run.folder.string() + "' has no coupler " + coupler.name,
                  "what its components did there would count as done in the first step",
                  "couple them in both scenes, or in neither");
  }
}

void take_fields(const OtherRun& run, Model& model) {
  const std::set<std::string> there = owners(run);
  std::set<std::string> missing;
  bool any = false;
  const std::string other = "the run in '" + run.folder.string() + "'";
  std::map<Field*, const Vector*> taken;
  for (const auto& field : model.fields().all()) {
    const auto found = run.checkpoint.fields.find(field->name());
    if (found == run.checkpoint.fields.end()) {
      if (there.contains(field->spec().owner))
        throw unfit(model, other + " has no field " + field->name(), "its '" + field->spec().owner + "' has others",
                    "use the same parameters for '" + field->spec().owner + "' in both scenes");
      missing.insert(field->spec().owner);
      continue;
    }
    const Vector& values = found->second.accepted;
    if (values.size() != field->size())
      throw unfit(model, "field " + field->name() + " does not fit that of " + other,
                  fmt::format("it has {} values there and {} here", values.size(), field->size()),
                  "use the same parameters for '" + field->spec().owner + "' in both scenes");
    taken[field.get()] = &values;
    any = true;
  }
  if (!any)
    throw unfit(model, other + " has no component of this scene", "nothing of its state has a place here",
                "give the components the names that they have there");
  for (const auto& [field, values] : taken) field->set_both(*values);
  for (const std::string& name : missing)
    model.add_note("start of " + name,
                   "'" + name + "' begins with its initial values (" + other +
                       " has none of this name) give it the name that it has there, unless it is new");
  for (const std::string& name : there)
    if (std::ranges::none_of(model.fields().all(), [&](const auto& field) { return field->spec().owner == name; }))
      model.add_note("start without " + name,
                     "the state of '" + name + "' is left behind (" + other +
                         " has it, and this scene does not) name it here, unless that is meant");
}

}  // namespace

void take_state_of_run(const std::string& from, Model& model) {
  const OtherRun run = read_run(from, model);
  require_same_parameters(run, model);
  require_same_mesh(run, model);
  require_couplers(run, model);
  take_fields(run, model);
  for (Part* part : model.parts()) {
    if (auto* state = dynamic_cast<KeepsState*>(part)) state->restore(run.checkpoint.extra);
    if (auto* keeps = dynamic_cast<KeepsTotals*>(part)) keeps->begin_totals();
    const auto* counts = dynamic_cast<const CountsFromHere*>(part);
    if (counts && counts->has_settled_reference() && !model.growing().empty())
      throw unfit(
          model, "a scene whose fractures grow does not start from '" + from + "'",
          "changes are counted from a state that was settled there, which a mesh that has changed does not know",
          "start from a run without 'settle', or remove the 'grow' step");
  }
  model.accept();
}

}  // namespace sprekk
