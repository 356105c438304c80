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
    std::string text;       ///< of the step with the largest measure, the first of several
    double first_time = 0;  ///< end of that step (s)
    double last_time = 0;   ///< end of the last step that it was added in (s)
    long steps = 0;         ///< number of accepted steps that it was added in; 0: of the input
    double measure = 0;     ///< how bad it was, in units of its topic
  };

  /// The end (s) of the accepted step that what follows is about.
  void at_time(double time) { time_ = time; }
  /// What follows is about the input, at the start (s) of the run, not about steps.
  void of_input(double start) {
    time_ = start;
    is_of_input_ = true;
  }
  /// Adds a note, or counts one more step for a note of the same topic, whose text is then that of the larger measure:
  /// give one where a text has figures, so that the worst is told and not the first. Only what the first process adds
  /// is shown: what a process knows alone is to be reduced before.
  void add(const std::string& topic, const std::string& text, double measure = 0);

  const std::vector<Note>& all() const { return notes_; }
  bool empty() const { return notes_.empty(); }
  void restore(std::vector<Note> notes) { notes_ = std::move(notes); }

 private:
  double time_ = 0;
  bool is_of_input_ = false;
  std::vector<Note> notes_;
};

}  // namespace sprekk
