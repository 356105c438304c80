// How a run tells the person in front of it where it is.
#pragma once

#include <functional>
#include <iosfwd>
#include <string>

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
  ~Progress();  ///< leaves the cursor on a new line
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Step number `step` has reached the simulated `time`. The bar is redrawn at most ten times a second.
  void reached(double time, int step);
  /// Something worth a line: a step that was cut, a fracture that grew, a warning.
  void event(const std::string& text);

 private:
  std::string status(double time, int step) const;
  void clear_bar();

  Style style_;
  std::ostream& out_;
  double start_, end_;
  Clock clock_;
  double began_, last_drawn_;
  bool is_bar_shown_ = false;
};

}  // namespace sprekk
