// Checkpoints: all that a run needs to continue after an accepted step, in one file.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "framework/field/field_store.hpp"
#include "framework/output/note_record.hpp"

namespace sprekk {

/// The state of a run at an accepted step: mesh, fields, notes, and the state of the controller and of parts.
struct Checkpoint {
  /// The two time levels of a field.
  struct Values {
    Vector now, accepted;
  };

  std::string scene_name;         ///< for messages
  std::string scene_fingerprint;  ///< see fingerprint()
  std::string program_version;    ///< of the program that wrote it
  std::vector<NoteRecord> notes;  ///< of all steps so far
  Mesh mesh;
  std::map<std::string, Values> fields;  ///< by full name
  /// The state of accelerators, of the time steps, of tips, by names that they choose.
  std::map<std::string, Vector> extra;
};

/// 16 hexadecimal digits that change with the text (FNV-1a, 64 bits). The caller leaves out of the text what may
/// differ when a run is continued: the end time and the output.
std::string fingerprint(const std::string& text);

/// Replaces `path` by the checkpoint once it is complete: a crash while writing leaves the old one.
/// Throws std::runtime_error naming the file and the reason.
void write_checkpoint(const std::filesystem::path& path, const Checkpoint& checkpoint);

/// Returns to the bit what was written. Throws InputError, saying what is wrong and what to do, for a file that is
/// missing, cut short, damaged, not a checkpoint, or of another format version.
Checkpoint read_checkpoint(const std::filesystem::path& path);

/// Throws InputError if the checkpoint read from `path` belongs to another scene.
void require_scene(const Checkpoint& checkpoint, const std::filesystem::path& path, const std::string& scene_name,
                   const std::string& scene_fingerprint, const std::string& difference = "");

/// The values of all fields of a store, for Checkpoint::fields.
std::map<std::string, Checkpoint::Values> field_values(const FieldStore& store);

/// Puts the values back. Throws InputError, naming the field, if the store and the checkpoint do not have the same
/// fields with the same sizes; the store is then unchanged.
void restore_fields(const Checkpoint& checkpoint, const std::filesystem::path& path, FieldStore& store);

}  // namespace sprekk
