// Scenes with other components of the same roles.
#pragma once

#include <fmt/format.h>

#include <string>
#include <tuple>
#include <vector>

#include "framework/config/yaml/load_scene.hpp"

namespace sprekk::testing {

/// A flow, a rock ("fem_first": with its order) and a contact.
using Choice = std::tuple<std::string, std::string, std::string>;

/// The overrides that put the choice into a scene; an empty one stays.
inline std::vector<Override> with(const Choice& choice, std::vector<Override> overrides) {
  const auto& [flow, rock, contact] = choice;
  if (!flow.empty()) overrides.push_back({"components.pore.type", "matrix_flow/" + flow});
  overrides.push_back({"components.rock.type", "poromechanics/" + rock.substr(0, rock.find('_'))});
  if (rock.starts_with("fem")) overrides.push_back({"components.rock.order", rock.substr(rock.find('_') + 1)});
  if (!contact.empty()) overrides.push_back({"components.contact.type", "contact/" + contact});
  return overrides;
}

inline std::string name_of(const Choice& choice) {
  const auto& [flow, rock, contact] = choice;
  return fmt::format("{}{}{}{}{}", flow, flow.empty() ? "" : "_", rock, contact.empty() ? "" : "_", contact);
}

}  // namespace sprekk::testing
