#include "framework/output/atomic_file.hpp"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <stdexcept>

namespace sprekk {
namespace fs = std::filesystem;

fs::path partial_name(const fs::path& file) {
  fs::path partial = file;
  partial += ".partial";
  return partial;
}

void finish_partial(const fs::path& file) {
  std::error_code error;
  fs::rename(partial_name(file), file, error);
  if (error) throw std::runtime_error("cannot write " + file.string() + " (" + error.message() + ")");
}

void write_atomically(const fs::path& file, std::string_view text) {
  errno = 0;
  std::ofstream stream(partial_name(file), std::ios::binary | std::ios::trunc);
  stream.write(text.data(), static_cast<std::streamsize>(text.size()));
  stream.close();
  if (!stream) {
    const std::string reason = errno != 0 ? std::strerror(errno) : "the write failed";
    std::error_code ignored;
    fs::remove(partial_name(file), ignored);
    throw std::runtime_error("cannot write " + file.string() + " (" + reason + ") make room for it; what it held " +
                             "before is still there");
  }
  finish_partial(file);
}

}  // namespace sprekk
