#include "framework/output/run_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>

#include "framework/config/input_error.hpp"
#include "framework/output/plain_file.hpp"

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

}  // namespace

RunLock::RunLock(const std::filesystem::path& folder) : file_(folder / file_name) {
  constexpr int most_attempts = 1000;  // a run that ends between open and flock removes the file
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
    if (has_name(descriptor_, file_)) break;  // its former holder may have removed it meanwhile
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
