#include "framework/scene/scene.hpp"

#include <algorithm>
#include <set>

#include "framework/mesh/generate_mesh.hpp"
#include "framework/mesh/geometry_spec.hpp"
#include "framework/schedule/schedule_context.hpp"
#include "framework/schedule/solve_step.hpp"

namespace sprekk {

Spec OutputOptions::spec() {
  Spec spec("output", "What is written, and when.");
  spec.quantity("every", every,
                {.unit = "s", .range = positive(), .doc = "Fields are written at the multiples of this after the start; by default at the end only."});
  spec.quantities("times", times, {.unit = "s", .doc = "Further times at which fields are written."});
  spec.flag("fields", fields, {.doc = "Whether fields are written for ParaView."});
  spec.quantity("checkpoint_every", checkpoint_every,
                {.unit = "s", .range = positive(), .doc = "Wall time between checkpoints; by default 10 minutes."});
  static ProbeOptions example;
  spec.named_sections("probes", example.spec(),
                      [this](const std::string& key, const Origin& origin) {
                        probes[key].origin = origin;
                        return probes[key].spec();
                      },
                      {.doc = "Figures for history.csv by name."});
  return spec;
}

namespace {

const std::vector<std::string> section_names = {"name",       "geometry", "mesh",   "materials", "components", "couplers",
                                                "schedule",   "time",     "output", "solver",    "newton"};

void check_sections(const Node& whole) {
  if (!whole.is_map())
    throw InputError(whole.origin, "the scene is not a map", "a scene has sections such as 'geometry:' and 'components:'");
  for (const Node::Entry& entry : whole.entries)
    if (std::find(section_names.begin(), section_names.end(), entry.key) == section_names.end())
      throw unknown_name(entry.origin, "section of a scene", entry.key, section_names);
  for (const char* needed : {"geometry", "components", "schedule", "time"})
    if (!whole.find(needed))
      throw InputError(whole.origin, std::string("the section '") + needed + "' is missing", "a scene needs it",
                       "see 'sprekk explain " + std::string(needed) + "'");
}

/// What `materials:` may hold: every parameter of a registered type that is declared as a material's.
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

void check_materials(const Node* materials) {
  if (!materials || materials->is_null()) return;
  if (!materials->is_map())
    throw InputError(materials->origin, "'materials' is not a map", "it holds properties by name");
  const std::vector<std::string> names = material_names();
  for (const Node::Entry& entry : materials->entries)
    if (std::find(names.begin(), names.end(), entry.key) == names.end())
      throw unknown_name(entry.origin, "property of a material", entry.key, names);
}

std::string type_of(const Node& node, const std::string& what) {
  const Node* type = node.is_map() ? node.find("type") : nullptr;
  if (!type || !type->is_scalar())
    throw InputError(node.origin, what + " has no type", "its 'type' says what it is", "see 'sprekk list'");
  return type->scalar;
}

void read_components(Scene& scene, const ReadContext& read) {
  const Node& components = *scene.whole.find("components");
  if (!components.is_map() || components.entries.empty())
    throw InputError(components.origin, "there are no components", "they hold the physics", "see 'sprekk list'");
  for (const Node::Entry& entry : components.entries) {
    const std::string type = type_of(entry.value, "component '" + entry.key + "'");
    const ComponentType& registered = Registry::instance().component(type, entry.value.find("type")->origin);
    scene.components.push_back({entry.key, type, entry.origin, registered.read(entry.value, read)});
  }
}

void read_couplers(Scene& scene, const ReadContext& read) {
  const Node* couplers = scene.whole.find("couplers");
  if (!couplers || couplers->is_null()) return;
  if (!couplers->is_list())
    throw InputError(couplers->origin, "'couplers' is not a list", "each coupler is an item",
                     "write '- {type: …, between: […]}'");
  std::vector<std::string> names;
  for (const Scene::ComponentEntry& component : scene.components) names.push_back(component.name);
  for (const Node& item : couplers->items) {
    const std::string type = type_of(item, "a coupler");
    const CouplerType& registered = Registry::instance().coupler(type, item.find("type")->origin);
    Scene::CouplerEntry entry{type, type, item.origin, {}, {}};
    const auto same = std::count_if(scene.couplers.begin(), scene.couplers.end(),
                                    [&](const Scene::CouplerEntry& other) { return other.type == type; });
    if (same > 0) entry.name += "#" + std::to_string(same + 1);
    const Node* between = item.find("between");
    if (!between || !between->is_list() || between->items.empty())
      throw InputError(item.origin, "coupler " + type + " does not say what it couples",
                       "'between' lists the names of components", "write 'between: [a, b]'");
    for (const Node& name : between->items) {
      if (std::find(names.begin(), names.end(), name.scalar) == names.end())
        throw unknown_name(name.origin, "component", name.scalar, names);
      entry.between.push_back(name.scalar);
    }
    entry.build = registered.read(item, read);
    scene.couplers.push_back(std::move(entry));
  }
}

}  // namespace

Scene read_scene(const Node& whole, const std::string& folder) {
  check_sections(whole);
  Scene scene;
  scene.whole = whole;
  const Node* name = whole.find("name");
  scene.name = name && name->is_scalar() && !name->scalar.empty() ? name->scalar : "scene";

  ReadContext read;
  read.folder = folder;
  read.materials = whole.find("materials");
  if (read.materials && !read.materials->is_map()) read.materials = nullptr;
  read.record = [&scene](const std::string& path, const std::string& value, const std::string& origin) {
    scene.resolved.push_back({path, value, origin});
  };
  check_materials(whole.find("materials"));
  const auto read_section = [&](const char* key, const Spec& spec) {
    if (const Node* node = whole.find(key)) spec.read(*node, read);
  };
  read_section("geometry", geometry_spec(scene.geometry, folder));
  read_section("mesh", mesh_spec(scene.mesh));
  if (const Node* mesh = whole.find("mesh")) scene.mesh.origin = mesh->origin;
  validate_geometry(scene.geometry, scene.mesh);
  read_section("time", scene.time.spec());
  read_section("output", scene.output.spec());
  read_section("solver", solver_spec(scene.linear));
  read_section("newton", newton_spec(scene.newton));

  read.region_names = mesh_names(scene.geometry).regions;
  read_components(scene, read);
  read_couplers(scene, read);
  return scene;
}

std::vector<Spec> scene_section_specs() {
  static Geometry geometry;
  static MeshOptions mesh;
  static TimeOptions time;
  static OutputOptions output;
  static LinearOptions linear;
  static NewtonOptions newton;
  return {geometry_spec(geometry), mesh_spec(mesh),     time.spec(),
          output.spec(),           solver_spec(linear), newton_spec(newton)};
}

}  // namespace sprekk
