#include "framework/scene/key_places.hpp"

#include <algorithm>

#include "framework/config/data_reader.hpp"
#include "framework/config/inner_path.hpp"
#include "framework/scene/registry.hpp"
#include "framework/schedule/schedule_context.hpp"

namespace sprekk {
namespace {

constexpr std::size_t most_places = 3;  // that a message names: more are no help

/// Whether an item or an entry of the section has this type.
bool has_type(const Node* section, const std::string& type) {
  if (!section) return false;
  const auto is_it = [&type](const Node& part) {
    const Node* given = part.find("type");
    return given && given->scalar == type;
  };
  return std::ranges::any_of(section->items, is_it) ||
         std::ranges::any_of(section->entries, [&](const Node::Entry& entry) { return is_it(entry.value); });
}

}  // namespace

KeyPlaces::KeyPlaces(const Node& scene, const std::vector<std::string>& sections, const std::vector<Spec>& specs) {
  for (const std::string& section : sections) add_key(section, "at the top of the scene", 0);
  for (const Spec& spec : specs) add(spec, "", spec.name(), 0);
  for (const ScheduleKind& kind : schedule_kinds()) {
    add_key(kind.key, "in 'schedule', as a step", 0);
    add(kind.spec(), "a step " + quoted(kind.key), "", 0);
  }
  const auto add_part = [&](const char* section, const std::string& what, const auto& type) {
    const Spec spec = type.spec();
    const int rank = has_type(scene.find(section), type.type) ? 0 : 1;
    for (const Parameter& parameter : spec.parameters())
      if (parameter.about.material) add_key(parameter.name, "in 'materials'", rank);
    add(spec, what + " " + type.type, "", rank);
  };
  for (const ComponentType& type : Registry::instance().components()) add_part("components", "a component", type);
  for (const CouplerType& type : Registry::instance().couplers()) add_part("couplers", "a coupler", type);
  for (const auto& [key, form] : data_keys()) add_key(key, "in a value " + form, 2);
}

void KeyPlaces::add(const Spec& spec, const std::string& name, const std::string& path, int rank) {
  const std::string whole = name.empty() ? "at the top of the file" : "in " + name;
  const std::string place = path.empty() ? whole : "in " + quoted(path) + (name.empty() ? "" : " of " + name);
  for (const Parameter& parameter : spec.parameters()) add_key(parameter.name, place, rank);
  for (const std::string& key : spec.ignored()) add_key(key, place, rank);
  for (const Parameter& parameter : spec.parameters())
    if (parameter.inner) add(*parameter.inner, name, inner_path(path, parameter), rank);
}

void KeyPlaces::add_key(const std::string& key, const std::string& place, int rank) {
  std::vector<std::string>& known = places_[key][rank];
  if (std::ranges::count(known, place) == 0) known.push_back(place);
}

std::string KeyPlaces::text(const std::string& key) const {
  const auto found = places_.find(key);
  if (found == places_.end()) return "";
  const std::vector<std::string>& places = found->second.begin()->second;
  std::string text = quoted(key) + " belongs ";
  for (std::size_t i = 0; i < std::min(places.size(), most_places); ++i) text += (i == 0 ? "" : " or ") + places[i];
  return text + (places.size() > most_places ? " or elsewhere" : "");
}

}  // namespace sprekk
