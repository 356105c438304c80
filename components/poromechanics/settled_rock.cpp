#include "components/poromechanics/settled_rock.hpp"

namespace sprekk::poromechanics {
namespace {

struct Named {
  const char* name;
  Vector SettledRock::*values;
};
constexpr Named named[] = {{".settled.forces", &SettledRock::forces},
                           {".settled.stress", &SettledRock::stress},
                           {".settled.displacements", &SettledRock::displacements}};

}  // namespace

void SettledRock::save(const std::string& name, std::map<std::string, Vector>& state) const {
  for (const Named& each : named) state[name + each.name] = this->*each.values;
}

std::optional<SettledRock> SettledRock::restored(const std::string& name, const std::map<std::string, Vector>& state) {
  SettledRock settled;
  for (const Named& each : named) {
    const auto found = state.find(name + each.name);
    if (found == state.end()) return std::nullopt;
    settled.*each.values = found->second;
  }
  return settled;
}

}  // namespace sprekk::poromechanics
