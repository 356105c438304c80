// Builds the tree of nodes from the events of the YAML parser.
#pragma once

#include <yaml-cpp/anchor.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/mark.h>

#include <map>
#include <string>
#include <unordered_map>
#include <vector>

#include "framework/config/node.hpp"

namespace sprekk {

/// Receives the events of one document. Aliases are expanded as copies, within the limits on number and depth.
class YamlBuilder : public YAML::EventHandler {
 public:
  explicit YamlBuilder(std::string source) : source_(std::move(source)) {}

  Node take_root() { return std::move(root_); }

  void OnDocumentStart(const YAML::Mark& mark) override;
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override;
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override;
  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& value) override;
  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value style) override;
  void OnSequenceEnd() override { close(); }
  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value style) override;
  void OnMapEnd() override { close(); }

 private:
  /// A list or map whose end has not been read yet.
  struct Open {
    Node node;
    YAML::anchor_t anchor = 0;
    bool has_key = false;  ///< for a map: the key has been read, and its value comes next
    std::string key;
    Origin key_origin;
    std::unordered_map<std::string, Origin> keys;
  };
  struct Anchored {
    Node node;
    int size = 0;
    int depth = 0;
  };

  Origin origin(const YAML::Mark& mark) const { return {source_, mark.line + 1, mark.column + 1}; }
  void count(int nodes, const Origin& where);
  void require_depth(int depth, const Origin& where) const;
  void require_no_tag(const std::string& tag, const Origin& where) const;
  void open(Node::Kind kind, const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor);
  void close();
  void remember(const Node& node, YAML::anchor_t anchor);
  void add(Node node);
  void take_key(Open& map, const Node& key);

  std::string source_;
  Node root_;
  std::vector<Open> open_;
  std::map<YAML::anchor_t, Anchored> anchored_;
  int count_ = 0;
};

}  // namespace sprekk
