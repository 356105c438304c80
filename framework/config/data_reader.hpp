// Reads data, vectors and tensors of data from the tree, in all the forms that a scene may use.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "framework/config/data.hpp"
#include "framework/config/node.hpp"
#include "framework/config/parameter.hpp"

namespace sprekk {

/// The parameter that is read: its name, its declaration, and the context that gives names of the scene their meaning.
struct DataRequest {
  std::string name;
  const About& about;
  const ReadContext& context;
};

/// A value in any form that a scene may use (spec.hpp lists them), in SI units. All three throw InputError where it is
/// malformed, out of range, or has another dimension.
Data read_data(const Node& node, const DataRequest& request);
VectorData read_vector(const Node& node, const DataRequest& request);
TensorData read_tensor(const Node& node, const DataRequest& request);

/// The value for each region by index, from {regions: {name: value, …, default: value}} where `read` reads a value.
template <class Value, class Read>
std::vector<Value> read_by_region(const Node& node, const DataRequest& request, const Read& read);

/// Throws InputError when a constant is out of the range of the parameter. Other data are returned with a check that is
/// made at each evaluation.
Data within_range(Data data, const Origin& where, const DataRequest& request);

/// The data of all regions, by index, as one datum.
Data by_region(std::vector<Data> values);

// Functions that the readers of nodes share. They throw InputError where a node is not what they are to read.
void require_known_keys(const Node& map, const std::vector<std::string>& allowed, const DataRequest& request);
const Node& required_entry(const Node& map, const std::string& key, const DataRequest& request);
double read_number(const Node& node, const std::string& unit, const Range& range, const std::string& name);
const std::string& read_scalar(const Node& node, const std::string& name);
/// What to throw for a node that is no `needed`.
InputError wrong_kind(const Node& node, const std::string& name, const std::string& needed);

/// Whether the map has the key `key`, so that its form is known.
inline bool has(const Node& node, const std::string& key) { return node.is_map() && node.find(key) != nullptr; }

template <class Value, class Read>
std::vector<Value> read_by_region(const Node& node, const DataRequest& request, const Read& read) {
  require_known_keys(node, {"regions"}, request);
  const Node& regions = *node.find("regions");
  if (!regions.is_map()) throw wrong_kind(regions, request.name + ".regions", "a map of a value for each region");
  const std::vector<std::string>& names = request.context.region_names;
  for (const Node::Entry& entry : regions.entries) {
    const bool is_known = entry.key == "default" || std::find(names.begin(), names.end(), entry.key) != names.end();
    if (!is_known) throw unknown_name(entry.origin, "region", entry.key, names);
  }
  std::vector<Value> values;
  for (const std::string& name : names) {
    const Node* value = regions.find(name);
    if (value == nullptr) value = regions.find("default");
    if (value == nullptr) {
      throw InputError(regions.origin, quoted(request.name) + " has no value in the region " + quoted(name), "",
                       "add '" + name + ":' or 'default:'");
    }
    values.push_back(read(*value));
  }
  if (values.empty())
    throw InputError(regions.origin, "the mesh has no regions", "", "give one value without 'regions'");
  return values;
}

}  // namespace sprekk
