#include "framework/output/run_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>

#include "framework/config/input_error.hpp"

namespace sprekk {
namespace {

/// "process 12 on host rock", as the holder has written it.
std::string holder(int descriptor) {
  char text[256];
  const ssize_t size = ::pread(descriptor, text, sizeof text, 0);
  std::string name(text, size > 0 ? static_cast<std::size_t>(size) : 0);
  name = name.substr(0, name.find('\n'));
  return name.empty() ? "another process" : name;
}

std::string own_name() {
  char host[200] = "";
  ::gethostname(host, sizeof host - 1);
  return "process " + std::to_string(::getpid()) + " on " + host + "\n";
}

/// Whether the open file still has its name: the former holder of the lock may have removed it meanwhile.
bool is_still_there(int descriptor, const std::filesystem::path& file) {
  struct stat open_one {
  }, named{};
  return ::fstat(descriptor, &open_one) == 0 && ::stat(file.c_str(), &named) == 0 && open_one.st_ino == named.st_ino &&
         open_one.st_dev == named.st_dev;
}

}  // namespace

RunLock::RunLock(const std::filesystem::path& folder) : file_(folder / file_name) {
  constexpr int most_attempts = 1000;
  for (int attempt = 0; attempt < most_attempts; ++attempt) {
    descriptor_ = ::open(file_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666);
    if (descriptor_ < 0)
      throw InputError("the output folder " + folder.string() + " cannot be written to (" + std::strerror(errno) +
                       ") choose another one with -o");
    if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
      const std::string name = holder(descriptor_);
      ::close(descriptor_);
      descriptor_ = -1;
      throw InputError("another run is at work in " + folder.string() + " (" + name +
                       ") wait for it or end it, or choose another folder with -o");
    }
    if (is_still_there(descriptor_, file_)) break;
    ::close(descriptor_);
    descriptor_ = -1;
  }
  if (descriptor_ < 0) throw InputError("the output folder " + folder.string() + " cannot be locked, try again");
  // On a full disk the lock holds all the same, without a name.
  const std::string name = own_name();
  if (::ftruncate(descriptor_, 0) == 0 && ::pwrite(descriptor_, name.data(), name.size(), 0) < 0) errno = 0;
}

RunLock::~RunLock() {
  ::unlink(file_.c_str());
  ::close(descriptor_);
}

}  // namespace sprekk
