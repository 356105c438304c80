// The folder that receives a run's results. Nothing is ever overwritten.
#pragma once

#include <filesystem>
#include <string>

namespace sprekk {

/// The name of a folder for results, which is made later. Usage: construct the object while the scene is checked, call
/// `create` when the run starts:
///   OutputFolder folder = OutputFolder::for_scene("mandel");
///   std::filesystem::path history = folder.create() / "history.csv";
class OutputFolder {
 public:
  /// Whether the folder must be empty (new_run), or holds the results of a run that is continued.
  enum class Purpose { new_run, restart };

  /// `parent/<scene name>`, or the first of `<scene name>-2`, `-3`, … that is missing or empty. Characters of the scene
  /// name that are not allowed in the name of a folder become '_'. Throws InputError when the parent folder cannot be
  /// read.
  static OutputFolder for_scene(const std::string& scene_name, const std::filesystem::path& parent = "results");

  /// `parent/<scene name>`, whether or not it is there.
  static std::filesystem::path default_path(const std::string& scene_name,
                                            const std::filesystem::path& parent = "results");

  /// The folder that the user asks for (-o), or that holds the checkpoint of a restart. Throws InputError if it is not
  /// a folder, or not writable, or holds results (holds_results) while a new run is to be written into it.
  static OutputFolder given(const std::filesystem::path& path, Purpose purpose = Purpose::new_run);

  /// Whether the folder contains more than a lock and incomplete files, which is all that a run leaves that was killed
  /// before its first checkpoint. True for a folder that cannot be read.
  static bool holds_results(const std::filesystem::path& folder);

  /// Makes the folder with its parents; further calls do nothing. Throws InputError when it cannot be made.
  const std::filesystem::path& create();

  /// The folder for the results. Before `create`, another run may still take a default folder; the name then changes.
  const std::filesystem::path& path() const { return path_; }

 private:
  enum class Choice { numbered, fixed };
  OutputFolder(std::filesystem::path wanted, Choice choice);
  void find_free();

  std::filesystem::path wanted_, path_;
  Choice choice_;
  bool created_ = false;
};

}  // namespace sprekk
