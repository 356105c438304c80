#include "framework/scene/unusual_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <iterator>

#include "framework/config/data_reader.hpp"
#include "framework/config/expression.hpp"
#include "framework/config/number.hpp"
#include "framework/config/quantity_scale.hpp"
#include "framework/config/state.hpp"
#include "framework/config/table.hpp"
#include "framework/config/unit.hpp"
#include "framework/config/units.hpp"
#include "framework/name_pattern.hpp"
#include "framework/scene/registry.hpp"

namespace sprekk {
namespace {

/// Whether the value is of order one, or zero, or contains the width of a fracture, which is small beside a box of
/// order one.
bool is_of_order_one(const PropertyValue& property) {
  constexpr double most = 1e3;  // values in SI units are larger or smaller
  const double size = std::abs(property.value);
  return property.unit == "m" || property.unit == "m^3" || size == 0 || (size <= most && size * most >= 1);
}

std::string lower_case(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

std::string advice(const PropertyValue& property) {
  const std::vector<std::string> others = usual_with_other_units(property);
  std::string text;
  for (std::size_t i = 0; i < others.size(); ++i)
    text += (i == 0 ? "did you mean " : i + 1 == others.size() ? " or " : ", ") + quoted(others[i]);
  return others.empty() ? "check its unit and its power of ten" : text + "?";
}

}  // namespace

std::vector<std::string> usual_with_other_units(const PropertyValue& property) {
  const std::optional<LeadingNumber> number = leading_number(property.text);
  if (!number) return {};
  const std::string digits = property.text.substr(0, number->length);
  const std::string written = trimmed(property.text.substr(number->length));
  std::vector<std::string> others;
  for (const std::string& unit : units_like(written)) {
    const double value = number->value * parse_unit(unit).scale;
    if (value == 0 || !property.usual.contains(value)) continue;
    if (lower_case(unit) == lower_case(written)) return {digits + " " + unit};
    others.push_back(digits + " " + unit);
  }
  return others;
}

namespace {

/// Where and when a value holds.
struct Extent {
  std::vector<Place> places;
  double from, to;  ///< s

  /// The part of it with these places.
  template <class Holds>
  Extent where(const Holds& holds) const {
    Extent part{{}, from, to};
    std::ranges::copy_if(places, std::back_inserter(part.places), holds);
    return part;
  }
};

/// Collects the values of properties from the tree of a scene that has been read, and so is right.
class Properties {
 public:
  Properties(const Scene& scene, const PlacesOfParts& places) : scene_(scene), mesh_(places.mesh()) {
    for (const Fracture& fracture : mesh_.fractures) fracture_names_.push_back(fracture.name);
    for (const Spec& spec : scene_section_specs())
      if (const Node* section = scene.whole.find(spec.name())) read_map(spec, *section, always({}));
    const Node* components = scene.whole.find("components");
    for (const Scene::ComponentEntry& component : scene.components) {
      const Node& map = *components->find(component.name);
      if (const Node* history = map.find("history")) remembered_ = history->entries;
      read_map(Registry::instance().component(component.type, component.origin).spec(), map,
               always(places.of({component.name})));
      remembered_.clear();
    }
    for (const Scene::CouplerEntry& coupler : scene.couplers)
      for (const Node& node : scene.whole.find("couplers")->items)
        if (node.origin.text() == coupler.origin.text())
          read_map(Registry::instance().coupler(coupler.type, coupler.origin).spec(), node,
                   always(places.of(coupler.between)));
  }

  std::vector<PropertyValue> all() && { return std::move(all_); }

 private:
  Extent always(std::vector<Place> places) const { return {std::move(places), scene_.time.start, scene_.time.end}; }

  void read_map(const Spec& spec, const Node& map, const Extent& extent) {
    const Node* const materials = scene_.whole.find("materials");
    for (const Parameter& parameter : spec.parameters()) {
      const Node* value = map.find(parameter.name);
      if (!value && parameter.about.material && materials) value = materials->find(parameter.name);
      if (!value) continue;
      if (const UsualRange* usual = usual_range(spec, parameter.name, map)) {
        const ReadsFormula formula(formula_variables(spec.name(), parameter.name));
        read_value({parameter.name, "", parameter.about.unit, 0, "", *usual, {}}, *value, extent);
      }
      if (!parameter.inner) continue;
      if (parameter.kind == "section") read_map(*parameter.inner, *value, extent);
      for (const Node::Entry& entry : value->entries)
        if (parameter.kind == "named sections") read_map(*parameter.inner, entry.value, extent);
      for (const Node& item : value->items) read_map(*parameter.inner, item, extent);
    }
  }

  /// All parts of a datum, in any of its forms.
  void read_value(const PropertyValue& property, const Node& node, const Extent& extent) {
    if (node.is_scalar()) return read_scalar(property, node, extent);
    for (const Node& window : node.items) read_value(property, window, extent);
    if (const Node* table = node.find("table")) return read_table_of(property, *table, node);
    if (const Node* column = node.find("column")) return read_column(property, *column);
    if (const Node* values = node.find("regions"))
      read_named(property, *values, extent, [&](const Place& x) { return mesh_.region_names[x.region]; });
    if (const Node* values = node.find("fractures"))
      read_named(property, *values, extent,
                 [&](const Place& x) { return x.fracture == none ? "" : fracture_names_[x.fracture]; });
    const Extent window = within_window(node, extent);
    for (const char* part : {"value", "xx", "yy", "along", "across", "default"})
      if (const Node* value = node.find(part)) read_value(property, *value, window);
    if (const Node* angle = node.find("angle"))
      read_value({property.name + ".angle", "", "rad", 0, "", usual_angle(), {}}, *angle, extent);
  }

