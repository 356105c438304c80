#include "framework/scene/scene.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <limits>
#include <optional>
#include <set>

#include "framework/config/data_reader.hpp"
#include "framework/config/table.hpp"
#include "framework/config/units.hpp"
#include "framework/config/unknown_key.hpp"
#include "framework/meshing/fracture_table.hpp"
#include "framework/meshing/generate_mesh.hpp"
#include "framework/meshing/joining/snap_geometry.hpp"
#include "framework/meshing/short_fractures.hpp"
#include "framework/meshing/spec/geometry_spec.hpp"
#include "framework/meshing/validate_geometry.hpp"
#include "framework/plugin/plugin.hpp"
#include "framework/results/run_datum.hpp"
#include "framework/round_off.hpp"
#include "framework/scene/key_places.hpp"
#include "framework/scene/scene_dimension.hpp"
#include "framework/schedule/schedule_context.hpp"
#include "framework/schedule/solve_step.hpp"

namespace sprekk {

Spec OutputOptions::spec() {
  Spec spec("output", "What is written, and when.");
  spec.quantity("every", every,
                {.unit = "s",
                 .range = positive(),
                 .doc = "Outputs are written at the multiples of this after the start; by default at the end only."});
  spec.quantities("times", times, {.unit = "s", .doc = "Further times at which outputs are written."});
  outputs_.clear();
  for (const FrameOutputRegistry::Type& type : FrameOutputRegistry::instance().types())
    outputs_.push_back(type.declare(spec));
  spec.flag(
      "splitting_error", splitting_error,
      {.doc = "Whether the splitting error is estimated where a schedule solves in turn without iterating, at the cost "
              "of one more pass for each step, in the columns 'splitting_error' and 'coupled_residual'."});
  spec.quantity("checkpoint_every", checkpoint_every,
                {.unit = "s",
                 .range = positive(),
                 .doc = "Wall time between checkpoints; by default a twentieth of the time since the start, "
                        "at least 1 and at most 10 minutes."});
  static ProbeOptions example;
  spec.named_sections("probes", example.spec(),
                      [this](const std::string& key, const Origin& origin) {
                        probes[key].origin = origin;
                        return probes[key].spec();
                      },
                      {.doc = "Figures for history.csv by name."});
  return spec;
}

std::vector<FrameOutputChoice> OutputOptions::chosen_outputs() const {
  std::vector<FrameOutputChoice> chosen;
  std::ranges::copy_if(outputs_, std::back_inserter(chosen), [](const auto& output) { return output.is_chosen(); });
  return chosen;
}

namespace {

const std::vector<std::string> section_names = {"name",       "plugins",  "geometry", "mesh", "materials",
                                                "components", "couplers", "schedule", "time", "start",
                                                "output",     "solver",   "newton"};

void check_sections(const Node& whole) {
  if (!whole.is_map())
    throw InputError(whole.origin, "the scene is not a map",
                     "a scene has sections such as 'geometry:' and 'components:'");
  std::vector<std::string> problems;
  for (const Node::Entry& entry : whole.entries)
    if (std::find(section_names.begin(), section_names.end(), entry.key) == section_names.end())
      problems.emplace_back(unknown_key(entry.origin, "section of a scene", entry.key, section_names).what());
  if (!problems.empty()) throw InputError(problems);
  for (const std::string needed : {"geometry", "components", "schedule", "time"})
    if (!whole.find(needed))
      throw InputError(
          whole.origin, "the section '" + needed + "' is missing", "a scene needs it",
          needed == "components" || needed == "schedule" ? "see 'sprekk list'" : "see 'sprekk explain " + needed + "'");
}

/// The keys that `materials:` may have: all parameters of registered types with About::material.
std::vector<std::string> material_names() {
  std::set<std::string> names;
  const auto collect = [&](const Spec& spec) {
    for (const Parameter& parameter : spec.parameters())
      if (parameter.about.material) names.insert(parameter.name);
  };
  for (const ComponentType& type : Registry::instance().components()) collect(type.spec());
  for (const CouplerType& type : Registry::instance().couplers()) collect(type.spec());
  return {names.begin(), names.end()};
}

/// Loads the libraries that the scene names, relative to its folder, if the user trusts them.
void read_plugins(const Node& whole, const ReadContext& read) {
  const Node* plugins = whole.find("plugins");
  if (!plugins || plugins->is_null()) return;
  const auto load = [&](const Node& file) {
    if (!file.is_scalar() || file.scalar.empty())
      throw InputError(file.origin, "'plugins' names no file", "it is the path of a shared library, or a list of them",
                       "write 'plugins: [build/my_part.so]'");
    load_plugin_of_scene(std::filesystem::path(read.folder) / file.scalar, file.origin);
    read.record(file.path, yaml_scalar(file.scalar), file.origin.text());
  };
  if (plugins->is_list())
    for (const Node& file : plugins->items) load(file);
  else
    load(*plugins);
}

void check_materials(const Node* materials) {
  if (!materials || materials->is_null()) return;
  if (!materials->is_map())
    throw InputError(materials->origin, "'materials' is not a map", "it holds properties by name");
  const std::vector<std::string> names = material_names();
  std::vector<std::string> problems;
  const auto is_property = [&](const std::string& key) { return std::ranges::count(names, key) > 0; };
  for (const Node::Entry& entry : materials->entries)
    if (const auto nested = std::ranges::find_if(entry.value.entries, is_property, &Node::Entry::key);
        !is_property(entry.key) && nested != entry.value.entries.end())
      problems.emplace_back(InputError(entry.origin, quoted(entry.key) + " is no property of a material",
                                       "'materials' has a value of each property, and values by region inside of it",
                                       "write '" + nested->key + ": {regions: {" + entry.key + ": " +
                                           nested->value.text() + ", default: …}}'")
                                .what());
    else if (!is_property(entry.key))
      problems.emplace_back(unknown_key(entry.origin, "property of a material", entry.key, names).what());
  if (!problems.empty()) throw InputError(problems);
}

std::string type_of(const Node& node, const std::string& what, const std::string& key = "") {
  const Node* type = node.is_map() ? node.find("type") : nullptr;
  if (type && type->is_scalar()) return type->scalar;
  const std::string belongs = place_of_key(key);
  throw InputError(node.origin, what + " has no type", "its 'type' says what it is",
                   belongs.empty() ? "see 'sprekk list'" : belongs);
}

/// Checks a name that becomes a part of names of fields ("pore.pressure"), columns and files.
void check_name(const Node::Entry& entry) {
  const auto is_allowed = [](unsigned char c) { return std::isalnum(c) || c == '_' || c == '-'; };
  if (!std::all_of(entry.key.begin(), entry.key.end(), is_allowed))
    throw InputError(entry.origin, "component " + quoted(entry.key) + " cannot be called this",
                     "names are made of letters, digits, '_' and '-'", "choose another name");
}

/// One text or a list of them; none of anything else.
std::vector<std::string> texts_of(const Node* node) {
  std::vector<std::string> texts;
  if (node && node->is_scalar()) texts.push_back(node->scalar);
  if (node && node->is_list())
    for (const Node& item : node->items)
      if (item.is_scalar()) texts.push_back(item.scalar);
  return texts;
}

void read_components(Scene& scene, const ReadContext& read) {
  const Node& components = *scene.whole.find("components");
  if (!components.is_map() || components.entries.empty())
    throw InputError(components.origin, "there are no components", "they hold the physics", "see 'sprekk list'");
  for (const Node::Entry& entry : components.entries) {
    check_name(entry);
    const std::string type = type_of(entry.value, "component '" + entry.key + "'", entry.key);
    const Node& type_node = *entry.value.find("type");
    const ComponentType& registered = Registry::instance().component(type, type_node.origin);
    read.record(type_node.path, yaml_scalar(type), type_node.origin.text());
    ReadContext own = read;
    own.own_regions = texts_of(entry.value.find("regions"));
    own.own_fractures = texts_of(entry.value.find("fractures"));
    scene.components.push_back({entry.key, type, entry.origin, registered.read(entry.value, own)});
  }
}

std::vector<std::string> component_names(const Scene& scene) {
  std::vector<std::string> names;
  for (const Scene::ComponentEntry& component : scene.components) names.push_back(component.name);
  return names;
}

std::vector<std::string> read_between(const Node& coupler, const std::string& type,
                                      const std::vector<std::string>& components) {
  const Node* between = coupler.find("between");
  if (!between || !between->is_list() || between->items.empty())
    throw InputError(between ? between->origin : coupler.origin, "coupler " + type + " does not say what it couples",
                     "'between' lists the names of components", "write 'between: [a, b]'");
  std::vector<std::string> names;
  for (const Node& name : between->items) {
    if (!name.is_scalar())
      throw InputError(name.origin, quoted(name.text()) + " is not the name of a component",
                       "'between' lists names: " + listed(components), "write 'between: [a, b]'");
    if (std::find(components.begin(), components.end(), name.scalar) == components.end())
      throw unknown_name(name.origin, "component", name.scalar, components);
    if (std::find(names.begin(), names.end(), name.scalar) != names.end())
      throw InputError(name.origin, "coupler " + type + " names component " + quoted(name.scalar) + " twice",
                       "it joins different components", "remove one of them");
    names.push_back(name.scalar);
  }
  return names;
}

/// Throws InputError for a second coupler of one type between the same components: its terms would count twice.
void check_is_first(const Scene& scene, const Scene::CouplerEntry& entry) {
  const std::set<std::string> joined(entry.between.begin(), entry.between.end());
  for (const Scene::CouplerEntry& other : scene.couplers)
    if (other.type == entry.type && std::set<std::string>(other.between.begin(), other.between.end()) == joined)
      throw InputError(entry.origin, "coupler " + entry.type + " joins the same components a second time",
                       "the first is at " + other.origin.text(), "remove one of them");
}

void read_couplers(Scene& scene, const ReadContext& read) {
  const Node* couplers = scene.whole.find("couplers");
  if (!couplers || couplers->is_null()) return;
  if (!couplers->is_list())
    throw InputError(couplers->origin, "'couplers' is not a list", "each coupler is an item",
                     "write '- {type: …, between: […]}'");
  for (const Node& item : couplers->items) {
    const std::string type = type_of(item, "a coupler");
    const Node& type_node = *item.find("type");
    const CouplerType& registered = Registry::instance().coupler(type, type_node.origin);
    Scene::CouplerEntry entry{type, type, item.origin, read_between(item, type, component_names(scene)), {}};
    check_is_first(scene, entry);
    const auto same = std::count_if(scene.couplers.begin(), scene.couplers.end(),
                                    [&](const Scene::CouplerEntry& other) { return other.type == type; });
    if (same > 0) entry.name += "#" + std::to_string(same + 1);
    read.record(type_node.path, yaml_scalar(type), type_node.origin.text());
    read.record(item.find("between")->path, item.find("between")->text(), item.find("between")->origin.text());
    entry.build = registered.read(item, read);
    scene.couplers.push_back(std::move(entry));
  }
}

void read_name(Scene& scene, const std::string& default_name, const ReadContext& read) {
  const Node* name = scene.whole.find("name");
  scene.name = name ? name->scalar : default_name;
  if (name && (!name->is_scalar() || name->scalar.empty()))
    throw InputError(name->origin, "the name of the scene is not a text", "results are found by it",
                     "write 'name: a_name'");
  read.record("name", yaml_scalar(scene.name), name ? name->origin.text() : "default");
}

/// A section of the scene, or an empty map: a section that is absent is read as well, for its defaults and for errors
/// on required parameters.
Node section(const Node& whole, const std::string& key) {
  if (const Node* node = whole.find(key)) return *node;
  Node empty;
  empty.kind = Node::Kind::map;
  empty.origin = whole.origin;
  empty.path = key;
  return empty;
}

/// Throws InputError for a component that is not there.
void check_start(const Scene& scene) {
  const std::vector<std::string> known = component_names(scene);
  for (const std::string& name : scene.start.settle)
    if (std::ranges::count(known, name) == 0) throw unknown_name(scene.start.origin, "component", name, known);
}

void check_output(const Scene& scene) {
  constexpr double most_outputs = 1e6;  // no disk holds more
  if (!scene.output.every) return;
  const double count = (scene.time.end - scene.time.start) / *scene.output.every;
  if (count > most_outputs)
    throw InputError(scene.whole.find("output")->find("every")->origin, "fields would be written too often",
                     "about " + quantity_text(std::round(count), "") + " times", "raise 'every'");
}

/// Joins what nearly touches, and refuses what cannot be meshed.
void clean_geometry(Scene& scene) {
  for (const std::string& note : snap_geometry(scene.geometry, scene.mesh))
    scene.notes.add("lines joined", scene.geometry.snap_origin.text() + ": " + note);
  validate_geometry(scene.geometry, scene.mesh);
  if (const std::string note = note_on_short_fractures(scene.geometry, scene.mesh); !note.empty())
    scene.notes.add("fracture shorter than its cell", note);
}

void note_unused_materials(Scene& scene, const std::set<std::string>& used) {
  const Node* materials = scene.whole.find("materials");
  if (!materials) return;
  for (const Node::Entry& entry : materials->entries)
    if (used.count(entry.key) == 0)
      scene.notes.add("materials." + entry.key + " without effect",
                      entry.origin.text() + ": no component of this scene uses " + quoted(entry.key));
}

/// The times of the rows of a table that depends on time (s), in order; none for another one.
std::vector<double> times_of_table(const Node& node, const std::string& folder) {
  const Node* const of = node.find("of");
  std::vector<std::string> variables;
  if (!of) variables = {"t"};
  if (of && of->is_scalar()) variables = {of->scalar};
  if (of)
    for (const Node& item : of->items) variables.push_back(item.scalar);
  const auto time = std::ranges::find(variables, "t");
  if (time == variables.end()) return {};
  const auto axis = static_cast<std::size_t>(time - variables.begin());
  for (const char* column : {"t", "1"})  // the column of times has its name, or is the first one
    try {
      return read_table({node.find("table")->scalar, folder, column, variables, {}, "s", "t", node.origin}).axes[axis];
    } catch (const InputError&) {
      // What a component uses has been read already; the table of an unused material may be anything.
    }
  return {};
}

/// Notes tables in time whose rows are nearer to each other than steps: a step takes the value at its end.
void note_tables(const Node& node, Scene& scene) {
  for (const Node& item : node.items) note_tables(item, scene);
  for (const Node::Entry& entry : node.entries)
    if (!node.path.empty() || (entry.key != "geometry" && entry.key != "output")) note_tables(entry.value, scene);
  const Node* const file = node.find("table");
  if (!file || !file->is_scalar()) return;
  const TimeOptions& time = scene.time;
  const double step = std::min(time.adaptive ? time.largest : time.step, time.end - time.start);
  std::vector<double> times = times_of_table(node, scene.folder);
  std::erase_if(times, [&](double t) { return t < time.start || t > time.end; });
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < times.size(); ++i) nearest = std::min(nearest, times[i] - times[i - 1]);
  if (!(nearest < step * (1 - rounding::same))) return;
  scene.notes.add(
      "table finer than the steps",
      node.origin.text() + ": " + sprekk::quoted(file->scalar) + " has rows that are " + quantity_text(nearest, "s") +
          " apart (a step of up to " + quantity_text(step, "s") +
          " takes the value at its end, and passes over what is between) lower the step, or give windows in "
          "time, at which steps end");
}

/// Notes times without effect.
void note_times(Scene& scene) {
  const TimeOptions& time = scene.time;
  const auto note = [&](const char* section, const std::string& key, const std::string& text) {
    const Node* given = scene.whole.find(section)->find(key);
    const Origin& origin = given ? given->origin : scene.whole.find(section)->origin;
    scene.notes.add(std::string(section) + "." + key + " without effect", origin.text() + ": " + text);
  };
  const double duration = time.end - time.start;
  const std::string duration_text = "the run is " + quantity_text(duration, "s") + " long";
  if (time.step > duration * (1 + rounding::same))
    note("time", "step",
         "'step' is " + quantity_text(time.step, "s") + " (" + duration_text +
             ", and is done in one shorter step) lower 'step', or raise 'end'");
  if (scene.output.every && *scene.output.every > duration * (1 + rounding::same))
    note("output", "every",
         "'every' has no effect: it is " + quantity_text(*scene.output.every, "s") + " (" + duration_text +
             ", and fields are written at its end anyhow) lower it");
  std::string outside;
  for (const double at : scene.output.times)
    if (at <= time.start || at > time.end) outside += (outside.empty() ? "" : ", ") + quantity_text(at, "s");
  if (!outside.empty())
    note("output", "times",
         "no fields are written at " + outside + " (the run begins at " + quantity_text(time.start, "s") +
             " and ends at " + quantity_text(time.end, "s") + ") remove these times");
}

}  // namespace

