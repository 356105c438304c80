// How a run tells the person in front of it where it is.
#pragma once

#include <functional>
#include <iosfwd>
#include <mutex>
#include <string>
#include <thread>

namespace sprekk {

/// "42 s", "3 min 20 s", "2 h 5 min", "4 d 3 h", "4.2e+03 years"; a scene's times and waiting times alike.
std::string duration_text(double seconds);

class Progress {
 public:
  enum class Style {
    silent,
    lines,  ///< one line an event: for log files
    bar     ///< a bar in the terminal's last line, rewritten in place
  };
  /// The style for a stream with this file descriptor: silent on other processes than the first and when quiet, a bar
  /// on a terminal.
  static Style style_for(int file_descriptor, bool is_root, bool is_quiet);

  /// Seconds on a clock that never runs back; tests give their own.
  using Clock = std::function<double()>;
  static double steady_seconds();

  /// `start` and `end`: the simulated time (s) of the run. `out` must outlive this object.
  Progress(Style style, std::ostream& out, double start, double end, Clock clock = steady_seconds);
  ~Progress();  ///< as close()
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Looks after the time from now on, with a thread of its own that calls tick(): so that a single call that takes
  /// minutes does not take them without a word. Does nothing when silent.
  void watch();
  /// Nothing follows: the cursor is left on a new line.
  void close();

  /// Step number `step` has reached the simulated `time`. The bar is redrawn at most ten times a second.
  void reached(double time, int step);
  /// Something worth a line: a step that was cut, a fracture that grew, a warning.
  void event(const std::string& text);
  /// The run ends before its end, and why.
  void stopped(double time, int step, const std::string& why);

  /// What begins now: "building the model", "step 12 from 3 h over 1 h". Shown only if it takes long.
  void phase(const std::string& what);
  /// What of it, "discretizing rock"; or with `passing`, how far it is: "iteration 7, residual 1e-3". In lines, parts
  /// that have taken 10 s are told with their time, unless they are passing.
  void part(const std::string& what, bool passing = false);
  /// To be called about twice a second: draws the bar again with what goes on since when; among lines, adds one when a
  /// phase has taken 10 s, and then each time that a minute has passed without one.
  void tick();

 private:
  std::string status(double time, int step) const;
  std::string activity() const;  ///< what goes on since when, or nothing
  void clear_bar();
  void draw_bar();
  void line(const std::string& text);
  void end_part();

  Style style_;
  std::ostream& out_;
  double start_, end_;
  Clock clock_;
  double began_, last_drawn_, last_line_;
  bool is_bar_shown_ = false;
  std::string status_;  ///< of the last step
  std::string phase_, part_;
  bool passing_ = false, is_phase_told_ = false;
  double phase_began_ = 0, part_began_ = 0;
  std::mutex one_at_a_time_;
  std::jthread watcher_;
};

}  // namespace sprekk
