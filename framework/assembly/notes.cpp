#include "framework/assembly/notes.hpp"

#include <algorithm>
#include <utility>

namespace sprekk {

void Notes::restore(std::vector<Note> notes) { notes_ = std::move(notes); }

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
  if (is_of_input_ || same->last_time == time_) return;  // one step counts once, however many notes it has
  same->last_time = time_;
  ++same->steps;
}

}  // namespace sprekk
