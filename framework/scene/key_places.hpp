// Where the keys of a scene belong, for messages on misplaced ones.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "framework/config/spec.hpp"

namespace sprekk {

/// All keys that some spec declares, with the places where they may stand.
class KeyPlaces {
 public:
  /// Those of a scene. Types of parts that `scene` has come before others; `sections`: the keys at its top,
  /// `specs`: those of its sections.
  KeyPlaces(const Node& scene, const std::vector<std::string>& sections, const std::vector<Spec>& specs);

  /// Those of a file of another kind.
  explicit KeyPlaces(const Spec& file) { add(file, "", "", 0); }

  /// "'every' belongs in 'output'", with at most three places; "" for a key that belongs nowhere.
  std::string text(const std::string& key) const;

 private:
  /// Adds the keys of a map, which messages call `name`: "'output'", "a component role/name".
  void add(const Spec& spec, const std::string& name, const std::string& path, int rank);
  void add_key(const std::string& key, const std::string& place, int rank);

  /// For each key the places, by rank: first what the scene has, then what it may have.
  std::map<std::string, std::map<int, std::vector<std::string>>> places_;
};

}  // namespace sprekk
