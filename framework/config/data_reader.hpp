// Reads data, vectors and tensors of data from the tree, in all the forms that a scene may use.
#pragma once

#include <functional>
#include <map>
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

/// Forms of a datum that are read in other folders: each is a map with a key of its own, and is found by this key.
using DataForms = std::map<std::string, std::function<Data(const Node&, const DataRequest&)>>;
DataForms& data_forms();

/// A value in any form that a scene may use (spec.hpp lists them), in SI units. All three throw InputError where it is
/// malformed, out of range, or has another dimension.
Data read_data(const Node& node, const DataRequest& request);
VectorData read_vector(const Node& node, const DataRequest& request);
TensorData read_tensor(const Node& node, const DataRequest& request);

/// How a tensor may be written: by its components, or by principal values and their direction.
struct TensorForm {
  std::vector<std::string> keys;
  std::string text() const;  ///< "{xx: …, yy: …, xy: …}"
};
std::vector<TensorForm> tensor_forms();

/// The value for each region by index, from {regions: {name: value, …, default: value}} where `read` reads a value.
template <class Value, class Read>
std::vector<Value> read_by_region(const Node& node, const DataRequest& request, const Read& read);

/// Throws InputError when a constant is out of the range of the parameter. Other data are returned with a check that is
/// made at each evaluation.
Data within_range(Data data, const Origin& where, const DataRequest& request);

/// One datum that at each place has the value with this index.
Data choice_of(std::vector<Data> values, std::function<int(const Place&)> index);
/// The data of all regions, by index, as one datum.
Data by_region(std::vector<Data> values);

/// {fractures: {name: value, …, default: value}}, and {column: name, default: value} of the scene's tables of
/// fractures. Evaluated anywhere but on a fracture, such a datum throws DataError.
Data read_by_fracture(const Node& node, const DataRequest& request);
Data read_fracture_column(const Node& node, const DataRequest& request);

// Functions that the readers of nodes share. They throw InputError where a node is not what they are to read.
void require_known_keys(const Node& map, const std::vector<std::string>& allowed, const DataRequest& request);
const Node& required_entry(const Node& map, const std::string& key, const DataRequest& request);
double read_number(const Node& node, const std::string& unit, const Range& range, const std::string& name);
const std::string& read_scalar(const Node& node, const std::string& name);
/// What to throw for a node that is no `needed`.
InputError wrong_kind(const Node& node, const std::string& name, const std::string& needed,
                      const std::string& suggestion = "");

/// What values are given by: the word for one, "in" or "on" it, and the key of the map from names to values.
struct NamedPlaces {
  std::string one, in, key;
};

/// For each of `names` its entry in the map under the key, or the one called default. Throws InputError where there is
/// none, and for names that are unknown.
std::vector<const Node*> values_by_name(const Node& node, const DataRequest& request, const NamedPlaces& places,
                                        const std::vector<std::string>& names);

/// The key that tells the form of a datum that is a map, or "".
std::string form_of(const Node& map);
/// Keys of data that are maps, each with the form in which it stands: "{value: …, from: …, to: …}".
std::vector<std::pair<std::string, std::string>> data_keys();
/// What to throw for a map that has no such key; `further`: keys that it may have besides.
InputError unknown_form(const Node& map, const DataRequest& request, const std::vector<std::string>& further = {});

/// Whether the map has the key `key`, so that its form is known.
inline bool has(const Node& node, const std::string& key) { return node.is_map() && node.find(key) != nullptr; }

template <class Value, class Read>
std::vector<Value> read_by_region(const Node& node, const DataRequest& request, const Read& read) {
  std::vector<Value> values;
  for (const Node* value : values_by_name(node, request, {"region", "in", "regions"}, request.context.region_names))
    values.push_back(read(*value));
  return values;
}

}  // namespace sprekk
