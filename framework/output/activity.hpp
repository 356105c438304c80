// The current activity of the program, shown to its user.
#pragma once

#include <functional>
#include <string>
#include <utility>

namespace sprekk {

/// The function that receives the activity; usually empty.
inline std::function<void(const std::string&)>& activity_listener() {
  static std::function<void(const std::string&)> listener;
  return listener;
}

/// Tells the listener what begins now ("discretizing rock"). To be called by code that may take long; without a
/// listener it takes almost no time.
inline void now_doing(const std::string& what) {
  if (activity_listener()) activity_listener()(what);
}

/// A guard: `listen` receives activities as long as this object exists; afterwards the former listener does again.
class ActivityListener {
 public:
  explicit ActivityListener(std::function<void(const std::string&)> listen)
      : before_(std::exchange(activity_listener(), std::move(listen))) {}
  ~ActivityListener() { activity_listener() = std::move(before_); }
  ActivityListener(const ActivityListener&) = delete;
  ActivityListener& operator=(const ActivityListener&) = delete;

 private:
  std::function<void(const std::string&)> before_;
};

}  // namespace sprekk
