#include "framework/study/scene_identity.hpp"

#include <algorithm>
#include <fstream>
#include <sstream>

#include "framework/output/checkpoint.hpp"

namespace sprekk {
namespace {

/// Adds the content of the file when the text names one.
void append_file(const std::filesystem::path& file, std::string& text) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file, ignored)) return;
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream content;
  content << stream.rdbuf();
  text += text_identity(content.str());
}

void append(const Node& node, const std::filesystem::path& folder, std::string& text) {
  if (node.is_scalar()) {
    text += yaml_scalar(node.scalar);
    append_file(folder / node.scalar, text);
  }
  for (const Node& item : node.items) append(item, folder, text += "-");
  std::vector<const Node::Entry*> entries;
  for (const Node::Entry& entry : node.entries)
    if (!node.path.empty() || entry.key != "name") entries.push_back(&entry);
  std::sort(entries.begin(), entries.end(), [](const Node::Entry* a, const Node::Entry* b) { return a->key < b->key; });
  for (const Node::Entry* entry : entries) append(entry->value, folder, text += yaml_scalar(entry->key) + ":");
  text += "\n";
}

}  // namespace

std::string text_identity(const std::string& text) { return fingerprint(text); }

std::string scene_identity(const Node& scene, const std::filesystem::path& folder) {
  std::string text;
  append(scene, folder, text);
  return text_identity(text);
}

}  // namespace sprekk
