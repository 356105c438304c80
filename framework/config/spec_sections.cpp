// The parameters of a Spec that are maps or lists of maps.
#include <optional>

#include "framework/config/data_reader.hpp"
#include "framework/config/number.hpp"
#include "framework/config/spec.hpp"
#include "framework/config/unit.hpp"
#include "framework/config/unknown_key.hpp"

namespace sprekk {
namespace {

Parameter described(const std::string& name, const char* kind, const About& about, const Spec& inner) {
  Parameter parameter;
  parameter.name = name;
  parameter.kind = kind;
  parameter.about = about;
  parameter.inner = std::make_shared<const Spec>(inner);
  return parameter;
}

/// Reads all entries, and throws one InputError with the mistakes of all.
class Problems {
 public:
  template <class Action>
  void collect(const Action& action) {
    try {
      action();
    } catch (const InputError& error) {
      all_.insert(all_.end(), error.problems().begin(), error.problems().end());
    }
  }
  void throw_if_any() const {
    if (!all_.empty()) throw InputError(all_);
  }

 private:
  std::vector<std::string> all_;
};

/// "left: {pressure: 5 MPa}" for the entry "left: 5 MPa": with the first parameter that could have the value, or "".
std::string as_map(const Node::Entry& entry, const Spec& inner) {
  if (!entry.value.is_scalar()) return "";
  const std::optional<LeadingNumber> number = leading_number(entry.value.scalar);
  const std::string unit = number ? trimmed(entry.value.scalar.substr(number->length)) : "";
  for (const Parameter& parameter : inner.parameters()) {
    const bool is_name = parameter.kind == "text" && parameter.about.required && !number;
    const bool is_number = (parameter.kind == "quantity" || parameter.kind == "data") && number;
    if (is_name || (is_number && have_one_dimension(unit, parameter.about.unit)))
      return entry.key + ": {" + parameter.name + ": " + entry.value.text() + "}";
  }
  return "";
}

/// Throws InputError for an entry of named sections that is no map: its value lacks a key, or it stands in a wrong
/// place.
void require_map(const Node::Entry& entry, const Spec& inner) {
  if (entry.value.is_map() || entry.value.is_null()) return;
  const std::string map = as_map(entry, inner), belongs = place_of_key(entry.key);
  std::vector<std::string> names;
  for (const Parameter& parameter : inner.parameters()) names.push_back(parameter.name);
  throw wrong_kind(entry.value, entry.value.path, "a map of parameters: " + listed(names),
                   belongs.empty() && !map.empty() ? "write " + quoted(map) + ", if that is what it is" : belongs);
}

}  // namespace

Spec& Spec::section(const std::string& name, Spec inner, About about, bool* given) {
  Parameter parameter = described(name, "section", about, inner);
  const std::shared_ptr<const Spec> spec = parameter.inner;
  if (given != nullptr) *given = false;
  const auto read = [spec, given](const Node& node, const ReadContext& context) {
    spec->read(node, context);
    if (given != nullptr) *given = true;
  };
  const auto read_defaults = [spec, name](const Node& parent, const ReadContext& context) {
    Node empty;
    empty.origin = parent.origin;
    empty.path = parent.path.empty() ? name : parent.path + "." + name;
    if (!spec->has_required()) spec->read(empty, context);
  };
  if (given != nullptr) return add(std::move(parameter), read);
  return add(std::move(parameter), read, read_defaults);
}

Spec& Spec::named_sections(const std::string& name, const Spec& example, AddEntry add_entry, About about) {
  Parameter parameter = described(name, "named sections", about, example);
  const std::shared_ptr<const Spec> inner = parameter.inner;
  return add(std::move(parameter),
             [name, inner, add_entry = std::move(add_entry)](const Node& node, const ReadContext& context) {
               if (!node.is_map() && !node.is_null()) throw wrong_kind(node, name, "a map of names");
               Problems problems;
               for (const Node::Entry& entry : node.entries) {
                 problems.collect([&] {
                   require_map(entry, *inner);
                   add_entry(entry.key, entry.origin).read(entry.value, context);
                 });
               }
               problems.throw_if_any();
             });
}

Spec& Spec::list_of_sections(const std::string& name, const Spec& example, AddItem add_item, About about) {
  return add(described(name, "list of sections", about, example),
             [name, add_item = std::move(add_item)](const Node& node, const ReadContext& context) {
               if (!node.is_list() && !node.is_null()) throw wrong_kind(node, name, "a list of maps");
               Problems problems;
               for (std::size_t i = 0; i < node.items.size(); ++i) {
                 const Node& item = node.items[i];
                 problems.collect([&] { add_item(static_cast<int>(i), item.origin).read(item, context); });
               }
               problems.throw_if_any();
             });
}

}  // namespace sprekk
