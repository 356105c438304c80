// Symmetric tensors: isotropic, by components, or by principal values and their direction.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "framework/config/data_reader.hpp"
#include "framework/config/expression.hpp"

namespace sprekk {
namespace {

using Components = std::array<double, symmetric_components>;

bool must_be_definite(const About& about) { return about.range.low >= 0; }

/// Whether the tensor is positive definite (all its leading minors are positive), or zero where the range of the
/// parameter has 0.
bool is_definite(const Components& values, const About& about) {
  const Tensor k = symmetric_tensor(values);
  if (about.range.low_allowed && k.isZero(0)) return true;
  if (!(k.diagonal().minCoeff() > 0 && k(0, 0) * k(1, 1) > k(0, 1) * k(0, 1))) return false;
  return dimension == 2 || k.determinant() > 0;
}

/// A function of several data at the same place; a constant when all of them are constants.
template <class Combine>
Data combined(const std::vector<Data>& parts, const Combine& combine) {
  bool in_time = false;
  bool in_space = false;
  bool is_constant = true;
  std::vector<const Data*> pointers;
  for (const Data& part : parts) {
    in_time = in_time || part.depends_on_time();
    in_space = in_space || part.depends_on_space();
    is_constant = is_constant && part.is_constant();
    pointers.push_back(&part);
  }
  auto evaluate = [parts, combine](const Place& place) {
    std::vector<double> values;
    for (const Data& part : parts) values.push_back(part.at(place));
    return combine(values, place);
  };
  if (is_constant) return evaluate({});
  return Data(std::move(evaluate), in_time, in_space, merged_switch_times(pointers));
}

std::string described(const Components& values) {
  std::string text;
  for (int k = 0; k < symmetric_components; ++k)
    text += fmt::format("{}{} = {}", k == 0 ? "" : ", ", symmetric_name(k), values[k]);
  return text;
}

/// Checks that the components together are a definite tensor: constants now, other data at every evaluation of the
/// last component.
TensorData definite(TensorData tensor, const Origin& where, const DataRequest& request) {
  if (!must_be_definite(request.about)) return tensor;
  const auto why = [](const Components& values) {
    return dimension == 2
               ? fmt::format("xx yy = {} must be larger than xy^2 = {}", values[0] * values[1], values[2] * values[2])
               : "a principal value of " + described(values) + " is not positive";
  };
  if (tensor.is_constant()) {
    Components values;
    for (int k = 0; k < symmetric_components; ++k) values[k] = tensor.component[k].at({});
    if (is_definite(values, request.about)) return tensor;
    throw InputError(where, quoted(request.name) + " is not positive definite", why(values));
  }
  if (tensor.is_diagonal()) return tensor;
  const auto checked = [where, name = request.name, about = request.about](const std::vector<double>& values,
                                                                           const Place& place) {
    Components components;
    std::ranges::copy(values, components.begin());
    if (is_definite(components, about)) return components.back();
    throw DataError(fmt::format("{}: {} is not positive definite at {} ({})", where.text(), quoted(name),
                                place_text(place), described(components)));
  };
  tensor.component.back() = combined({tensor.component.begin(), tensor.component.end()}, checked);
  return tensor;
}

std::vector<std::string> component_keys() {
  std::vector<std::string> keys;
  for (int k = 0; k < symmetric_components; ++k) keys.push_back(symmetric_name(k));
  return keys;
}

TensorData read_components(const Node& node, const DataRequest& request) {
  require_known_keys(node, component_keys(), request);
  About any_sign = request.about;
  any_sign.range = {};
  TensorData tensor;
  for (int k = 0; k < symmetric_components; ++k) {
    const std::string key = symmetric_name(k);
    const Node* off_diagonal = k < dimension ? nullptr : node.find(key);
    if (k < dimension)
      tensor.component[k] = read_data(required_entry(node, key, request), request);
    else if (off_diagonal)
      tensor.component[k] = read_data(*off_diagonal, {request.name, any_sign, request.context});
  }
  return definite(std::move(tensor), node.origin, request);
}

/// Principal values, and then the angles of their direction.
std::vector<std::string> principal_keys() {
  if (dimension == 2) return {"along", "across", "angle"};
  return {"along", "across", "strike", "dip"};
}

/// The axis of symmetry: in a plane at `angles[0]` from the x axis, where the tensor has its value `along`; in space
/// the normal of a plane with this strike (clockwise from y, north) and dip (to the right of the strike), where it has
/// its value `across`.
Point axis_of_symmetry(const std::vector<double>& angles) {
  Point axis;
  if constexpr (dimension == 2)
    axis << std::cos(angles[0]), std::sin(angles[0]);
  else
    axis << std::sin(angles[1]) * std::cos(angles[0]), -std::sin(angles[1]) * std::sin(angles[0]), std::cos(angles[1]);
  return axis;
}

TensorData read_principal(const Node& node, const DataRequest& request) {
  const std::vector<std::string> keys = principal_keys();
  require_known_keys(node, keys, request);
  About angle_about;
  angle_about.unit = "rad";
  std::vector<Data> parts;
  for (const std::string& key : keys) {
    const Node& value = required_entry(node, key, request);
    angle_about.range = key == "dip" ? between(0, std::numbers::pi / 2) : Range{};  // steeper ones lean the other way
    const DataRequest of_angle{request.name + "." + key, angle_about, request.context};
    parts.push_back(read_data(value, parts.size() < 2 ? request : of_angle));
  }
  TensorData tensor;
  for (int k = 0; k < symmetric_components; ++k)
    tensor.component[k] = combined(parts, [k](const std::vector<double>& v, const Place&) {
      const Point axis = axis_of_symmetry({v.begin() + 2, v.end()});
      const auto& [i, j] = symmetric_axes[k];
      if (dimension == 3) return (i == j ? v[0] : 0) + (v[1] - v[0]) * axis[i] * axis[j];
      return i == j ? v[0] * axis[i] * axis[i] + v[1] * axis[1 - i] * axis[1 - i] : (v[0] - v[1]) * axis[1] * axis[0];
    });
  return tensor;
}

TensorData read_tensor_by_region(const Node& node, const DataRequest& request) {
  const auto tensors =
      read_by_region<TensorData>(node, request, [&](const Node& value) { return read_tensor(value, request); });
  TensorData whole;
  for (int k = 0; k < symmetric_components; ++k) {
    std::vector<Data> parts;
    for (const TensorData& tensor : tensors) parts.push_back(tensor.component[k]);
    const bool is_zero = k >= dimension && std::ranges::all_of(parts, &Data::is_zero);
    if (!is_zero) whole.component[k] = by_region(std::move(parts));
  }
  return whole;
}

}  // namespace

std::string TensorForm::text() const {
  std::string text;
  for (const std::string& key : keys) text += (text.empty() ? "{" : ", ") + key + ": …";
  return text + "}";
}

std::vector<TensorForm> tensor_forms() { return {{component_keys()}, {principal_keys()}}; }

TensorData read_tensor(const Node& node, const DataRequest& request) {
  if (has(node, "regions")) return read_tensor_by_region(node, request);
  const auto has_key = [&](const std::string& key) { return has(node, key); };
  if (std::ranges::any_of(principal_keys(), has_key)) return read_principal(node, request);
  if (std::ranges::any_of(component_keys(), has_key)) return read_components(node, request);
  if (node.is_map() && !node.entries.empty() && form_of(node).empty())
    throw unknown_form(node, request, {"xx", "along"});
  if (node.is_list() && std::ranges::none_of(node.items, [](const Node& item) { return has(item, "value"); }))
    throw InputError(node.origin, quoted(request.name) + " is a list", "a tensor is no list of its entries",
                     "write " + tensor_forms().front().text() + ", " + tensor_forms().back().text() +
                         ", or one value for all directions");
  return read_data(node, request);
}

}  // namespace sprekk