  Extent within_window(const Node& node, Extent extent) const {
    if (const Node* from = node.find("from")) extent.from = std::max(extent.from, read_number(*from, "s", {}, "from"));
    if (const Node* to = node.find("to")) extent.to = std::min(extent.to, read_number(*to, "s", {}, "to"));
    return extent;
  }

  /// Each entry holds where the name of a place is its own, and the default everywhere else.
  template <class NameAt>
  void read_named(const PropertyValue& property, const Node& values, const Extent& extent, const NameAt& name_at) {
    for (const Node::Entry& entry : values.entries)
      if (entry.value.is_scalar() && leading_number(entry.value.scalar)) {
        read_value(property, entry.value, extent);  // a number is the same everywhere
      } else if (entry.key == "default") {
        read_value(property, entry.value, extent.where([&](const Place& x) {
          return std::ranges::none_of(values.entries,
                                      [&](const Node::Entry& other) { return stands_for(other.key, name_at(x)); });
        }));
      } else {
        read_value(property, entry.value,
                   extent.where([&](const Place& x) { return stands_for(entry.key, name_at(x)); }));
      }
  }

  /// An expression takes the most unusual of its values.
  void read_scalar(PropertyValue property, const Node& node, const Extent& extent) {
    if (std::ranges::any_of(remembered_, [&](const Node::Entry& entry) { return names(node.scalar, entry.key); }))
      return;
    const Data data = parse_data(node.scalar, property.unit, node.origin, property.name);
    if (!data.is_constant() && variables_named(data, {}, ReadsFormula::variables()) != 0) return;
    if (data.is_constant()) return add(std::move(property), data.at({}), node.scalar, node.origin);
    std::vector<double> times = {extent.from};
    if (data.depends_on_time()) times.insert(times.end(), {(extent.from + extent.to) / 2, extent.to});
    std::optional<double> told;
    for (Place place : extent.places)
      for (const double time : times) try {
          place.t = time;
          const double value = data.at(place);
          if (told && property.usual.distance(value) <= property.usual.distance(*told)) continue;
          told = value;
          property.holds = fmt::format(", {:.4g}{}{} at {}", value, property.unit.empty() ? "" : " ", property.unit,
                                       place_text(place));
        } catch (const DataError&) {
          // It has no value there; where it is needed, this is an error.
        }
    if (told) add(std::move(property), *told, node.scalar, node.origin);
  }

  void read_table_of(const PropertyValue& property, const Node& file, const Node& node) {
    const Node *column = node.find("column"), *of = node.find("of"), *unit = node.find("unit");
    TableRequest request;
    request.file = file.scalar;
    request.folder = scene_.folder;
    if (column) request.column = column->scalar;
    request.of = {of && of->is_scalar() ? of->scalar : "t"};
    if (of && of->is_list()) {
      request.of.clear();
      for (const Node& variable : of->items) request.of.push_back(variable.scalar);
    }
    if (unit) request.unit = unit->scalar;
    request.needed_unit = property.unit;
    request.name = property.name;
    request.where = node.origin;
    const Table table = read_table(request);
    const auto [least, most] = std::ranges::minmax(table.values);
    for (const double value : {least, most}) add(property, value, quantity_text(value, property.unit), node.origin);
  }

  void read_column(const PropertyValue& property, const Node& column) {
    std::vector<std::pair<double, const ColumnValue*>> found;
    for (const FractureGeometry& fracture : scene_.geometry.fractures)
      for (const ColumnValue& value : fracture.values) {
        if (value.column != column.scalar) continue;
        const bool has_unit = !value.unit.empty();
        found.emplace_back(
            value.value *
                (has_unit ? scale_to_si(value.unit, property.unit, value.unit, value.where, value.column) : 1),
            &value);
      }
    if (found.empty()) return;
    const auto [least, most] = std::ranges::minmax(found, {}, &std::pair<double, const ColumnValue*>::first);
    for (const auto& [value, given] : {least, most})
      add(property, value, quantity_text(given->value, given->unit.empty() ? property.unit : given->unit),
          given->where);
  }

  void add(PropertyValue property, double value, const std::string& text, const Origin& where) {
    property.value = value;
    property.text = text;
    property.where = where;
    all_.push_back(std::move(property));
  }

  const Scene& scene_;
  const Mesh& mesh_;
  std::vector<std::string> fracture_names_;
  std::vector<Node::Entry> remembered_;  ///< of the component that is read: formulas may name them
  std::vector<PropertyValue> all_;
};

}  // namespace

std::vector<PropertyValue> properties_of(const Scene& scene, const PlacesOfParts& places) {
  return Properties(scene, places).all();
}

void note_unusual_values(const std::vector<PropertyValue>& properties, Notes& notes) {
  const bool may_have_no_dimensions = std::ranges::all_of(properties, is_of_order_one);
  for (const PropertyValue& property : properties) {
    if (property.usual.contains(property.value)) continue;
    const bool has_dimension = !property.unit.empty() && property.unit != "rad";
    const std::string range = usual_text(property.usual, property.unit);
    if (may_have_no_dimensions && has_dimension)
      notes.add("scene without dimensions",
                fmt::format("{}: the scene is treated as one without dimensions (all its properties are of order one, "
                            "such as {} = {}, which as a rule is {}) check the units, if that is not meant",
                            property.where.text(), quoted(property.name), quoted(property.text), range));
    else
      notes.add("unusual " + property.name + " at " + property.where.text(),
                fmt::format("{}: {} is {}{} (as a rule it is {}: {}) {}", property.where.text(), quoted(property.name),
                            quoted(property.text), property.holds, range, property.usual.source, advice(property)));
  }
}

}  // namespace sprekk
