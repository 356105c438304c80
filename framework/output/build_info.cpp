#include "framework/output/build_info.hpp"

#include <sched.h>

#include <algorithm>
#include <fstream>

#include "framework/output/build_info_values.hpp"

namespace sprekk {

const BuildInfo& build_info() {
  static const BuildInfo info{
      SPREKK_VERSION, SPREKK_GIT_COMMIT, SPREKK_COMPILER, SPREKK_BUILD_TYPE, {SPREKK_LIBRARY_VERSIONS}};
  return info;
}

Host host() {
  cpu_set_t allowed;
  const int cores = sched_getaffinity(0, sizeof allowed, &allowed) == 0 ? CPU_COUNT(&allowed) : 1;
  std::ifstream cpuinfo("/proc/cpuinfo");
  for (std::string line; std::getline(cpuinfo, line);)
    if (line.rfind("model name", 0) == 0) return {cores, line.substr(std::min(line.find(':') + 2, line.size()))};
  return {cores, ""};
}

}  // namespace sprekk
