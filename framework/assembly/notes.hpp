// What a run did, or will do, that its user would not expect.
#pragma once

#include <string>
#include <vector>

namespace sprekk {

/// A note is part of the answer: it is shown on the terminal, in run.json and in the report. It never ends a run.
/// The text is one sentence: what, where and how much (why) what to do.
class Notes {
 public:
  struct Note {
    std::string topic;      ///< one name for all notes of a kind: "pore.pressure below zero"
    std::string text;       ///< of the first step that it was added in
    double first_time = 0;  ///< end of that step (s)
    double last_time = 0;   ///< end of the last step that it was added in (s)
    long steps = 0;         ///< number of accepted steps that it was added in
  };

  /// The end (s) of the accepted step that what follows is about.
  void at_time(double time) { time_ = time; }
  /// Adds a note, or counts one more step for a note of the same topic.
  void add(const std::string& topic, const std::string& text);

  const std::vector<Note>& all() const { return notes_; }
  void restore(std::vector<Note> notes) { notes_ = std::move(notes); }

 private:
  double time_ = 0;
  std::vector<Note> notes_;
};

}  // namespace sprekk
