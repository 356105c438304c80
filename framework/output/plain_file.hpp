// Files of results that are written where they are, never where a symbolic link leads.
#pragma once

#include <filesystem>
#include <string_view>

namespace sprekk {

/// A regular file that is open for writing. A symbolic link of its name is not followed: a link in a folder of results
/// must not make a run write outside of the folder.
class PlainFile {
 public:
  /// anew: whatever has the name is removed, a link as well. append: what is there is kept.
  enum class Mode { anew, append };
  /// Throws std::runtime_error with the reason alone (a link, no room, no permission).
  PlainFile(const std::filesystem::path& file, Mode mode);
  ~PlainFile();
  PlainFile(PlainFile&& other) noexcept;
  PlainFile& operator=(PlainFile&& other) noexcept;

  void write(std::string_view text);  ///< throws std::runtime_error with the reason
  void close();                       ///< the same, for what has not reached the disk
  /// Whether `file` is still the name of the open file: it may have been removed or replaced.
  bool has_name(const std::filesystem::path& file) const;

 private:
  int descriptor_ = -1;
};

/// Whether an open file still has this name.
bool has_name(int descriptor, const std::filesystem::path& file);

}  // namespace sprekk
