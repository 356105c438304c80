// What the program is doing just now, for whoever waits in front of it.
#pragma once

#include <functional>
#include <string>
#include <utility>

namespace sprekk {

/// Who wants to know; nobody as a rule.
inline std::function<void(const std::string&)>& activity_listener() {
  static std::function<void(const std::string&)> listener;
  return listener;
}

/// To be called by what may take long: "discretizing rock". Costs nothing worth mentioning when nobody listens.
inline void now_doing(const std::string& what) {
  if (activity_listener()) activity_listener()(what);
}

/// Listens as long as it lives.
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
