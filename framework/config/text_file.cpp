#include "framework/config/text_file.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "framework/config/input_error.hpp"

namespace sprekk {
namespace {

/// The length of the UTF-8 character at `position`, or 0 when there is none.
std::size_t character_length(const std::string& text, std::size_t position) {
  const auto first = static_cast<unsigned char>(text[position]);
  const std::size_t length = first < 0x80   ? 1
                             : first < 0xC2 ? 0
                             : first < 0xE0 ? 2
                             : first < 0xF0 ? 3
                             : first < 0xF5 ? 4
                                            : 0;
  if (length == 0 || position + length > text.size()) return 0;
  for (std::size_t i = 1; i < length; ++i) {
    if ((static_cast<unsigned char>(text[position + i]) & 0xC0U) != 0x80U) return 0;
  }
  return length;
}

InputError too_large(const std::string& name) {
  return InputError({name}, "the file is too large", "at most 64 MiB are read");
}

}  // namespace

std::string read_text_file(const std::string& path, const std::string& name) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) {
    throw InputError({name}, "cannot be read", "it is a folder", "give a file");
  }
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  if (!file) throw InputError({name}, "cannot be read", std::strerror(errno == 0 ? EIO : errno));
  std::string content;
  std::array<char, 1U << 16U> block;
  while (file.read(block.data(), block.size()) || file.gcount() > 0) {
    content.append(block.data(), static_cast<std::size_t>(file.gcount()));
    if (content.size() > largest_text_file) throw too_large(name);
  }
  if (file.bad()) throw InputError({name}, "cannot be read", std::strerror(errno == 0 ? EIO : errno));
  require_text(content, name);
  return content;
}

void require_text(const std::string& content, const std::string& name) {
  if (content.size() > largest_text_file) throw too_large(name);
  int line = 1;
  for (std::size_t i = 0; i < content.size();) {
    const auto byte = static_cast<unsigned char>(content[i]);
    if (byte == '\n') ++line;
    const bool is_control = (byte < 0x20 && byte != '\n' && byte != '\r' && byte != '\t') || byte == 0x7F;
    const std::size_t length = is_control ? 0 : character_length(content, i);
    if (length == 0) {
      throw InputError({name, line}, "not a text file",
                       is_control ? "it has a control byte here" : "it has a byte here that is not UTF-8",
                       "save it as UTF-8 text");
    }
    i += length;
  }
}

}  // namespace sprekk
