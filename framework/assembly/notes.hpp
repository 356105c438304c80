// Notes: what a run did, or will do, that its user would not expect.
#pragma once

#include <string>
#include <vector>

namespace sprekk {

/// Collects the notes of a run. A note is part of the answer: it is shown on the terminal, in run.json and in the
/// report. A note never ends a run. Its text is one sentence: what, where and how much (why) what to do.
class Notes {
 public:
  /// What is kept of all notes on one topic.
  struct Note {
    std::string topic;      ///< one name for all notes of a kind: "pore.pressure below zero"
    std::string text;       ///< of the step with the largest measure, the first of several
    double first_time = 0;  ///< end of the first step that added the note (s)
    double last_time = 0;   ///< end of the last step that added the note (s)
    long steps = 0;         ///< number of accepted steps that added the note; 0: a note on the input
    double measure = 0;     ///< the largest severity so far, in units of the topic
  };

  /// Notes added from now on are about the accepted step that ends at `time` (s).
  void at_time(double time) { time_ = time; }
  /// Notes added from now on are about the input, at the start (s) of the run, and not about a step.
  void of_input(double start) {
    time_ = start;
    is_of_input_ = true;
  }
  /// Adds a note, or counts one more step for the note on the same topic, which then keeps the text with the larger
  /// measure. A text with figures needs a measure: the note then has the worst figures and not the first. Only the
  /// notes of the first process are shown, so figures of single processes are to be reduced before.
  void add(const std::string& topic, const std::string& text, double measure = 0);

  const std::vector<Note>& all() const { return notes_; }
  bool empty() const { return notes_.empty(); }
  void restore(std::vector<Note> notes);

 private:
  double time_ = 0;
  bool is_of_input_ = false;
  std::vector<Note> notes_;
};

}  // namespace sprekk
