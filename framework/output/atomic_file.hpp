// Files that are complete at any moment: each is written under another name and then renamed.
#pragma once

#include <filesystem>
#include <string_view>

namespace sprekk {

/// The name under which a file is written before it replaces `file`: the same folder, ".partial" behind the name.
std::filesystem::path partial_name(const std::filesystem::path& file);

/// Whether a file has such a name.
bool is_partial(const std::filesystem::path& file);

/// Moves the finished partial_name(file) to `file`. Throws std::runtime_error naming the file and the reason.
void finish_partial(const std::filesystem::path& file);

/// Replaces `file` by `text`; a reader sees the old or the new content, never a part. Throws std::runtime_error naming
/// the file and the reason (a full disk, a folder that went away); the old content is then still there.
void write_atomically(const std::filesystem::path& file, std::string_view text);

}  // namespace sprekk
