#include "framework/output/plain_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <utility>

namespace sprekk {
namespace {

[[noreturn]] void fail(int error) {
  throw std::runtime_error(error == ELOOP ? "it is a symbolic link, which may lead out of the folder"
                                          : std::strerror(error));
}

}  // namespace

PlainFile::PlainFile(const std::filesystem::path& file, Mode mode) {
  if (mode == Mode::anew && ::unlink(file.c_str()) != 0 && errno != ENOENT) fail(errno);
  const int flags = O_WRONLY | O_CREAT | O_CLOEXEC | O_NOFOLLOW | (mode == Mode::anew ? O_EXCL : O_APPEND);
  constexpr mode_t readable = 0666;  // less the umask
  descriptor_ = ::open(file.c_str(), flags, readable);
  if (descriptor_ < 0) fail(errno);
}

PlainFile::~PlainFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

PlainFile::PlainFile(PlainFile&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}

PlainFile& PlainFile::operator=(PlainFile&& other) noexcept {
  std::swap(descriptor_, other.descriptor_);
  return *this;
}

void PlainFile::write(std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = ::write(descriptor_, text.data(), text.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail(errno);
    text.remove_prefix(static_cast<std::size_t>(written));
  }
}

void PlainFile::close() {
  if (::close(std::exchange(descriptor_, -1)) != 0 && errno != EINTR) fail(errno);
}

bool PlainFile::has_name(const std::filesystem::path& file) const { return sprekk::has_name(descriptor_, file); }

bool has_name(int descriptor, const std::filesystem::path& file) {
  struct stat open_one {
  }, named{};
  return ::fstat(descriptor, &open_one) == 0 && ::lstat(file.c_str(), &named) == 0 && open_one.st_ino == named.st_ino &&
         open_one.st_dev == named.st_dev;
}

}  // namespace sprekk
