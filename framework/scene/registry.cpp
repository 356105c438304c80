#include "framework/scene/registry.hpp"

#include <regex>

#include "framework/plugin/insert_by_name.hpp"

namespace sprekk {

namespace {

/// Throws InputError for a type that the program for the plane has. `folder`: of all such types.
void refuse_in_space(const std::string& folder, const std::string& what, const std::string& name, const Origin& where) {
#ifdef SPREKK_IN_A_PLANE_ALONE
  if (std::regex_search(folder + "/" + name + "/", std::regex(SPREKK_IN_A_PLANE_ALONE)))
    throw InputError(where, "there is no " + what + " '" + name + "' for scenes in space yet",
                     "it is for scenes in a plane so far", "leave it out, or leave out the z of the box");
#else
  (void)folder, (void)what, (void)name, (void)where;
#endif
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

void Registry::add(ComponentType type) { insert_by_name(components_, std::move(type), &ComponentType::type); }
void Registry::add(CouplerType type) { insert_by_name(couplers_, std::move(type), &CouplerType::type); }

const ComponentType& Registry::component(const std::string& type, const Origin& where) const {
  refuse_in_space("components", "type of component", type, where);
  return look_up(components_, "type of component", type, where);
}

const CouplerType& Registry::coupler(const std::string& type, const Origin& where) const {
  refuse_in_space("couplers", "type of coupler", type, where);
  return look_up(couplers_, "type of coupler", type, where);
}

}  // namespace sprekk
