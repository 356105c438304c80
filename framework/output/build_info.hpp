// Version, libraries and machine of the program, which make a result reproducible.
#pragma once

#include <map>
#include <string>

namespace sprekk {

/// The version of the program, and how it was built.
struct BuildInfo {
  std::string version;     ///< of Sprekk
  std::string git_commit;  ///< when the build was configured; "" if it was not a git checkout
  std::string compiler;
  std::string build_type;                        ///< Release, Debug, …
  std::map<std::string, std::string> libraries;  ///< name, version
};
const BuildInfo& build_info();

/// The machine that the program runs on.
struct Host {
  int cores;              ///< that this process may use
  std::string processor;  ///< its model; "" if unknown
};
Host host();

}  // namespace sprekk
