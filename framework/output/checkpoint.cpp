#include "framework/output/checkpoint.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <nlohmann/json.hpp>

#include "framework/config/input_error.hpp"
#include "framework/output/hdf5_file.hpp"
#include "framework/output/mesh_record.hpp"

namespace sprekk {
namespace {

const std::string format_name = "sprekk checkpoint";
constexpr int format_version = 19;  // raised whenever the layout of the file, or the meaning of its values, changes

std::span<const double> span_of(const Vector& vector) {
  return {vector.data(), static_cast<std::size_t>(vector.size())};
}

Vector read_vector(const Hdf5Reader& file, const std::string& path) {
  const std::vector<double> values = file.doubles(path);
  return Eigen::Map<const Vector>(values.data(), static_cast<Eigen::Index>(values.size()));
}

template <class Map>
std::vector<std::string> names_of(const Map& map) {
  std::vector<std::string> names;
  for (const auto& [name, value] : map) names.push_back(name);
  return names;
}

// Arrays are numbered in the order of the list of names, since a name may hold characters that HDF5 reads as a path.
std::string field_path(std::size_t i, const char* level) { return fmt::format("fields/{}/{}", i, level); }
std::string extra_path(std::size_t i) { return fmt::format("extra/{}", i); }

std::string text_of(const std::vector<NoteRecord>& notes) {
  nlohmann::json list = nlohmann::json::array();
  for (const NoteRecord& note : notes)
    list.push_back({note.topic, note.text, note.first_time, note.last_time, note.steps, note.measure});
  return list.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::vector<NoteRecord> read_notes(const std::string& text) {
  std::vector<NoteRecord> notes;
  for (const nlohmann::json& note : nlohmann::json::parse(text))
    notes.push_back({note.at(0), note.at(1), note.at(2), note.at(3), note.at(4), note.at(5)});
  return notes;
}

void write_content(Hdf5Writer& file, const Checkpoint& checkpoint) {
  file.text("format", format_name);
  file.integers("format_version", std::array{format_version});
  file.text("program_version", checkpoint.program_version);
  file.text("scene_name", checkpoint.scene_name);
  file.text("scene_fingerprint", checkpoint.scene_fingerprint);
  file.text("notes", text_of(checkpoint.notes));
  write_mesh(file, checkpoint.mesh);
  file.text("fields/names", nlohmann::json(names_of(checkpoint.fields)).dump());
  std::size_t i = 0;
  for (const auto& [name, values] : checkpoint.fields) {
    file.doubles(field_path(i, "now"), span_of(values.now));
    file.doubles(field_path(i++, "accepted"), span_of(values.accepted));
  }
  file.text("extra/names", nlohmann::json(names_of(checkpoint.extra)).dump());
  i = 0;
  for (const auto& [name, values] : checkpoint.extra) file.doubles(extra_path(i++), span_of(values));
}

Checkpoint read_content(const Hdf5Reader& file) {
  Checkpoint checkpoint;
  checkpoint.program_version = file.text("program_version");
  checkpoint.scene_name = file.text("scene_name");
  checkpoint.scene_fingerprint = file.text("scene_fingerprint");
  checkpoint.notes = read_notes(file.text("notes"));
  checkpoint.mesh = read_mesh(file);
  const auto fields = file.texts("fields/names");
  for (std::size_t i = 0; i < fields.size(); ++i)
    checkpoint.fields[fields[i]] = {read_vector(file, field_path(i, "now")),
                                    read_vector(file, field_path(i, "accepted"))};
  const auto extra = file.texts("extra/names");
  for (std::size_t i = 0; i < extra.size(); ++i) checkpoint.extra[extra[i]] = read_vector(file, extra_path(i));
  return checkpoint;
}

InputError unusable(const std::filesystem::path& path, const std::string& why, const std::string& suggestion) {
  return InputError("cannot restart from " + path.string() + " (" + why + ") " + suggestion);
}

const std::string start_anew = "start the run from its beginning, without --restart";

}  // namespace

std::string fingerprint(const std::string& text) {
  std::uint64_t hash = 14695981039346656037u;
  for (const unsigned char byte : text) hash = (hash ^ byte) * 1099511628211u;
  return fmt::format("{:016x}", hash);
}

void write_checkpoint(const std::filesystem::path& path, const Checkpoint& checkpoint) {
  try {
    Hdf5Writer file(path);
    write_content(file, checkpoint);
    file.close();
  } catch (const Hdf5Error& error) {
    throw std::runtime_error("cannot write the checkpoint " + path.string() + " (" + error.what() + ")");
  }
}

Checkpoint read_checkpoint(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error))
    throw unusable(path, "there is no such file", "give the checkpoint.h5 of a run's results");
  try {
    const Hdf5Reader file(path);
    if (!file.has("format") || file.text("format") != format_name || !file.has("format_version"))
      throw unusable(path, "it is an HDF5 file, but not a checkpoint", "give the checkpoint.h5 of a run's results");
    const int version = file.integers("format_version").at(0);
    if (version != format_version)
      throw unusable(path,
                     fmt::format("its format is version {}, written by sprekk {}; this program reads version {}",
                                 version, file.text("program_version"), format_version),
                     "continue with the program that wrote it, or " + start_anew);
    return read_content(file);
  } catch (const Hdf5Error& damage) {
    throw unusable(path, damage.what(), start_anew);
  } catch (const nlohmann::json::exception&) {
    throw unusable(path, "a list of names is damaged", start_anew);
  } catch (const std::logic_error&) {  // a text that is no number, or an empty array
    throw unusable(path, "it is damaged", start_anew);
  }
}

void require_scene(const Checkpoint& checkpoint, const std::filesystem::path& path, const std::string& scene_name,
                   const std::string& scene_fingerprint, const std::string& difference) {
  if (checkpoint.scene_fingerprint == scene_fingerprint) return;
  if (checkpoint.scene_name != scene_name)
    throw unusable(path, "it belongs to the scene '" + checkpoint.scene_name + "', this one is '" + scene_name + "'",
                   "restart with the scene that wrote it, or give this scene's own checkpoint");
  throw unusable(
      path,
      "the scene '" + scene_name + "' has changed since it was written" + (difference.empty() ? "" : ": " + difference),
      "undo the changes (run.json beside the checkpoint holds the scene as it was), or " + start_anew);
}

std::map<std::string, Checkpoint::Values> field_values(const FieldStore& store) {
  std::map<std::string, Checkpoint::Values> values;
  for (const auto& field : store.all()) values[field->name()] = {field->now(), field->accepted()};
  return values;
}

void restore_fields(const Checkpoint& checkpoint, const std::filesystem::path& path, FieldStore& store) {
  const std::string suggestion = "restart with the scene and the program that wrote it, or " + start_anew;
  for (const auto& field : store.all()) {
    const auto found = checkpoint.fields.find(field->name());
    if (found == checkpoint.fields.end()) throw unusable(path, "it has no field " + field->name(), suggestion);
    const auto& [now, accepted] = found->second;
    if (now.size() != field->size() || accepted.size() != field->size())
      throw unusable(path,
                     fmt::format("field {} has {} values there and {} here", field->name(), now.size(), field->size()),
                     suggestion);
  }
  for (const auto& [name, values] : checkpoint.fields)
    if (!store.has(name)) throw unusable(path, "it has a field " + name + " that this run lacks", suggestion);
  for (const auto& field : store.all()) {
    const auto& [now, accepted] = checkpoint.fields.at(field->name());
    field->set_both(accepted);
    field->set(now);
  }
}

}  // namespace sprekk
