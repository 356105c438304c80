#include "framework/converge/refinement.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "framework/config/input_error.hpp"
#include "framework/round_off.hpp"

namespace sprekk {
namespace {

const Scene::Resolved* resolved(const Scene& scene, const std::string& path) {
  for (const Scene::Resolved& value : scene.resolved)
    if (value.path == path) return &value;
  return nullptr;
}

/// "0.25 m" of "0.5 m" and 1/2; "[8, 80]" of "[4, 40]".
std::string scaled(const Refinement::Value& value, double factor) {
  std::string text;
  const char* rest = value.text.c_str();
  while (*rest != '\0') {
    char* end = nullptr;
    const double number = std::strtod(rest, &end);
    if (end == rest) {
      text += *rest++;
      continue;
    }
    double changed = value.is_count ? std::max(1.0, std::round(number / factor)) : number * factor;
    if (value.most > 0) changed = std::min(changed, value.most);
    text += fmt::format("{}", changed);
    rest = end;
    if (value.is_count) continue;
    return text + rest;  // what follows is the unit
  }
  return text;
}

bool is_number(const std::string& text) {
  char* end = nullptr;
  std::strtod(text.c_str(), &end);
  return end != text.c_str();
}

void add(const Scene& scene, const std::string& path, Refinement& refinement, double most = 0) {
  const Scene::Resolved* const found = resolved(scene, path);
  if (found != nullptr && is_number(found->value)) refinement.values.push_back({path, found->value, false, most});
}

/// Values whose paths have this ending, of components that have tips.
Refinement of_ending(const Scene& scene, const std::string& name, const std::string& ending, double most) {
  Refinement refinement{name, {}};
  for (const Scene::Resolved& value : scene.resolved)
    if (value.path.ends_with(ending)) add(scene, value.path, refinement, most);
  return refinement;
}

Refinement of_mesh(const Scene& scene) {
  constexpr double steepest = 2;  // what `mesh.growth` may be
  Refinement mesh{"mesh", {}};
  const Scene::Resolved* const cells = resolved(scene, "mesh.cells");
  if (cells != nullptr && cells->value != "[]") {
    mesh.values.push_back({"mesh.cells", cells->value, true, 0});
    return mesh;
  }
  add(scene, "mesh.size", mesh);
  if (mesh.values.empty()) return mesh;
  add(scene, "mesh.fracture_size", mesh);
  add(scene, "mesh.tip_size", mesh);
  add(scene, "mesh.gap_size", mesh);
  for (const Scene::Resolved& value : scene.resolved)
    if (value.path.starts_with("geometry.sides.") && value.path.ends_with(".size")) add(scene, value.path, mesh);
  if (!scene.geometry.fractures.empty()) add(scene, "mesh.growth", mesh, steepest);
  return mesh;
}

}  // namespace

std::vector<std::pair<std::string, std::string>> Refinement::at(double factor) const {
  std::vector<std::pair<std::string, std::string>> settings;
  for (const Value& value : values) settings.emplace_back(value.path, scaled(value, factor));
  return settings;
}

std::vector<Refinement> refinements(const Scene& scene, const std::vector<std::string>& chosen) {
  std::vector<Refinement> all = {of_mesh(scene),
                                 {"step", {}},
                                 of_ending(scene, "fine level", ".mesh_ratio", 1),
                                 of_ending(scene, "increment", ".growth.increment", 0)};
  if (scene.time.end - scene.time.start > scene.time.step * (1 + rounding::same) || !chosen.empty()) {
    add(scene, "time.step", all[1]);
    add(scene, "time.adaptive.largest", all[1]);
  }
  std::erase_if(all, [](const Refinement& refinement) { return refinement.values.empty(); });
  std::vector<std::string> names;
  for (const Refinement& refinement : all) names.push_back(refinement.name);
  if (chosen.empty() && all.empty())
    throw InputError({"sprekk converge"}, "there is nothing to refine",
                     "the scene gives neither mesh.size nor mesh.cells, and has one step",
                     "name a value with --refine");
  if (chosen.empty()) return all;
  std::vector<Refinement> wanted;
  for (const std::string& name : chosen) {
    const auto found = std::find(names.begin(), names.end(), name);
    Refinement single{name, {}};
    if (found == names.end()) add(scene, name, single);
    if (found == names.end() && single.values.empty()) {
      for (const Scene::Resolved& value : scene.resolved) names.push_back(value.path);
      throw unknown_name({"--refine"}, "value", name, names);
    }
    wanted.push_back(found == names.end() ? single : all[static_cast<std::size_t>(found - names.begin())]);
  }
  return wanted;
}

}  // namespace sprekk
