// The parameters of a Spec that are single values, or lists of them.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "framework/config/data_reader.hpp"
#include "framework/config/spec.hpp"
#include "framework/config/units.hpp"

namespace sprekk {
namespace {

std::string text_of(double value, const About& about) { return quantity_text(value, about.unit); }

std::string text_of(const Data& data, const About& about) {
  return data.is_constant() ? text_of(data.at({}), about) : "(function)";
}

/// Numbers or data of a point or vector in brackets.
template <class Values>
std::string listed_numbers(const Values& values, const About& about) {
  std::string text;
  for (int k = 0; k < dimension; ++k) text += (k == 0 ? "[" : ", ") + text_of(values[k], about);
  return text + "]";
}

std::string text_of(const VectorData& vector, const About& about) { return listed_numbers(vector.component, about); }

std::string text_of(const TensorData& tensor, const About& about) {
  std::vector<std::string> texts;
  for (const Data& each : tensor.component) texts.push_back(text_of(each, about));
  if (tensor.is_diagonal() && std::all_of(texts.begin(), texts.begin() + dimension,
                                          [&](const std::string& text) { return text == texts.front(); }))
    return texts.front();
  std::string text;
  for (int k = 0; k < symmetric_components; ++k) text += (k == 0 ? "{" : ", ") + symmetric_name(k) + ": " + texts[k];
  return text + "}";
}

std::string text_of(const Point& point, const About& about) { return listed_numbers(point, about); }

template <class Value>
std::string text_of(const std::vector<Value>& values, const About& about) {
  std::string text;
  for (const Value& value : values) text += (text.empty() ? "" : ", ") + text_of(value, about);
  return "[" + text + "]";
}

template <class Value>
std::string text_of(const std::optional<Value>& value, const About& about) {
  return value ? text_of(*value, about) : "";
}

/// Checks that a scene may give the default itself: otherwise the output of `sprekk show` could not be run.
void require_default_in_range(double value, const std::string& name, const About& about) {
  if (about.required || about.range.contains(value)) return;
  throw std::logic_error(
      fmt::format("the default of '{}' is {}, but it must be {}", name, text_of(value, about), about.range.text()));
}

const Node& list_of(const Node& node, const std::string& name, const std::string& needed) {
  if (!node.is_list()) throw wrong_kind(node, name, needed);
  return node;
}

Point read_point(const Node& node, const std::string& name, const About& about) {
  const std::string needed = "a point [" + axes_text() + "]" + (about.unit.empty() ? "" : " in " + about.unit);
  list_of(node, name, needed);
  if (node.items.size() != dimension) {
    throw InputError(node.origin, fmt::format("{} has {} coordinates", quoted(name), node.items.size()),
                     "needed is " + needed);
  }
  Point point;
  for (int i = 0; i < dimension; ++i) {
    point[i] = read_number(node.items[static_cast<std::size_t>(i)], about.unit, about.range, name);
  }
  return point;
}

bool read_flag(const Node& node, const std::string& name) {
  std::string word = node.is_scalar() ? node.scalar : "";
  std::transform(word.begin(), word.end(), word.begin(), [](unsigned char c) { return std::tolower(c); });
  if (word == "true" || word == "yes" || word == "on") return true;
  if (word == "false" || word == "no" || word == "off") return false;
  throw wrong_kind(node, name, "true or false");
}

int read_integer(const Node& node, const std::string& name, const Range& range) {
  const std::string& text = read_scalar(node, name);
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc::result_out_of_range) {
    throw InputError(node.origin, quoted(name) + " is " + quoted(text), "too large for a whole number");
  }
  if (error != std::errc{} || end != text.data() + text.size()) throw wrong_kind(node, name, "a whole number");
  if (range.contains(value)) return value;
  throw InputError(node.origin, quoted(name) + " is " + quoted(text) + ", out of range", "it must be " + range.text());
}

std::vector<std::string> names_of(const std::vector<std::pair<std::string, std::string>>& choices) {
  std::vector<std::string> names;
  for (const auto& [name, doc] : choices) names.push_back(name);
  return names;
}

Parameter described(const std::string& name, const char* kind, const About& about, std::string default_text) {
  Parameter parameter;
  parameter.name = name;
  parameter.kind = kind;
  parameter.about = about;
  parameter.default_text = std::move(default_text);
  return parameter;
}

}  // namespace

Spec& Spec::quantity(const std::string& name, double& target, About about) {
  require_default_in_range(target, name, about);
  return add(described(name, "quantity", about, text_of(target, about)),
             [name, about, &target](const Node& node, const ReadContext&) {
               target = read_number(node, about.unit, about.range, name);
             });
}

Spec& Spec::quantity(const std::string& name, std::optional<double>& target, About about) {
  return add(described(name, "quantity", about, text_of(target, about)),
             [name, about, &target](const Node& node, const ReadContext&) {
               target = read_number(node, about.unit, about.range, name);
             });
}

Spec& Spec::data(const std::string& name, Data& target, About about) {
  if (target.is_constant()) require_default_in_range(target.at({}), name, about);
  return add(described(name, "data", about, text_of(target, about)),
             [name, about, &target](const Node& node, const ReadContext& context) {
               target = read_data(node, {name, about, context});
             });
}

Spec& Spec::data(const std::string& name, std::optional<Data>& target, About about) {
  return add(described(name, "data", about, text_of(target, about)),
             [name, about, &target](const Node& node, const ReadContext& context) {
               target = read_data(node, {name, about, context});
             });
}