Scene read_scene(const Node& whole, const std::string& folder, const std::string& default_name) {
  require_dimension(whole, folder);
  data_forms()["run"] = read_run_datum;  // {run: …}, which the config cannot read: it knows no results
  Scene scene;
  scene.whole = whole;
  scene.folder = folder;
  scene.notes.of_input(0);

  std::set<std::string> materials_used;
  ReadContext read;
  read.folder = folder;
  std::optional<KeyPlaces> places;  // made when the first key is in a wrong place
  const KnownPlaces known([&](const std::string& key) {
    if (!places) places.emplace(whole, section_names, scene_section_specs());
    return places->text(key);
  });
  check_sections(whole);
  read.materials = whole.find("materials");
  read.record = [&scene](const std::string& path, const std::string& value, const std::string& origin) {
    scene.resolved.push_back({path, value, origin});
  };
  read.material_used = [&materials_used](const std::string& key) { materials_used.insert(key); };
  read_plugins(whole, read);
  check_materials(read.materials);
  if (read.materials && !read.materials->is_map()) read.materials = nullptr;
  const auto read_section = [&](const char* key, const Spec& spec) { spec.read(section(whole, key), read); };
  read_name(scene, default_name, read);
  Node geometry = section(whole, "geometry");
  expand_fracture_table(geometry);
  geometry_spec(scene.geometry, folder).read(geometry, read);
  read_section("mesh", mesh_spec(scene.mesh));
  clean_geometry(scene);
  read_section("time", scene.time.spec());
  read_section("start", scene.start.spec());
  read_section("output", scene.output.spec());
  check_output(scene);
  read_section("solver", solver_spec(scene.linear));
  read_section("newton", newton_spec(scene.newton));

  const MeshNames names = mesh_names(scene.geometry);
  for (const std::string& note : names.notes) scene.notes.add(note, scene.geometry.file_origin.text() + ": " + note);
  read.region_names = names.regions;
  read.fracture_names = names.fractures;
  read.fracture_values.resize(names.fractures.size());
  for (std::size_t i = 0; i < scene.geometry.fractures.size(); ++i)
    read.fracture_values[i] = scene.geometry.fractures[i].values;
  std::set<std::string> columns_used;
  read.column_used = [&columns_used](const std::string& column) { columns_used.insert(column); };
  read_components(scene, read);
  read_couplers(scene, read);
  check_start(scene);
  const Node& schedule = *whole.find("schedule");
  scene.linear.bulk_changes_often = has_step(schedule, "grow");
  scene.schedule =
      read_schedule(schedule, {component_names(scene), scene.linear, scene.newton, read, scene.time.scheme});
  note_unused_materials(scene, materials_used);
  require_used_columns(scene.geometry.fractures, columns_used);
  note_times(scene);
  note_tables(scene.whole, scene);
  return scene;
}

std::vector<Spec> scene_section_specs() {
  static Geometry geometry;
  static MeshOptions mesh;
  static TimeOptions time;
  static StartOptions start;
  static OutputOptions output;
  static LinearOptions linear;
  static NewtonOptions newton;
  return {geometry_spec(geometry), mesh_spec(mesh),     time.spec(),        start.spec(),
          output.spec(),           solver_spec(linear), newton_spec(newton)};
}

}  // namespace sprekk
