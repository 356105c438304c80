// Keys that stand for several names.
#pragma once

#include <string>

namespace sprekk {

/// Whether a key is like `joints_*`, which stands for all names that begin so.
inline bool is_beginning(const std::string& key) { return key.size() > 1 && key.back() == '*'; }
/// Whether a key stands for a name: the key is this name, or is like `joints_*` and the name begins so.
inline bool stands_for(const std::string& key, const std::string& name) {
  return is_beginning(key) ? name.starts_with(key.substr(0, key.size() - 1)) : key == name;
}

}  // namespace sprekk
