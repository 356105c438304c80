// Only one run at a time writes into a folder.
#pragma once

#include <filesystem>

namespace sprekk {

/// A lock on a folder of results, by its file `.lock`, which names the holder. The lock ends with the process that
/// holds it, however that process ends, so that the folder of a dead run is free. File systems without locks are not
/// locked.
class RunLock {
 public:
  static inline const char* const file_name = ".lock";

  /// Throws InputError, naming the host and the process, when another one holds the lock, or when the folder cannot be
  /// written to.
  explicit RunLock(const std::filesystem::path& folder);
  ~RunLock();  ///< removes the file
  RunLock(const RunLock&) = delete;
  RunLock& operator=(const RunLock&) = delete;

 private:
  std::filesystem::path file_;
  int descriptor_ = -1;
};

}  // namespace sprekk
