#include "framework/output/atomic_file.hpp"

#include <stdexcept>

#include "framework/output/plain_file.hpp"

namespace sprekk {
namespace fs = std::filesystem;

namespace {
const char* const ending = ".partial";
}

fs::path partial_name(const fs::path& file) {
  fs::path partial = file;
  partial += ending;
  return partial;
}

bool is_partial(const fs::path& file) { return file.extension() == ending; }

void finish_partial(const fs::path& file) {
  std::error_code error;
  fs::rename(partial_name(file), file, error);
  if (error) throw std::runtime_error("cannot write " + file.string() + " (" + error.message() + ")");
}

void write_atomically(const fs::path& file, std::string_view text) {
  try {
    PlainFile partial(partial_name(file), PlainFile::Mode::anew);
    partial.write(text);
    partial.close();
  } catch (const std::runtime_error& error) {
    std::error_code ignored;
    fs::remove(partial_name(file), ignored);
    throw std::runtime_error("cannot write " + file.string() + " (" + error.what() + ") make room for it; what it " +
                             "held before is still there");
  }
  finish_partial(file);
}

}  // namespace sprekk
