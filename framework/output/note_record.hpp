// A note as it is stored in files and shown.
#pragma once

#include <string>

namespace sprekk {

/// A note of a run (see Notes).
struct NoteRecord {
  std::string topic, text;
  double first_time = 0, last_time = 0;  ///< s, ends of the first and the last step
  long steps = 0;                        ///< how many; 0 for a note about the input
  double measure = 0;                    ///< how bad it was
};

/// The text of a note; for a note on steps also how many steps, and when.
std::string described(const NoteRecord& note);

}  // namespace sprekk
