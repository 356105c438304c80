#include "framework/output/progress.hpp"

#include <fmt/format.h>
#include <pthread.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <csignal>
#include <limits>
#include <ostream>
#include <system_error>

namespace sprekk {
namespace {

constexpr double redraw_interval = 0.1;  // s
constexpr double short_wait = 0.5;       // s; shorter activities are not shown
constexpr double long_part = 10;         // s; longer activities get a line of their own
constexpr double long_silence = 60;      // s
constexpr int bar_width = 30;
const std::string clear_line = "\r\x1b[K";

/// The width of the terminal; 0 without a terminal.
std::size_t columns() {
  winsize size{};
  return ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 ? size.ws_col : 0;
}

/// Blocks signals in this thread, so that the main thread receives them.
void block_signals() {
  sigset_t all;
  sigfillset(&all);
  pthread_sigmask(SIG_BLOCK, &all, nullptr);
}

}  // namespace

std::string duration_text(double seconds) {
  if (!std::isfinite(seconds)) return "?";
  constexpr double a_minute = 59.95;  // above, three digits would give 60
  if (seconds < a_minute) return fmt::format("{:.3g} s", seconds);
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
      last_drawn_(-std::numeric_limits<double>::infinity()),
      last_line_(began_) {}

Progress::~Progress() { close(); }

void Progress::watch() {
  if (style_ == Style::silent || watcher_.joinable()) return;
  const auto look_after = [this](const std::stop_token& stop) {
    block_signals();
    std::mutex mutex;
    std::condition_variable_any never;
    std::unique_lock lock(mutex);
    while (!never.wait_for(lock, stop, std::chrono::milliseconds(500), [&] { return stop.stop_requested(); })) tick();
  };
  try {
    watcher_ = std::jthread(look_after);
  } catch (const std::system_error&) {
    // Where no thread can be started (a limit of memory or of processes), the run goes on without one.
  }
}

void Progress::close() {
  if (watcher_.joinable()) {
    watcher_.request_stop();
    watcher_.join();
  }
  if (is_bar_shown_) out_ << '\n' << std::flush;
  is_bar_shown_ = false;
}

std::string Progress::status(double time, int step) const {
  const double fraction = end_ > start_ ? std::clamp((time - start_) / (end_ - start_), 0.0, 1.0) : 1.0;
  const double elapsed = clock_() - began_;
  // The estimate assumes that the rest of the run is as fast as the run so far.
  const std::string left = fraction > 0 ? duration_text(elapsed * (1 - fraction) / fraction) + " left" : "";
  const std::string numbers =
      fmt::format("{:3.0f} %  step {}  t = {}  {}", std::floor(100 * fraction), step, duration_text(time), left);
  if (style_ == Style::lines) return numbers;
  const int filled = static_cast<int>(bar_width * fraction);
  return fmt::format("[{:#<{}}{:.<{}}] {}", "", filled, "", bar_width - filled, numbers);
}

std::string Progress::activity() const {
  if (phase_.empty()) return "";
  return phase_ + (part_.empty() ? "" : ": " + part_) + ", " + duration_text(std::floor(clock_() - phase_began_));
}

void Progress::clear_bar() {
  if (is_bar_shown_) out_ << clear_line;
  is_bar_shown_ = false;
}

/// Cuts a text to the width of the line: the rest would stay on the terminal when the line is drawn again.
void Progress::draw_bar() {
  clear_bar();
  std::string text = status_;
  const double now = clock_();
  if (!phase_.empty() && now - phase_began_ >= short_wait) {
    text += (text.empty() ? "" : "  ") + activity();
    if (const std::size_t width = columns(); width > 0 && text.size() >= width)
      text.resize(std::max(width - 1, std::min(status_.size(), text.size())));
  }
  if (text.empty()) return;
  out_ << text << std::flush;
  last_drawn_ = now;
  is_bar_shown_ = true;
}

void Progress::line(const std::string& text) {
  clear_bar();  // what follows draws it again, below the line
  last_drawn_ = -std::numeric_limits<double>::infinity();
  last_line_ = clock_();
  out_ << text << std::endl;
}

void Progress::reached(double time, int step) {
  if (style_ == Style::silent) return;
  const std::lock_guard lock(one_at_a_time_);
  phase_.clear();
  part_.clear();
  status_ = status(time, step);
  if (style_ == Style::lines) return line(status_);
  if (clock_() - last_drawn_ >= redraw_interval || time >= end_) draw_bar();
}

void Progress::event(const std::string& text) {
  if (style_ == Style::silent) return;
  const std::lock_guard lock(one_at_a_time_);
  line(text);
}

void Progress::stopped(double time, int step, const std::string& why) {
  if (style_ == Style::silent) return;
  const std::lock_guard lock(one_at_a_time_);
  phase_.clear();
  line(fmt::format("ended after step {} at t = {}: {}", step, duration_text(time), why));
}

void Progress::end_part() {
  const double took = clock_() - part_began_;
  if (style_ == Style::lines && !part_.empty() && !passing_ && took >= long_part)
    line(phase_ + ": " + part_ + " took " + duration_text(std::round(took)));
  part_.clear();
}

void Progress::phase(const std::string& what) {
  if (style_ == Style::silent) return;
  const std::lock_guard lock(one_at_a_time_);
  end_part();
  phase_ = what;
  phase_began_ = clock_();
  is_phase_told_ = false;
}

void Progress::part(const std::string& what, bool passing) {
  if (style_ == Style::silent) return;
  const std::lock_guard lock(one_at_a_time_);
  end_part();
  part_ = what;
  passing_ = passing;
  part_began_ = clock_();
}

void Progress::tick() {
  if (style_ == Style::silent) return;
  const std::lock_guard lock(one_at_a_time_);
  if (phase_.empty()) return;
  if (style_ == Style::bar) return draw_bar();
  const double now = clock_();
  const bool is_long = !is_phase_told_ && now - phase_began_ >= long_part && now - last_line_ >= long_part;
  if (!is_long && now - last_line_ < long_silence) return;
  is_phase_told_ = true;
  line("… " + activity());
}

}  // namespace sprekk