Spec& Spec::vector(const std::string& name, VectorData& target, About about) {
  return add(described(name, "vector", about, text_of(target, about)),
             [name, about, &target](const Node& node, const ReadContext& context) {
               target = read_vector(node, {name, about, context});
             });
}

Spec& Spec::vector(const std::string& name, std::optional<VectorData>& target, About about) {
  return add(described(name, "vector", about, text_of(target, about)),
             [name, about, &target](const Node& node, const ReadContext& context) {
               target = read_vector(node, {name, about, context});
             });
}

Spec& Spec::tensor(const std::string& name, TensorData& target, About about) {
  return add(described(name, "tensor", about, text_of(target, about)),
             [name, about, &target](const Node& node, const ReadContext& context) {
               target = read_tensor(node, {name, about, context});
             });
}

Spec& Spec::tensor(const std::string& name, std::optional<TensorData>& target, About about) {
  return add(described(name, "tensor", about, text_of(target, about)),
             [name, about, &target](const Node& node, const ReadContext& context) {
               target = read_tensor(node, {name, about, context});
             });
}

Spec& Spec::point(const std::string& name, Point& target, About about) {
  return add(described(name, "point", about, text_of(target, about)),
             [name, about, &target](const Node& node, const ReadContext&) { target = read_point(node, name, about); });
}

Spec& Spec::point(const std::string& name, std::optional<Point>& target, About about) {
  return add(described(name, "point", about, text_of(target, about)),
             [name, about, &target](const Node& node, const ReadContext&) { target = read_point(node, name, about); });
}

Spec& Spec::points(const std::string& name, std::vector<Point>& target, About about) {
  return add(described(name, "points", about, text_of(target, about)),
             [name, about, &target](const Node& node, const ReadContext&) {
               std::vector<Point> points;
               for (const Node& item : list_of(node, name, "a list of points [[" + axes_text() + "], …]").items) {
                 points.push_back(read_point(item, name, about));
               }
               target = std::move(points);
             });
}

Spec& Spec::quantities(const std::string& name, std::vector<double>& target, About about) {
  return add(described(name, "quantities", about, text_of(target, about)),
             [name, about, &target](const Node& node, const ReadContext&) {
               std::vector<double> values;
               for (const Node& item : list_of(node, name, "a list [a, b, …]").items) {
                 values.push_back(read_number(item, about.unit, about.range, name));
               }
               target = std::move(values);
             });
}

Spec& Spec::integer(const std::string& name, int& target, About about) {
  require_default_in_range(target, name, about);
  return add(
      described(name, "integer", about, std::to_string(target)),
      [name, about, &target](const Node& node, const ReadContext&) { target = read_integer(node, name, about.range); });
}

Spec& Spec::flag(const std::string& name, bool& target, About about) {
  return add(described(name, "flag", about, target ? "true" : "false"),
             [name, &target](const Node& node, const ReadContext&) { target = read_flag(node, name); });
}

Spec& Spec::text(const std::string& name, std::string& target, About about) {
  return add(described(name, "text", about, yaml_scalar(target)),
             [name, &target](const Node& node, const ReadContext&) { target = read_scalar(node, name); });
}

Spec& Spec::text(const std::string& name, std::optional<std::string>& target, About about) {
  return add(described(name, "text", about, target ? yaml_scalar(*target) : ""),
             [name, &target](const Node& node, const ReadContext&) { target = read_scalar(node, name); });
}

Spec& Spec::texts(const std::string& name, std::vector<std::string>& target, About about) {
  std::string default_text;
  for (const std::string& text : target) default_text += (default_text.empty() ? "" : ", ") + yaml_scalar(text);
  return add(described(name, "texts", about, "[" + default_text + "]"),
             [name, &target](const Node& node, const ReadContext&) {
               std::vector<std::string> texts;
               if (node.is_scalar()) texts.push_back(node.scalar);
               if (!node.is_scalar() && !node.is_list()) throw wrong_kind(node, name, "one name or a list of names");
               for (const Node& item : node.items) {
                 if (!item.is_scalar()) throw wrong_kind(item, name, "one name or a list of names");
                 texts.push_back(item.scalar);
               }
               target = std::move(texts);
             });
}

Spec& Spec::choice(const std::string& name, std::string& target,
                   std::vector<std::pair<std::string, std::string>> values_and_docs, About about) {
  const std::vector<std::string> allowed = names_of(values_and_docs);
  const bool is_allowed = std::find(allowed.begin(), allowed.end(), target) != allowed.end();
  if (!about.required && !is_allowed && !target.empty()) {
    throw std::logic_error("the default '" + target + "' of '" + name + "' is not one of its choices");
  }
  Parameter parameter = described(name, "choice", about, target.empty() ? "" : yaml_scalar(target));
  parameter.choices = std::move(values_and_docs);
  return add(std::move(parameter), [name, allowed, &target](const Node& node, const ReadContext&) {
    const std::string& word = read_scalar(node, name);
    if (std::find(allowed.begin(), allowed.end(), word) == allowed.end()) {
      throw unknown_name(node.origin, "value of " + quoted(name) + ":", word, allowed);
    }
    target = word;
  });
}

Spec& Spec::custom(const std::string& name, std::function<void(const Node&)> read, About about) {
  return add(described(name, "custom", about, ""),
             [read = std::move(read)](const Node& node, const ReadContext&) { read(node); });
}

}  // namespace sprekk
