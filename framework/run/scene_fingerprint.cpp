#include "framework/run/scene_fingerprint.hpp"

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

}  // namespace

std::string scene_fingerprint(const Scene& scene) {
  std::string text;
  append_text(scene.whole, text);
  return fingerprint(text);
}

}  // namespace sprekk
