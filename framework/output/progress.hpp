// Shows the progress of a run on the terminal.
#pragma once

#include <functional>
#include <iosfwd>
#include <mutex>
#include <string>
#include <thread>

namespace sprekk {

/// "42 s", "3 min 20 s", "2 h 5 min", "4 d 3 h", "4.2e+03 years"; a scene's times and waiting times alike.
std::string duration_text(double seconds);

/// Shows where a run is, as a bar or as lines, and tells of long phases.
class Progress {
 public:
  /// How the progress is shown.
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

  /// Starts a thread that calls tick(), so that the display changes also during a call that takes minutes. Does nothing
  /// when silent.
  void watch();
  /// Ends the display, with the cursor on a new line.
  void close();

  /// Step number `step` has reached the simulated `time`. The bar is redrawn at most ten times a second.
  void reached(double time, int step);
  /// Shows an event in a line of its own: a step that was cut, a fracture that grew, a warning.
  void event(const std::string& text);
  /// The run ends before its end, and why.
  void stopped(double time, int step, const std::string& why);

  /// Tells the phase that begins: "building the model", "step 12 from 3 h over 1 h". Shown only if it takes long.
  void phase(const std::string& what);
  /// Tells the part of the phase that begins, "discretizing rock"; or with `passing`, how far the phase is: "iteration
  /// 7, residual 1e-3". With lines, a part that has taken 10 s is shown with its time, unless it is passing.
  void part(const std::string& what, bool passing = false);
  /// To be called about twice a second. A bar is redrawn with the current phase and its time. With lines, a line is
  /// added when a phase has taken 10 s, and then after each minute without a line.
  void tick();

 private:
  std::string status(double time, int step) const;
  std::string activity() const;  ///< the current phase with its time, or ""
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
