#include "framework/scene/registry.hpp"

#include <algorithm>

#include "framework/plugin/plugin.hpp"

namespace sprekk {

namespace {

template <class Type>
void insert_sorted(std::vector<Type>& types, Type type) {
  const auto place =
      std::lower_bound(types.begin(), types.end(), type, [](const Type& a, const Type& b) { return a.type < b.type; });
  if (place != types.end() && place->type == type.type) return refuse_registration(type.type);
  note_registration(type.type);
  types.insert(place, std::move(type));
}

template <class Type>
const Type& look_up(const std::vector<Type>& types, const std::string& what, const std::string& name,
                    const Origin& where) {
  std::vector<std::string> names;
  for (const Type& type : types) {
    if (type.type == name) return type;
    names.push_back(type.type);
  }
  throw unknown_name(where, what, name, names);
}

}  // namespace

Registry& Registry::instance() {
  static Registry registry;
  return registry;
}

void Registry::add(ComponentType type) { insert_sorted(components_, std::move(type)); }
void Registry::add(CouplerType type) { insert_sorted(couplers_, std::move(type)); }

const ComponentType& Registry::component(const std::string& type, const Origin& where) const {
  return look_up(components_, "type of component", type, where);
}

const CouplerType& Registry::coupler(const std::string& type, const Origin& where) const {
  return look_up(couplers_, "type of coupler", type, where);
}

}  // namespace sprekk
