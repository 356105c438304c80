#include "framework/config/describe/resolved_yaml.hpp"

#include <algorithm>
#include <sstream>

#include "framework/config/node.hpp"

namespace sprekk {
namespace {

struct Branch {
  std::string name;
  std::string value, origin;  ///< of a leaf
  std::vector<Branch> children;

  Branch& child(const std::string& wanted) {
    const auto found =
        std::find_if(children.begin(), children.end(), [&](const Branch& branch) { return branch.name == wanted; });
    if (found != children.end()) return *found;
    children.push_back({wanted, "", "", {}});
    return children.back();
  }

  bool is_list() const {
    for (std::size_t i = 0; i < children.size(); ++i) {
      if (children[i].name != std::to_string(i)) return false;
    }
    return !children.empty();
  }
};

/// Writes the lines of a branch; the first goes behind the "- " of its parent, where that is a list.
std::string lines(const Branch& branch, std::size_t indentation, bool continues_line) {
  std::string text;
  const bool is_list = branch.is_list();
  for (const Branch& child : branch.children) {
    const std::string margin = continues_line ? "" : std::string(indentation, ' ');
    continues_line = false;
    text += margin + (is_list ? "-" : yaml_scalar(child.name) + ":");
    if (child.children.empty()) {
      text += " " + child.value + "  # " + child.origin + "\n";
    } else if (is_list) {
      text += " " + lines(child, indentation + 2, true);
    } else {
      text += "\n" + lines(child, indentation + 2, false);
    }
  }
  return text;
}

}  // namespace

std::string resolved_yaml(const std::vector<ResolvedValue>& values) {
  Branch root;
  for (const ResolvedValue& value : values) {
    Branch* branch = &root;
    std::istringstream names(value.path);
    for (std::string name; std::getline(names, name, '.');) branch = &branch->child(name);
    branch->value = value.value;
    branch->origin = value.origin;
  }
  return lines(root, 0, false);
}

}  // namespace sprekk
