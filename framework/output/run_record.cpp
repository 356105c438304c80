#include "framework/output/run_record.hpp"

#include <nlohmann/json.hpp>

#include "framework/output/atomic_file.hpp"
#include "framework/output/build_info.hpp"
#include "framework/types.hpp"

namespace sprekk {
namespace {

using Json = nlohmann::ordered_json;

Json scene_json(const RunRecord& record) {
  Json parameters = Json::object();
  for (const RunRecord::Parameter& parameter : record.parameters)
    parameters[parameter.path] = {{"value", parameter.value}, {"origin", parameter.origin}};
  return {{"name", record.scene_name},
          {"files", record.scene_files},
          {"parameters", parameters},
          {"fractures", record.fractures},
          {"text", record.scene_text}};
}

Json program_json(const RunRecord& record) {
  const BuildInfo& build = build_info();
  Json plugins = Json::array();
  for (const RunRecord::UsedPlugin& plugin : record.plugins)
    plugins.push_back({{"file", plugin.file}, {"types", plugin.types}});
  return {{"version", build.version},
          {"git_commit", build.git_commit},
          {"compiler", build.compiler},
          {"build_type", build.build_type},
          {"libraries", build.libraries},
          {"blas", record.blas},
          {"plugins", plugins}};
}

Json profile_json(const Profile& profile) {
  Json objects = Json::array();
  for (const Profile::Entry& entry : profile.entries())
    objects.push_back({{"name", entry.name},
                       {"calls", entry.calls},
                       {"reuses", entry.reuses},
                       {"skips", entry.skips},
                       {"seconds", entry.seconds}});
  return objects;
}

Json notes_json(const std::vector<NoteRecord>& notes) {
  Json list = Json::array();
  for (const NoteRecord& note : notes)
    list.push_back({{"topic", note.topic},
                    {"text", note.text},
                    {"first_time", note.first_time},
                    {"last_time", note.last_time},
                    {"steps", note.steps}});
  return list;
}

Json topologies_json(const std::vector<RunRecord::Topology>& topologies) {
  Json list = Json::array();
  for (const RunRecord::Topology& topology : topologies)
    list.push_back({{"time", topology.time}, {"hash", topology.hash}});
  return list;
}

}  // namespace

std::string RunRecord::json(const Profile& profile) const {
  const Host machine = host();
  const Json whole = {
      {"dimension", dimension},
      {"exit", {{"code", exit_code}, {"reason", exit_reason}}},
      {"results", results},
      {"notes", notes_json(notes)},
      {"counters", counters},
      {"meshes", topologies_json(topologies)},
      {"seconds", seconds},
      {"timings", timings},
      {"profile", profile_json(profile)},
      {"program", program_json(*this)},
      {"host", {{"cores", machine.cores}, {"processor", machine.processor}, {"processes", processes}}},
      {"scene", scene_json(*this)},
  };
  // Text from outside may hold bytes that are no UTF-8; they are replaced, since the record must never fail to appear.
  return whole.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

void RunRecord::write(const std::filesystem::path& file, const Profile& profile) const {
  write_atomically(file, json(profile));
}

}  // namespace sprekk
