#include "framework/assembly/notes.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "framework/output/progress.hpp"

namespace sprekk {

void Notes::add(const std::string& topic, const std::string& text, double measure) {
  const auto same = std::find_if(notes_.begin(), notes_.end(), [&](const Note& note) { return note.topic == topic; });
  if (same == notes_.end()) {
    notes_.push_back({topic, text, time_, time_, is_of_input_ ? 0 : 1, measure});
    return;
  }
  if (measure > same->measure) {
    same->text = text;
    same->measure = measure;
  }
  if (is_of_input_ || same->last_time == time_) return;  // several places of one step
  same->last_time = time_;
  ++same->steps;
}

std::string described(const Notes::Note& note) {
  if (note.steps == 0) return note.text;
  if (note.steps == 1) return fmt::format("{} [at {}]", note.text, duration_text(note.first_time));
  return fmt::format("{} [{} steps, from {} to {}]", note.text, note.steps, duration_text(note.first_time),
                     duration_text(note.last_time));
}

}  // namespace sprekk
