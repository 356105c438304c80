// Lists of types that register themselves.
#pragma once

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "framework/plugin/plugin.hpp"

namespace sprekk {

/// Keeps a list of types sorted by their names. Refuses a name that exists (refuse_registration).
template <class Type>
void insert_by_name(std::vector<Type>& types, Type type, std::string Type::*name) {
  const auto place = std::ranges::lower_bound(types, type.*name, {}, name);
  if (place != types.end() && (*place).*name == type.*name) return refuse_registration(type.*name);
  note_registration(type.*name);
  types.insert(place, std::move(type));
}

}  // namespace sprekk
