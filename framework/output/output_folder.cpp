#include "framework/output/output_folder.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>

#include "framework/config/input_error.hpp"
#include "framework/output/atomic_file.hpp"
#include "framework/output/run_lock.hpp"

namespace sprekk {
namespace fs = std::filesystem;
namespace {

InputError unusable(const fs::path& path, const std::string& why) {
  return InputError("the output folder " + path.string() + " cannot be made (" + why + ") choose another one with -o");
}

/// Throws InputError for errors of the file system, which further names would also have: a name that is too long, a
/// folder without permission to search, links in a circle.
bool is_free(const fs::path& path) {
  std::error_code error;
  const fs::file_type type = fs::symlink_status(path, error).type();
  if (type == fs::file_type::not_found) return true;
  if (type == fs::file_type::none) throw unusable(path, error.message());
  if (!fs::is_directory(path, error)) return false;
  const bool is_empty = fs::is_empty(path, error);
  return is_empty && !error;
}

std::string folder_name(const std::string& scene_name) {
  std::string name = scene_name.empty() ? "scene" : scene_name;
  std::replace_if(
      name.begin(), name.end(),
      [](unsigned char c) { return c < 128 && !std::isalnum(c) && c != '.' && c != '-' && c != '_'; }, '_');
  if (name.front() == '.') name.front() = '_';  // a leading dot would hide the folder, or name another folder ("..")
  return name;
}

void require_writable(const fs::path& folder) {
  if (::access(folder.c_str(), W_OK | X_OK) != 0)
    throw InputError("the output folder " + folder.string() +
                     " cannot be written to (permission denied) choose another one with -o");
}

}  // namespace

OutputFolder::OutputFolder(fs::path wanted, Choice choice)
    : wanted_(std::move(wanted)), path_(wanted_), choice_(choice) {}

void OutputFolder::find_free() {
  path_ = wanted_;
  constexpr std::size_t longest = 240;  // bytes, so that there is room for a number within what file systems allow
  if (wanted_.filename().native().size() > longest)
    throw unusable(path_, std::make_error_code(std::errc::filename_too_long).message());
  for (int number = 2; !is_free(path_); ++number) {
    path_ = wanted_;
    path_ += fmt::format("-{}", number);
  }
}

fs::path OutputFolder::default_path(const std::string& scene_name, const fs::path& parent) {
  return parent / folder_name(scene_name);
}

OutputFolder OutputFolder::for_scene(const std::string& scene_name, const fs::path& parent) {
  OutputFolder folder(default_path(scene_name, parent), Choice::numbered);
  folder.find_free();
  return folder;
}

OutputFolder OutputFolder::given(const fs::path& path, Purpose purpose) {
  std::error_code error;
  const bool exists = fs::exists(path, error);
  if (error) throw unusable(path, error.message());
  if (exists) {
    if (!fs::is_directory(path, error))
      throw InputError("the output folder " + path.string() + " is a file (results need a folder) choose another name");
    if (purpose == Purpose::new_run && holds_results(path))
      throw InputError("the output folder " + path.string() +
                       " is not empty (results are never overwritten) choose another one with -o, " +
                       (fs::is_regular_file(path / "checkpoint.h5", error)
                            ? "empty it, or continue the run that it holds with --restart"
                            : "or empty it"));
    require_writable(path);
  }
  return OutputFolder(path, Choice::fixed);
}

bool OutputFolder::holds_results(const fs::path& folder) {
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error))
    if (entry.path().filename() != RunLock::file_name && !is_partial(entry.path())) return true;
  return bool(error);  // what cannot be looked at counts as used
}

const fs::path& OutputFolder::create() {
  if (created_) return path_;
  std::error_code error;
  if (choice_ == Choice::fixed) {
    fs::create_directories(path_, error);
  } else {
    if (wanted_.has_parent_path()) fs::create_directories(wanted_.parent_path(), error);
    // The run takes a folder that it has made or found empty. If another run was faster, it tries the next name.
    while (!error && !fs::create_directory(path_, error) && !error && !is_free(path_)) find_free();
  }
  if (error) throw unusable(path_, error.message());
  require_writable(path_);
  created_ = true;
  return path_;
}

}  // namespace sprekk
