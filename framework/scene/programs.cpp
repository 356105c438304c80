#include "framework/scene/programs.hpp"

#include "framework/outside/commands.hpp"
#include "framework/outside/solved_outside.hpp"

namespace sprekk {

void require_programs(const std::vector<Part*>& parts) {
  std::vector<std::string> names;
  for (const auto* outside : parts_with<SolvedOutside>(parts)) names.push_back(outside->component());
  for (const std::string& named : programs_named()) {
    if (std::ranges::count(names, named) > 0) continue;
    if (names.empty())
      throw InputError({"--program"}, "no component takes the program of " + quoted(named),
                       "the scene has no component of another program", "leave the option out");
    throw unknown_name({"--program"}, "component of another program", named, names);
  }
  for (const auto* outside : parts_with<SolvedOutside>(parts)) outside->require_command();
}

void require_programs_can_join(const std::vector<Part*>& parts, bool has_growth, const StartOptions& start) {
  for (const auto* outside : parts_with<SolvedOutside>(parts)) {
    const std::string& name = outside->component();
    if (has_growth)
      throw InputError(outside->origin(), "the program of " + quoted(name) + " cannot take part where the mesh grows",
                       "it knows the mesh of the start only", "remove the 'grow' step, or the component");
    if (std::ranges::count(start.settle, name) > 0)
      throw InputError(start.origin, quoted(name) + " cannot be settled",
                       "it is another program, which is started with the first step", "remove it from 'settle'");
  }
}

}  // namespace sprekk
