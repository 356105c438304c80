#include "framework/parallel/environment_at_start.hpp"

#include <fstream>

namespace sprekk::parallel {

std::vector<std::string> environment_at_start() {
  std::ifstream file("/proc/self/environ", std::ios::binary);
  std::vector<std::string> variables;
  for (std::string variable; std::getline(file, variable, '\0');) variables.push_back(variable);
  return variables;
}

}  // namespace sprekk::parallel
