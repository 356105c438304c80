// Data that are given by the names of fractures, or by a column of the tables that the fractures come from.
#include <fmt/format.h>

#include <algorithm>
#include <unordered_map>
#include <unordered_set>

#include "framework/config/data_reader.hpp"
#include "framework/config/expression.hpp"
#include "framework/config/quantity_scale.hpp"
#include "framework/config/unknown_key.hpp"
#include "framework/name_pattern.hpp"

namespace sprekk {
namespace {

Data by_fracture(std::vector<Data> values, const Node& node, const DataRequest& request) {
  return choice_of(std::move(values), [where = node.origin, name = request.name](const Place& place) {
    if (place.fracture >= 0) return place.fracture;
    throw DataError(
        fmt::format("{}: {} is given by fracture, and is needed elsewhere, at {} (give it one value, or "
                    "values by region)",
                    where.text(), quoted(name), place_text(place)));
  });
}

/// The columns that some table of fractures has.
std::vector<std::string> columns_of(const ReadContext& context) {
  std::vector<std::string> names;
  for (const auto& values : context.fracture_values)
    for (const ColumnValue& value : values)
      if (std::find(names.begin(), names.end(), value.column) == names.end()) names.push_back(value.column);
  return names;
}

const ColumnValue* value_in(const std::vector<ColumnValue>& values, const std::string& column) {
  const auto found = std::ranges::find(values, column, &ColumnValue::column);
  return found == values.end() ? nullptr : &*found;
}

Data in_si(const ColumnValue& given, const DataRequest& request) {
  const double scale =
      given.unit.empty() ? 1 : scale_to_si(given.unit, request.about.unit, given.unit, given.where, given.column);
  return within_range(Data(given.value * scale), given.where, request);
}

/// The entries of a map of values by name, found without a walk through all of them: there may be thousands.
class ValuesOf {
 public:
  ValuesOf(const Node& map, const DataRequest& request) : request_(request) {
    for (const Node::Entry& entry : map.entries) {
      own_.emplace(entry.key, &entry.value);
      if (is_beginning(entry.key)) beginnings_.push_back(&entry);
    }
  }

  /// That of a name: its own, else that of a beginning of the name, else the default; nullptr without any.
  const Node* find(const std::string& name) const {
    if (const auto own = own_.find(name); own != own_.end()) return own->second;
    const Node::Entry* found = nullptr;
    for (const Node::Entry* entry : beginnings_) {
      if (!stands_for(entry->key, name)) continue;
      if (found)
        throw InputError(entry->origin, fmt::format("{} has two values for {}", quoted(request_.name), quoted(name)),
                         fmt::format("{} and {} both stand for it", quoted(found->key), quoted(entry->key)),
                         "give its own name, too");
      found = entry;
    }
    if (found) return &found->value;
    const auto otherwise = own_.find("default");
    return otherwise == own_.end() ? nullptr : otherwise->second;
  }

 private:
  const DataRequest& request_;
  std::unordered_map<std::string, const Node*> own_;
  std::vector<const Node::Entry*> beginnings_;
};

void require_known_names(const Node& map, const NamedPlaces& places, const std::vector<std::string>& names) {
  const std::unordered_set<std::string> known(names.begin(), names.end());
  for (const Node::Entry& entry : map.entries) {
    const bool is_known = entry.key == "default" || known.count(entry.key) > 0 ||
                          (is_beginning(entry.key) && std::ranges::any_of(names, [&](const std::string& name) {
                             return stands_for(entry.key, name);
                           }));
    if (!is_known) throw unknown_key(entry.origin, places.one, entry.key, names);
  }
}

/// Whether a component that lives in places of these names, everywhere if there are none, lives in this one.
bool lives_in(const std::vector<std::string>& own, const std::string& name) {
  return own.empty() || std::ranges::any_of(own, [&](const std::string& one) { return stands_for(one, name); });
}

}  // namespace

std::vector<const Node*> values_by_name(const Node& node, const DataRequest& request, const NamedPlaces& places,
                                        const std::vector<std::string>& names) {
  require_known_keys(node, {places.key}, request);
  const Node& map = *node.find(places.key);
  if (!map.is_map()) throw wrong_kind(map, request.name + "." + places.key, "a map of a value for each " + places.one);
  require_known_names(map, places, names);
  if (names.empty())
    throw InputError(map.origin, "the scene has no " + places.key, "", "give one value without '" + places.key + "'");
  const ValuesOf given(map, request);
  const std::vector<std::string>& own =
      std::string(places.key) == "fractures" ? request.context.own_fractures : request.context.own_regions;
  std::vector<const Node*> values;
  for (const std::string& name : names) {
    const Node* const value = given.find(name);
    if (value == nullptr && lives_in(own, name))
      throw InputError(
          map.origin,
          fmt::format("{} has no value {} the {} {}", quoted(request.name), places.in, places.one, quoted(name)), "",
          "add '" + name + ":' or 'default:'");
    values.push_back(value);
  }
  const auto some = std::ranges::find_if(values, [](const Node* value) { return value != nullptr; });
  if (some == values.end())
    throw InputError(map.origin, quoted(request.name) + " has no value", "",
                     "give one " + std::string(places.in) + " each " + places.one);
  std::ranges::replace(values, static_cast<const Node*>(nullptr), *some);  // where it is not asked for
  return values;
}

Data read_by_fracture(const Node& node, const DataRequest& request) {
  std::vector<Data> values;
  for (const Node* value :
       values_by_name(node, request, {"fracture", "on", "fractures"}, request.context.fracture_names))
    values.push_back(read_data(*value, request));
  return by_fracture(std::move(values), node, request);
}

Data read_fracture_column(const Node& node, const DataRequest& request) {
  require_known_keys(node, {"column", "default"}, request);
  const Node& named = *node.find("column");
  const std::string column = read_scalar(named, request.name + ".column");
  const std::vector<std::string> known = columns_of(request.context);
  if (known.empty())
    throw InputError(named.origin, "no table of fractures has further columns",
                     fmt::format("{} asks for the column {}", quoted(request.name), quoted(column)),
                     "add it to the file of 'geometry.fractures', or name a 'table' of its own");
  if (std::find(known.begin(), known.end(), column) == known.end())
    throw unknown_name(named.origin, "column of the tables of fractures:", column, known);
  if (request.context.column_used) request.context.column_used(column);
  const Node* const otherwise = node.find("default");
  std::vector<Data> values;
  for (std::size_t i = 0; i < request.context.fracture_names.size(); ++i) {
    const ColumnValue* const given = value_in(request.context.fracture_values[i], column);
    if (!given && !otherwise)
      throw InputError(node.origin,
                       fmt::format("{} has no value on the fracture {}", quoted(request.name),
                                   quoted(request.context.fracture_names[i])),
                       fmt::format("its table has no column {}, or it comes from none", quoted(column)),
                       "add 'default:'");
    values.push_back(given ? in_si(*given, request) : read_data(*otherwise, request));
  }
  return by_fracture(std::move(values), node, request);
}

}  // namespace sprekk
