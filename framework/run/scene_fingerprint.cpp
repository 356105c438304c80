#include "framework/run/scene_fingerprint.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "framework/output/checkpoint.hpp"

namespace sprekk {

namespace {

void append_text(const Node& node, std::string& text) {
  text += node.scalar;
  for (const Node& item : node.items) append_text(item, text += "[");
  for (const Node::Entry& entry : node.entries) {
    if (node.path.empty() && (entry.key == "output" || entry.key == "name")) continue;
    if (node.path == "time" && entry.key == "end") continue;
    append_text(entry.value, text += "{" + entry.key + ":");
  }
  text += ";";
}

void add_files(const Node& node, std::vector<std::string>& files) {
  for (const Node& item : node.items) add_files(item, files);
  for (const Node::Entry& entry : node.entries) {
    if (node.path.empty() && entry.key == "output") continue;
    const bool is_file = entry.value.is_scalar() && (entry.key == "table" || entry.key == "file");
    if (is_file && std::ranges::count(files, entry.value.scalar) == 0) files.push_back(entry.value.scalar);
    add_files(entry.value, files);
  }
}

std::string content_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream content;
  content << stream.rdbuf();
  return content.str();
}

}  // namespace

std::vector<std::string> files_of(const Scene& scene) {
  std::vector<std::string> files;
  add_files(scene.whole, files);
  return files;
}

std::string scene_fingerprint(const Scene& scene) {
  std::string text;
  append_text(scene.whole, text);
  for (const std::string& file : files_of(scene))
    text += fingerprint(content_of(std::filesystem::path(scene.folder) / file));
  return fingerprint(text);
}

}  // namespace sprekk
