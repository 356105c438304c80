#include "framework/config/data_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "framework/config/expression.hpp"
#include "framework/config/state.hpp"
#include "framework/config/table.hpp"
#include "framework/config/units.hpp"
#include "framework/config/unknown_key.hpp"
#include "framework/round_off.hpp"

namespace sprekk {
namespace {

constexpr double forever = std::numeric_limits<double>::infinity();

struct Window {
  Data value;
  double from = -forever;
  double to = forever;  ///< the first instant after it

  bool contains(double t) const { return t >= from && t < to; }
};

Data any_datum(const Node& node, const DataRequest& request);

Window read_window(const Node& node, const DataRequest& request) {
  if (!node.is_map())
    throw InputError(node.origin, quoted(request.name) + " is a list with '" + node.text() + "'",
                     "a list gives windows in time, {value: …, from: …, to: …}", "write one value, or windows");
  require_known_keys(node, {"value", "from", "to"}, request);
  Window window{any_datum(required_entry(node, "value", request), request)};
  if (const Node* from = node.find("from")) window.from = read_number(*from, "s", {}, request.name + ".from");
  if (const Node* to = node.find("to")) window.to = read_number(*to, "s", {}, request.name + ".to");
  if (window.from < window.to) return window;
  throw InputError(node.origin, fmt::format("the window of {} is empty", quoted(request.name)),
                   fmt::format("it begins at {} s and ends at {} s", window.from, window.to), "exchange from and to");
}

Data sum_of(std::vector<Window> windows) {
  std::vector<double> switch_times;
  bool in_space = false;
  bool in_time = false;
  for (const Window& window : windows) {
    in_space = in_space || window.value.depends_on_space();
    in_time = in_time || window.value.depends_on_time();
    switch_times.insert(switch_times.end(), window.value.switch_times().begin(), window.value.switch_times().end());
    for (const double end : {window.from, window.to}) {
      if (std::isfinite(end)) switch_times.push_back(end);
    }
  }
  in_time = in_time || !switch_times.empty();
  auto sum = [windows = std::move(windows)](const Place& place) {
    double total = 0;
    for (const Window& window : windows) {
      if (window.contains(place.t)) total += window.value.at(place);
    }
    return total;
  };
  if (!in_time && !in_space) return sum({});
  return Data(std::move(sum), in_time, in_space, std::move(switch_times));
}

/// The values of a sum of constant windows are known before the run: they are checked in each interval between switch
/// times.
void check_constant_windows(const Data& sum, const std::vector<Window>& windows, const Node& node,
                            const DataRequest& request) {
  for (const Window& window : windows) {
    if (!window.value.is_constant()) return;
  }
  std::vector<double> instants = sum.switch_times();
  if (instants.empty()) return;
  // The time before the first window counts if this window begins after 0 s, where nearly all scenes start.
  if (instants.front() > 0) instants.insert(instants.begin(), std::nextafter(instants.front(), -forever));
  for (const double t : instants) {
    const double value = sum.at({Point::Zero(), 0, t});
    if (request.about.range.contains(value)) continue;
    throw InputError(node.origin, fmt::format("{} is {} at t = {} s, out of range", quoted(request.name), value, t),
                     "it must be " + request.about.range.text() + "; it is zero outside its windows");
  }
}

Data read_windows(const Node& node, const DataRequest& request) {
  std::vector<Window> windows;
  if (node.is_map()) windows.push_back(read_window(node, request));
  for (const Node& item : node.items) windows.push_back(read_window(item, request));
  if (windows.empty()) throw InputError(node.origin, quoted(request.name) + " is an empty list of windows");
  Data sum = sum_of(windows);
  check_constant_windows(sum, windows, node, request);
  return sum;
}

/// The variables that a table depends on, from `of`: one of them, or a list; by default the time.
std::vector<std::string> variables_of_table(const Node& node, const DataRequest& request) {
  const Node* const of = node.find("of");
  if (!of) return {"t"};
  std::vector<std::string> allowed = {"t"};
  for (int axis = 0; axis < dimension; ++axis) allowed.push_back(std::string(1, static_cast<char>('x' + axis)));
  std::vector<std::string> variables;
  const auto add = [&](const Node& item) {
    const std::string& variable = read_scalar(item, request.name + ".of");
    if (std::ranges::count(allowed, variable) == 0)
      throw unknown_name(item.origin, "variable of a table:", variable, allowed);
    if (std::ranges::count(variables, variable) > 0)
      throw InputError(item.origin, "the table of " + quoted(request.name) + " names " + variable + " twice", "",
                       "name each variable once");
    variables.push_back(variable);
  };
  if (!of->is_list()) add(*of);
  for (const Node& item : of->items) add(item);
  if (variables.empty()) throw InputError(of->origin, "'of' is an empty list", "a table depends on t, x or y");
  return variables;
}

Data read_tabulated(const Node& node, const DataRequest& request) {
  require_known_keys(node, {"table", "column", "of", "unit"}, request);
  TableRequest wanted;
  wanted.file = read_scalar(*node.find("table"), request.name + ".table");
  wanted.folder = request.context.folder;
  if (const Node* column = node.find("column")) wanted.column = read_scalar(*column, request.name + ".column");
  wanted.of = variables_of_table(node, request);
  if (const Node* unit = node.find("unit")) wanted.unit = read_scalar(*unit, request.name + ".unit");
  wanted.needed_unit = request.about.unit;
  wanted.name = request.name;
  wanted.where = node.origin;
  const auto table = std::make_shared<const Table>(read_table(wanted));
  for (const double value : table->values) {
    if (request.about.range.contains(value)) continue;
    throw InputError(
        node.origin,
        fmt::format("{} is {} in the table {}, out of range", quoted(request.name), value, quoted(wanted.file)),
        "it must be " + request.about.range.text() + " " + request.about.unit);
  }
  std::vector<int> axes;  // of the place, and -1 for the time
  for (const std::string& variable : wanted.of) axes.push_back(variable == "t" ? -1 : variable[0] - 'x');
  const bool in_time = std::ranges::count(axes, -1) > 0;
  return Data(
      [table, axes](const Place& place) {
        std::array<double, dimension + 1> at{};
        for (std::size_t k = 0; k < axes.size(); ++k) at[k] = axes[k] < 0 ? place.t : place.x[axes[k]];
        return table->at({at.data(), axes.size()});
      },
      in_time, !in_time || axes.size() > 1);
}

/// Reads any form of a datum. Its range is not checked yet, except where messages on its parts say more.
Data any_datum(const Node& node, const DataRequest& request) {
  if (node.is_scalar()) return parse_data(node.scalar, request.about.unit, node.origin, request.name);
  const std::string forms_text =
      "a number" + (request.about.unit.empty() ? "" : " in " + request.about.unit) + ", an expression of " +
      axes_text() + " and t, " +
      "{regions: …}, {fractures: …}, {column: …}, {table: …}, {run: …} or {value: , from: , to: }";
  if (node.is_null()) throw wrong_kind(node, request.name, forms_text);
  if (request.about.constant_only) throw wrong_kind(node, request.name, "one number");
  if (has(node, "regions")) {
    return by_region(read_by_region<Data>(node, request, [&](const Node& value) { return read_data(value, request); }));
  }
  if (has(node, "fractures")) return read_by_fracture(node, request);
  if (node.is_list() || has(node, "value")) return read_windows(node, request);
  if (has(node, "table")) return read_tabulated(node, request);
  if (has(node, "column")) return read_fracture_column(node, request);
  if (const auto further = data_forms().find(form_of(node)); further != data_forms().end())
    return further->second(node, request);
  if (node.entries.empty()) throw wrong_kind(node, request.name, forms_text);
  throw unknown_form(node, request);
}

/// The keys that tell the form of a datum.
std::vector<std::string> forms() {
  std::vector<std::string> keys = {"regions", "fractures", "column", "table", "value"};
  for (const auto& [form, read] : data_forms()) keys.push_back(form);
  return keys;
}

}  // namespace

DataForms& data_forms() {
  static DataForms forms;
  return forms;
}

std::string form_of(const Node& map) {
  for (const std::string& form : forms())
    if (has(map, form)) return form;
  return "";
}

std::vector<std::pair<std::string, std::string>> data_keys() {
  const std::pair<std::string, std::vector<std::string>> known[] = {
      {"{value: …, from: …, to: …}", {"value", "from", "to"}},
      {"{table: …, column: …, of: …, unit: …}", {"table", "column", "of", "unit"}},
      {"{regions: {NAME: …, default: …}}", {"regions", "default"}},
      {"{fractures: {NAME: …, default: …}}", {"fractures", "default"}}};
  std::vector<std::pair<std::string, std::string>> keys;
  for (const auto& [form, names] : known)
    for (const std::string& name : names) keys.emplace_back(name, form);
  for (const TensorForm& form : tensor_forms())
    for (const std::string& name : form.keys) keys.emplace_back(name, form.text());
  for (const auto& [form, read] : data_forms()) keys.emplace_back(form, "{" + form + ": …}");
  return keys;
}

InputError unknown_form(const Node& map, const DataRequest& request, const std::vector<std::string>& further) {
  std::vector<std::string> keys = further;
  std::ranges::copy(forms(), std::back_inserter(keys));
  const Node::Entry& first = map.entries.front();
  return unknown_key(first.origin, "key of " + quoted(request.name) + ":", first.key, keys);
}

namespace {

/// The bound that a value of `data` has left by round-off only, if there is one. What round-off is follows from the
/// bounds, and from the values of `data` at other places and times.
std::optional<double> left_by_roundoff(double value, const Range& range, const Data& data, const Place& place) {
  // Of the largest value of a datum, thousands of roundings: such a value is the bound.
  const bool is_below = value <= range.low;
  const double bound = is_below ? range.low : range.high;
  if (!std::isfinite(value) || !std::isfinite(bound) || !(is_below ? range.low_allowed : range.high_allowed))
    return std::nullopt;
  double scale = std::abs(bound);
  const WithoutDerivatives of_probes;
  if (std::isfinite(range.high - range.low)) scale = std::max(scale, range.high - range.low);
  for (const double share : {0.0, 0.5, 2.0})
    for (const bool in_time : {false, true}) {
      Place other = place;
      if (in_time)
        other.t *= share;
      else
        other.x *= share;
      try {
        scale = std::max(scale, std::abs(data.at(other)));
      } catch (const DataError&) {
        // It has no value there.
      }
    }
  return std::abs(value - bound) <= rounding::of_terms * scale ? std::optional(bound) : std::nullopt;
}

}  // namespace

Data within_range(Data data, const Origin& where, const DataRequest& request) {
  const Range range = request.about.range;
  const std::string limits =
      "it must be " + range.text() + (request.about.unit.empty() ? "" : " " + request.about.unit);
  if (data.is_constant()) {
    const double value = data.at({});
    if (range.contains(value)) return data;
    if (const std::optional<double> bound = left_by_roundoff(value, range, data, {})) return *bound;
    throw InputError(
        where,
        fmt::format("{} is {}, out of range", quoted(request.name), quoted(quantity_text(value, request.about.unit))),
        limits);
  }
  if (range.text().empty()) return data;
  const bool in_time = data.depends_on_time();
  const bool in_space = data.depends_on_space();
  const std::vector<double> switch_times = data.switch_times();
  auto checked = [data = std::move(data), range, where, limits, name = request.name](const Place& place) {
    const double value = data.at(place);
    if (range.contains(value)) return value;
    if (const std::optional<double> bound = left_by_roundoff(value, range, data, place)) return *bound;
    throw DataError(
        fmt::format("{}: {} is {} at {} ({})", where.text(), quoted(name), value, place_text(place), limits));
  };
  return Data(std::move(checked), in_time, in_space, switch_times);
}

Data choice_of(std::vector<Data> values, std::function<int(const Place&)> index) {
  bool in_time = false;
  std::vector<const Data*> pointers;
  for (const Data& value : values) {
    in_time = in_time || value.depends_on_time();
    pointers.push_back(&value);
  }
  std::vector<double> switch_times = merged_switch_times(pointers);
  auto pick = [values = std::move(values), index = std::move(index)](const Place& place) {
    return values.at(static_cast<std::size_t>(index(place))).at(place);
  };
  return Data(std::move(pick), in_time, true, std::move(switch_times));
}

Data by_region(std::vector<Data> values) {
  return choice_of(std::move(values), [](const Place& place) { return place.region; });
}

Data read_data(const Node& node, const DataRequest& request) {
  Data data = any_datum(node, request);
  if (request.about.constant_only && !data.is_constant()) {
    throw InputError(node.origin, quoted(request.name) + " is " + quoted(node.text()),
                     "needed is one number that does not depend on " + axes_text() + " or t");
  }
  if (data.depends_on_time() && !request.about.in_time) {
    throw InputError(node.origin, quoted(request.name) + " depends on time: " + quoted(node.text()),
                     request.about.fixed.empty()
                         ? "it is evaluated once, and what holds at the start would hold all the time"
                         : request.about.fixed,
                     "give it without t, and without windows (from, to)");
  }
  return within_range(std::move(data), node.origin, request);
}

VectorData read_vector(const Node& node, const DataRequest& request) {
  const std::string needed =
      std::string("a list of ") + (dimension == 2 ? "two" : "three") + " values [" + axes_text() + "]";
  if (!node.is_list()) throw wrong_kind(node, request.name, needed);
  if (node.items.size() != dimension) {
    throw InputError(node.origin, fmt::format("{} has {} values", quoted(request.name), node.items.size()),
                     "needed is " + needed);
  }
  VectorData vector;
  for (std::size_t i = 0; i < dimension; ++i) vector.component[i] = read_data(node.items[i], request);
  return vector;
}

}  // namespace sprekk
