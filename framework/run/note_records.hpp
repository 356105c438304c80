// Notes of parts as records for files and for the terminal.
#pragma once

#include <vector>

#include "framework/assembly/notes.hpp"
#include "framework/output/note_record.hpp"

namespace sprekk {

/// All notes, in their order.
inline std::vector<NoteRecord> records_of(const Notes& notes) {
  std::vector<NoteRecord> records;
  for (const Notes::Note& note : notes.all())
    records.push_back({note.topic, note.text, note.first_time, note.last_time, note.steps, note.measure});
  return records;
}

/// The inverse, for a run that goes on from a checkpoint.
inline std::vector<Notes::Note> notes_of(const std::vector<NoteRecord>& records) {
  std::vector<Notes::Note> notes;
  for (const NoteRecord& record : records)
    notes.push_back({record.topic, record.text, record.first_time, record.last_time, record.steps, record.measure});
  return notes;
}

}  // namespace sprekk
