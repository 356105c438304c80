#include "framework/output/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <ostream>

namespace sprekk {
namespace {

constexpr double redraw_interval = 0.1;  // s
constexpr int bar_width = 30;
const std::string clear_line = "\r\x1b[K";

}  // namespace

std::string duration_text(double seconds) {
  if (!std::isfinite(seconds)) return "?";
  if (seconds < 59.95) return fmt::format("{:.3g} s", seconds);  // from there on three digits say 60
  constexpr double year = 365.25 * 86400;
  if (seconds > 10 * year) return fmt::format("{:.3g} years", seconds / year);
  const auto whole = std::llround(seconds);
  if (whole < 3600) return fmt::format("{} min {} s", whole / 60, whole % 60);
  const auto minutes = std::llround(seconds / 60);
  if (minutes < 24 * 60) return fmt::format("{} h {} min", minutes / 60, minutes % 60);
  const auto hours = std::llround(seconds / 3600);
  return fmt::format("{} d {} h", hours / 24, hours % 24);
}

Progress::Style Progress::style_for(int file_descriptor, bool is_root, bool is_quiet) {
  if (is_quiet || !is_root) return Style::silent;
  return ::isatty(file_descriptor) ? Style::bar : Style::lines;
}

double Progress::steady_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

Progress::Progress(Style style, std::ostream& out, double start, double end, Clock clock)
    : style_(style),
      out_(out),
      start_(start),
      end_(end),
      clock_(std::move(clock)),
      began_(clock_()),
      last_drawn_(-std::numeric_limits<double>::infinity()) {}

Progress::~Progress() {
  if (is_bar_shown_) out_ << '\n' << std::flush;
}

std::string Progress::status(double time, int step) const {
  const double fraction = end_ > start_ ? std::clamp((time - start_) / (end_ - start_), 0.0, 1.0) : 1.0;
  const double elapsed = clock_() - began_;
  // What remains is taken to go as fast as what is done.
  const std::string left = fraction > 0 ? duration_text(elapsed * (1 - fraction) / fraction) + " left" : "";
  const std::string numbers =
      fmt::format("{:3.0f} %  step {}  t = {}  {}", std::floor(100 * fraction), step, duration_text(time), left);
  if (style_ == Style::lines) return numbers;
  const int filled = static_cast<int>(bar_width * fraction);
  return fmt::format("[{:#<{}}{:.<{}}] {}", "", filled, "", bar_width - filled, numbers);
}

void Progress::clear_bar() {
  if (is_bar_shown_) out_ << clear_line;
  is_bar_shown_ = false;
}

void Progress::reached(double time, int step) {
  if (style_ == Style::silent) return;
  if (style_ == Style::lines) {
    out_ << status(time, step) << std::endl;
    return;
  }
  const double now = clock_();
  if (now - last_drawn_ < redraw_interval && time < end_) return;
  last_drawn_ = now;
  clear_bar();
  out_ << status(time, step) << std::flush;
  is_bar_shown_ = true;
}

void Progress::event(const std::string& text) {
  if (style_ == Style::silent) return;
  clear_bar();  // the next step draws it again, below the line
  last_drawn_ = -std::numeric_limits<double>::infinity();
  out_ << text << std::endl;
}

}  // namespace sprekk
