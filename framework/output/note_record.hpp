// A note as it is kept in files and shown.
#pragma once

#include <string>

namespace sprekk {

/// What a run did that its user would not expect (Notes).
struct NoteRecord {
  std::string topic, text;
  double first_time = 0, last_time = 0;  ///< s, ends of the first and the last step
  long steps = 0;                        ///< how many; 0 for a note about the input
  double measure = 0;                    ///< how bad it was
};

/// The text, and of a note about steps how many these were and when.
std::string described(const NoteRecord& note);

}  // namespace sprekk
