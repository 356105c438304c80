#include "framework/output/note_record.hpp"

#include <fmt/format.h>

#include "framework/output/progress.hpp"

namespace sprekk {

std::string described(const NoteRecord& note) {
  if (note.steps == 0) return note.text;
  if (note.steps == 1) return fmt::format("{} [at {}]", note.text, duration_text(note.first_time));
  return fmt::format("{} [{} steps, from {} to {}]", note.text, note.steps, duration_text(note.first_time),
                     duration_text(note.last_time));
}

}  // namespace sprekk
