#include "framework/assembly/notes.hpp"

#include <algorithm>

namespace sprekk {

void Notes::add(const std::string& topic, const std::string& text) {
  const auto same = std::find_if(notes_.begin(), notes_.end(), [&](const Note& note) { return note.topic == topic; });
  if (same == notes_.end()) {
    notes_.push_back({topic, text, time_, time_, 1});
    return;
  }
  if (same->last_time == time_) return;  // several places of one step
  same->last_time = time_;
  ++same->steps;
}

}  // namespace sprekk
