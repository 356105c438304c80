// run.json: the scene of a run, the program, how the run ended, and its results.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "framework/output/note_record.hpp"
#include "framework/output/profile.hpp"

namespace sprekk {

/// The record of a run. It is filled in while the run goes on, and written when the run starts and when it ends, also
/// after a failure.
struct RunRecord {
  /// A parameter of the scene with every default filled in.
  struct Parameter {
    std::string path;    ///< "components.pore.permeability"
    std::string value;   ///< as text
    std::string origin;  ///< "scene.yaml:12:5", "--set" or "default"
  };

  std::string scene_name;
  std::vector<std::string> scene_files;
  std::string scene_text;  ///< the merged scene as YAML
  std::vector<Parameter> parameters;
  std::vector<std::string> fractures;  ///< names, by the number that fields on fractures have
  /// A plug-in, and the types of components and couplers that it has brought.
  struct UsedPlugin {
    std::string file;
    std::vector<std::string> types;
  };
  std::vector<UsedPlugin> plugins;
  std::string blas;
  int processes = 1;

  std::string exit_reason = "running";    ///< "done", or why the run ended early
  int exit_code = -1;                     ///< of the command line; -1 while running
  double seconds = 0;                     ///< wall time
  std::map<std::string, double> timings;  ///< further times (s): "processor: set-up"
  std::map<std::string, long> counters;   ///< "steps accepted", "steps cut", "newton iterations"
  std::map<std::string, double> results;  ///< "quantity[unit]": the result figures
  std::vector<NoteRecord> notes;          ///< see Notes
  /// The topology of the mesh, and of meshes that parts have of their own, from an accepted step on.
  struct Topology {
    double time;       ///< s
    std::string hash;  ///< 16 hexadecimal digits; runs with the same digits have the same topology
  };
  std::vector<Topology> topologies;  ///< one for each change

  /// The record as JSON text, with the versions of the program and its libraries, the kind of host, and the profile.
  /// Numbers that are not finite become null, as JSON has none.
  std::string json(const Profile& profile) const;
  /// Replaces `file` at once. Throws std::runtime_error when it cannot be written.
  void write(const std::filesystem::path& file, const Profile& profile) const;
};

}  // namespace sprekk
