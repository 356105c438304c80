#include "framework/mesh/medium.hpp"

#include <optional>
#include <stdexcept>

namespace sprekk {
namespace {

/// Inside of a function, so that it is there whichever file is initialized first.
std::optional<std::string>& registered() {
  static std::optional<std::string> name;
  return name;
}

}  // namespace

const std::string& medium_name() {
  static const std::string neutral = "medium";
  return registered() ? *registered() : neutral;
}

RegisterMedium::RegisterMedium(const std::string& name) {
  if (registered() && *registered() != name)
    throw std::logic_error("the medium is called '" + *registered() + "' and '" + name + "'");
  registered() = name;
}

}  // namespace sprekk
