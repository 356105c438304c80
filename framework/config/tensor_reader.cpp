// Symmetric tensors: isotropic, by components, or by principal values and their direction.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "framework/config/data_reader.hpp"
#include "framework/config/expression.hpp"

namespace sprekk {
namespace {

bool must_be_definite(const About& about) { return about.range.low >= 0; }

/// Whether the tensor is positive definite, or zero where the range of the parameter has 0.
bool is_definite(double xx, double yy, double xy, const About& about) {
  if (about.range.low_allowed && xx == 0 && yy == 0 && xy == 0) return true;
  return xx > 0 && yy > 0 && xx * yy > xy * xy;
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

/// Checks that the components together are a definite tensor: constants now, other data at every evaluation of the
/// off-diagonal component.
TensorData definite(TensorData tensor, const Origin& where, const DataRequest& request) {
  if (!must_be_definite(request.about)) return tensor;
  const bool is_constant = tensor.xx.is_constant() && tensor.yy.is_constant() && tensor.xy.is_constant();
  if (is_constant) {
    const double xx = tensor.xx.at({}), yy = tensor.yy.at({}), xy = tensor.xy.at({});
    if (is_definite(xx, yy, xy, request.about)) return tensor;
    throw InputError(where, quoted(request.name) + " is not positive definite",
                     fmt::format("xx yy = {} must be larger than xy^2 = {}", xx * yy, xy * xy));
  }
  if (tensor.xy.is_zero()) return tensor;
  const auto checked = [where, name = request.name, about = request.about](const std::vector<double>& values,
                                                                           const Place& place) {
    if (is_definite(values[0], values[1], values[2], about)) return values[2];
    throw DataError(fmt::format("{}: {} is not positive definite at {} (xx = {}, yy = {}, xy = {})", where.text(),
                                quoted(name), place_text(place), values[0], values[1], values[2]));
  };
  tensor.xy = combined({tensor.xx, tensor.yy, tensor.xy}, checked);
  return tensor;
}

TensorData read_components(const Node& node, const DataRequest& request) {
  require_known_keys(node, {"xx", "yy", "xy"}, request);
  About any_sign = request.about;
  any_sign.range = {};
  const Node* off_diagonal = node.find("xy");
  return definite(
      {read_data(required_entry(node, "xx", request), request), read_data(required_entry(node, "yy", request), request),
       off_diagonal == nullptr ? Data(0) : read_data(*off_diagonal, {request.name, any_sign, request.context})},
      node.origin, request);
}

/// a = along, b = across, c and s the cosine and sine of the angle from the x axis to `along`:
/// xx = a c^2 + b s^2, yy = a s^2 + b c^2, xy = (a - b) s c.
TensorData read_principal(const Node& node, const DataRequest& request) {
  require_known_keys(node, {"along", "across", "angle"}, request);
  About angle_about;
  angle_about.unit = "rad";
  const std::vector<Data> parts = {
      read_data(required_entry(node, "along", request), request),
      read_data(required_entry(node, "across", request), request),
      read_data(required_entry(node, "angle", request), {request.name + ".angle", angle_about, request.context})};
  using Values = std::vector<double>;
  return {
      combined(parts,
               [](const Values& v, const Place&) {
                 const double c = std::cos(v[2]), s = std::sin(v[2]);
                 return v[0] * c * c + v[1] * s * s;
               }),
      combined(parts,
               [](const Values& v, const Place&) {
                 const double c = std::cos(v[2]), s = std::sin(v[2]);
                 return v[0] * s * s + v[1] * c * c;
               }),
      combined(parts, [](const Values& v, const Place&) { return (v[0] - v[1]) * std::sin(v[2]) * std::cos(v[2]); })};
}

TensorData read_tensor_by_region(const Node& node, const DataRequest& request) {
  const auto tensors =
      read_by_region<TensorData>(node, request, [&](const Node& value) { return read_tensor(value, request); });
  std::vector<Data> xx, yy, xy;
  bool is_diagonal = true;
  for (const TensorData& tensor : tensors) {
    xx.push_back(tensor.xx);
    yy.push_back(tensor.yy);
    xy.push_back(tensor.xy);
    is_diagonal = is_diagonal && tensor.xy.is_zero();
  }
  return {by_region(std::move(xx)), by_region(std::move(yy)), is_diagonal ? Data(0) : by_region(std::move(xy))};
}

}  // namespace

TensorData read_tensor(const Node& node, const DataRequest& request) {
  if (has(node, "regions")) return read_tensor_by_region(node, request);
  if (has(node, "along") || has(node, "across") || has(node, "angle")) return read_principal(node, request);
  if (has(node, "xx") || has(node, "yy") || has(node, "xy")) return read_components(node, request);
  if (node.is_map() && !node.entries.empty() && form_of(node).empty())
    throw unknown_form(node, request, {"xx", "along"});
  if (node.is_list() && std::ranges::none_of(node.items, [](const Node& item) { return has(item, "value"); }))
    throw InputError(node.origin, quoted(request.name) + " is a list", "a tensor is no list of its entries",
                     "write {xx: …, yy: …, xy: …}, {along: …, across: …, angle: …}, or one value for all directions");
  const Data isotropic = read_data(node, request);
  return {isotropic, isotropic, 0};
}

}  // namespace sprekk
