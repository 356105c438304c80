#include "framework/config/spec.hpp"

#include <algorithm>

#include "framework/config/data_reader.hpp"
#include "framework/config/inner_path.hpp"
#include "framework/config/node_paths.hpp"
#include "framework/config/state.hpp"
#include "framework/config/unit.hpp"
#include "framework/config/unknown_key.hpp"

namespace sprekk {
namespace {

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// Two formulas that name the same thing may have the same mistake, which is told once.
template <class Action>
void collect(std::vector<std::string>& problems, const Action& action) {
  try {
    action();
  } catch (const InputError& error) {
    for (const std::string& problem : error.problems())
      if (!contains(problems, problem)) problems.push_back(problem);
  }
}

void require_si_unit(const Spec& spec, const Parameter& parameter) {
  const std::string where = spec.name() + ", parameter '" + parameter.name + "': ";
  try {
    if (parse_unit(parameter.about.unit).scale != 1) {
      throw std::logic_error(where + "the unit '" + parameter.about.unit + "' is not an SI unit");
    }
  } catch (const UnitProblem& problem) {
    throw std::logic_error(where + problem.problem);
  }
}

bool is_section(const Parameter& parameter) {
  return parameter.kind == "section" || parameter.kind == "named sections" || parameter.kind == "list of sections";
}

/// The path of the section inside of a map at `path` that has a parameter with this name; "" for none.
std::string path_inside(const Spec& spec, const std::string& path, const std::string& name) {
  for (const Parameter& parameter : spec.parameters()) {
    if (!parameter.inner) continue;
    const std::string inner = inner_path(path, parameter);
    if (std::ranges::any_of(parameter.inner->parameters(), [&](const Parameter& known) { return known.name == name; }))
      return inner;
    if (const std::string deeper = path_inside(*parameter.inner, inner, name); !deeper.empty()) return deeper;
  }
  return "";
}

}  // namespace

Spec::Spec(std::string name, std::string doc) : name_(std::move(name)), doc_(std::move(doc)) {}

Spec& Spec::add(Parameter parameter, Reader reader, Reader when_absent) {
  if (contains(parameter_names(), parameter.name) || contains(ignored_, parameter.name)) {
    throw std::logic_error(name_ + ": the parameter '" + parameter.name + "' is declared twice");
  }
  require_si_unit(*this, parameter);
  if (parameter.about.required) parameter.default_text.clear();
  parameters_.push_back(std::move(parameter));
  readers_.push_back(std::move(reader));
  when_absent_.push_back(std::move(when_absent));
  return *this;
}

Spec& Spec::check(std::function<void(const Node& whole)> check) {
  checks_.push_back(std::move(check));
  return *this;
}

Spec& Spec::ignore(const std::string& name) {
  if (contains(parameter_names(), name)) throw std::logic_error(name_ + ": '" + name + "' is declared and ignored");
  ignored_.push_back(name);
  return *this;
}

std::vector<std::string> Spec::parameter_names() const {
  std::vector<std::string> names;
  for (const Parameter& parameter : parameters_) names.push_back(parameter.name);
  return names;
}

bool Spec::has_required() const {
  return std::any_of(parameters_.begin(), parameters_.end(),
                     [](const Parameter& parameter) { return parameter.about.required; });
}

void Spec::read(const Node& node, const ReadContext& context) const {
  if (!node.is_map() && !node.is_null()) {
    throw wrong_kind(node, node.path.empty() ? name_ : node.path, "a map of parameters");
  }
  const ReadsMap reading;
  std::vector<std::string> problems;
  std::vector<std::string> meant;  // parameters that are there, but misspelt: not reported again as missing
  read_unknown_keys(node, problems, meant);
  for (std::size_t i = 0; i < parameters_.size(); ++i) {
    collect(problems, [&] { read_parameter(i, node, context, meant); });
  }
  if (problems.empty()) {
    for (const auto& check : checks_) collect(problems, [&] { check(node); });
  }
  if (!problems.empty()) throw InputError(problems);
}

void Spec::read_unknown_keys(const Node& node, std::vector<std::string>& problems,
                             std::vector<std::string>& meant) const {
  std::vector<std::string> names = parameter_names();
  names.insert(names.end(), ignored_.begin(), ignored_.end());
  for (const Node::Entry& entry : node.entries) {
    if (contains(names, entry.key)) continue;
    const std::string nearest = nearest_name(entry.key, names), inside = path_inside(*this, node.path, entry.key);
    if (!nearest.empty()) meant.push_back(nearest);
    const std::string belongs =
        inside.empty() ? place_of_key(entry.key) : quoted(entry.key) + " belongs in " + quoted(inside);
    std::string advice = instead_of_key(name_, entry.key);
    if (advice.empty())
      advice = name_advice(entry.key, names, belongs);
    else if (!belongs.empty())
      advice += "; " + belongs;
    problems.emplace_back(InputError(entry.origin, "unknown key " + quoted(entry.key) + " " + in_path(node.path),
                                     names.empty() ? name_ + " has no parameters" : name_ + " has: " + listed(names),
                                     advice)
                              .what());
  }
}

void Spec::read_parameter(std::size_t i, const Node& node, const ReadContext& context,
                          const std::vector<std::string>& meant) const {
  const Parameter& parameter = parameters_[i];
  const About& about = parameter.about;
  const Node* value = node.find(parameter.name);
  if (about.material && context.materials != nullptr) {
    const Node* material = context.materials->find(parameter.name);
    if (material != nullptr && context.material_used) context.material_used(parameter.name);
    if (value == nullptr) value = material;
  }
  const std::string path = joined_path(node.path, parameter.name);
  if (value != nullptr) {
    const ReadsFormula formula(with_declared(formula_variables(name_, parameter.name)));
    const ReadsParameter reading(parameter.name);
    readers_[i](*value, context);
    if (context.record && !is_section(parameter)) context.record(path, value->text(), value->origin.text());
    return;
  }
  if (about.required && contains(meant, parameter.name)) return;
  if (about.required) {
    throw InputError(node.origin, quoted(parameter.name) + " is missing " + in_path(node.path),
                     about.doc.empty() ? name_ + " needs it" : about.doc,
                     "add '" + parameter.name + ":'" + (about.unit.empty() ? "" : " in " + about.unit) +
                         (about.material ? ", here or in 'materials'" : ""));
  }
  if (when_absent_[i]) when_absent_[i](node, context);
  if (context.record && !parameter.default_text.empty()) context.record(path, parameter.default_text, "default");
}

}  // namespace sprekk
