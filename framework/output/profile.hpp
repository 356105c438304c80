// Where the time of a run went, and how often work was skipped because it was not needed.
//
// Counting and timing are in this header alone, so that any part of the program may use them.
#pragma once

#include <chrono>
#include <deque>
#include <string>
#include <string_view>
#include <vector>

#include "framework/output/profile_entry.hpp"

namespace sprekk {

/// Counts and times of named pieces of work.
class Profile {
 public:
  using Entry = ProfileEntry;

  /// The entry of that name, made on first use; the reference stays valid.
  Entry& at(std::string_view name) {
    for (Entry& entry : entries_)
      if (entry.name == name) return entry;
    return entries_.emplace_back(Entry{std::string(name)});
  }
  void reused(std::string_view name) { ++at(name).reuses; }
  void skipped(std::string_view name) { ++at(name).skips; }

  const std::deque<Entry>& entries() const { return entries_; }  ///< in the order of first use
  double solver_seconds() const {
    double seconds = 0;
    for (const Entry& entry : entries_) seconds += entry.is_solver ? entry.seconds : 0;
    return seconds;
  }

  /// The end-of-run table: entries by falling seconds, a line for the time without entry, the total; then
  /// factorizations and back-solves against everything else. Shares of `total_seconds` in %.
  std::string table(double total_seconds) const;

 private:
  friend class ScopedTimer;
  std::deque<Entry> entries_;
  std::vector<double> inner_seconds_;  ///< for each running timer: the time spent in timers inside of it
};

/// Counts one call and times it until the end of the scope. Timers nest.
class ScopedTimer {
 public:
  ScopedTimer(Profile& profile, std::string_view name)
      : profile_(profile), entry_(profile.at(name)), start_(std::chrono::steady_clock::now()) {
    ++entry_.calls;
    profile_.inner_seconds_.push_back(0);
  }
  ~ScopedTimer() {
    const double elapsed = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    entry_.seconds += elapsed - profile_.inner_seconds_.back();
    profile_.inner_seconds_.pop_back();
    if (!profile_.inner_seconds_.empty()) profile_.inner_seconds_.back() += elapsed;
  }
  ScopedTimer(const ScopedTimer&) = delete;
  ScopedTimer& operator=(const ScopedTimer&) = delete;

 private:
  Profile& profile_;
  Profile::Entry& entry_;
  std::chrono::steady_clock::time_point start_;
};

}  // namespace sprekk
