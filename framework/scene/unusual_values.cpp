#include "framework/scene/unusual_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "framework/config/data_reader.hpp"
#include "framework/config/number.hpp"
#include "framework/config/quantity_scale.hpp"
#include "framework/config/table.hpp"
#include "framework/config/unit.hpp"
#include "framework/config/units.hpp"
#include "framework/scene/registry.hpp"

namespace sprekk {
namespace {

/// Whether the value is of order one, or zero, or a length: those are small beside a box of order one.
bool is_of_order_one(const PropertyValue& property) {
  constexpr double most = 1e3;
  const double size = std::abs(property.value);
  return property.unit == "m" || size == 0 || (size <= most && size * most >= 1);
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

/// Collects the values of properties from the tree of a scene that has been read, and so is right.
class Properties {
 public:
  explicit Properties(const Scene& scene) : scene_(scene) {
    const Box& box = scene.geometry.box;  // of no size where a mesh file takes its place
    for (const double x : {0.0, 0.5, 1.0})
      for (const double y : {0.0, 0.5, 1.0})
        samples_.push_back({Point(box.low + Point(x, y).cwiseProduct(box.size())), 0, scene.time.start});
    for (const Spec& spec : scene_section_specs())
      if (const Node* section = scene.whole.find(spec.name())) read_map(spec, *section);
    const Node* components = scene.whole.find("components");
    for (const Scene::ComponentEntry& component : scene.components)
      read_map(Registry::instance().component(component.type, component.origin).spec(),
               *components->find(component.name));
    if (const Node* couplers = scene.whole.find("couplers"))
      for (const Node& coupler : couplers->items)
        read_map(Registry::instance().coupler(coupler.find("type")->scalar, coupler.origin).spec(), coupler);
  }

  std::vector<PropertyValue> all() && { return std::move(all_); }

 private:
  void read_map(const Spec& spec, const Node& map) {
    const Node* const materials = scene_.whole.find("materials");
    for (const Parameter& parameter : spec.parameters()) {
      const Node* value = map.find(parameter.name);
      if (!value && parameter.about.material && materials) value = materials->find(parameter.name);
      if (!value) continue;
      if (const UsualRange* usual = usual_range(spec, parameter.name))
        read_value({parameter.name, "", parameter.about.unit, 0, *usual, {}}, *value);
      if (!parameter.inner) continue;
      if (parameter.kind == "section") read_map(*parameter.inner, *value);
      for (const Node::Entry& entry : value->entries)
        if (parameter.kind == "named sections") read_map(*parameter.inner, entry.value);
      for (const Node& item : value->items) read_map(*parameter.inner, item);
    }
  }

  /// All parts of a datum, in any of its forms.
  void read_value(const PropertyValue& property, const Node& node) {
    if (node.is_scalar()) return read_scalar(property, node);
    for (const Node& window : node.items) read_value(property, window);
    if (const Node* table = node.find("table")) return read_table_of(property, *table, node);
    if (const Node* column = node.find("column")) return read_column(property, *column);
    for (const char* places : {"regions", "fractures"})
      if (const Node* values = node.find(places))
        for (const Node::Entry& entry : values->entries) read_value(property, entry.value);
    for (const char* part : {"value", "xx", "yy", "along", "across", "default"})
      if (const Node* value = node.find(part)) read_value(property, *value);
    if (const Node* angle = node.find("angle"))
      read_value({property.name + ".angle", "", "rad", 0, usual_angle(), {}}, *angle);
  }

  void read_scalar(const PropertyValue& property, const Node& node) {
    const Data data = parse_data(node.scalar, property.unit, node.origin, property.name);
    std::optional<double> told;  // the least usual value
    for (const Place& place : data.is_constant() ? std::vector<Place>(1) : samples_) try {
        const double value = data.at(place);
        if (!told || !property.usual.contains(value)) told = value;
      } catch (const DataError&) {
        // It has no value there; where it is needed, this is an error.
      }
    if (told) add(property, *told, node.scalar, node.origin);
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
    for (const FractureGeometry& fracture : scene_.geometry.fractures)
      for (const ColumnValue& value : fracture.values)
        if (value.column == column.scalar)
          add(property,
              value.value * (value.unit.empty()
                                 ? 1
                                 : scale_to_si(value.unit, property.unit, value.unit, value.where, value.column)),
              quantity_text(value.value, value.unit), value.where);
  }

  void add(PropertyValue property, double value, const std::string& text, const Origin& where) {
    property.value = value;
    property.text = text;
    property.where = where;
    all_.push_back(std::move(property));
  }

  const Scene& scene_;
  std::vector<Place> samples_;
  std::vector<PropertyValue> all_;
};

}  // namespace

std::vector<PropertyValue> properties_of(const Scene& scene) { return Properties(scene).all(); }

void note_unusual_values(const std::vector<PropertyValue>& properties, Notes& notes) {
  const bool may_have_no_dimensions = std::ranges::all_of(properties, is_of_order_one);
  for (const PropertyValue& property : properties) {
    if (property.usual.contains(property.value)) continue;
    const bool has_dimension = !property.unit.empty() && property.unit != "rad";
    const std::string range = usual_text(property.usual, property.unit);
    if (may_have_no_dimensions && has_dimension)
      notes.add("scene without dimensions",
                fmt::format("{}: the scene is taken for one without dimensions (all its properties are of order one, "
                            "such as {} = {}, which as a rule is {}) check the units, if it has dimensions",
                            property.where.text(), quoted(property.name), quoted(property.text), range));
    else
      notes.add("unusual " + property.name + " at " + property.where.text(),
                fmt::format("{}: {} is {} (as a rule it is {}: {}) {}", property.where.text(), quoted(property.name),
                            quoted(property.text), range, property.usual.source, advice(property)));
  }
}

}  // namespace sprekk
