// Reads text files as input: of bounded size, and UTF-8 only.
#pragma once

#include <string>

namespace sprekk {

inline constexpr std::size_t largest_text_file = std::size_t{64} << 20U;  ///< bytes: no scene or table is larger

/// The contents of the UTF-8 file at `path`, called `name` in messages. Throws InputError for a file that cannot be
/// read, is larger than `largest_text_file`, or is binary.
std::string read_text_file(const std::string& path, const std::string& name);

/// Throws InputError, with the line, for control bytes or bytes that are not UTF-8.
void require_text(const std::string& content, const std::string& name);

}  // namespace sprekk
