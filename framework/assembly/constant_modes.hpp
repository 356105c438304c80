// What holds a potential, so that no constant can be added to all of its values (docs/numerics/constant_modes.md).
#pragma once

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "framework/config/input_error.hpp"
#include "framework/field/field.hpp"

namespace sprekk {

/// Components say which of their unknowns float, couplers what ties or holds them. A field of which nobody says that it
/// floats is held.
class ConstantModes {
 public:
  /// Its own equations and data leave a constant open: `why`, and what would hold it.
  void floats(const Field& field, const Origin& where, const std::string& why, const std::string& suggestion);
  void hold(const Field& field) { held_.insert(&field); }
  /// They share one constant: what holds one holds the other.
  void tie(const Field& one, const Field& other) { ties_.emplace_back(&one, &other); }
  /// Throws InputError naming a field whose constant nothing holds.
  void require_held() const;

 private:
  struct Floating {
    const Field* field;
    Origin where;
    std::string why, suggestion;
  };
  bool floats(const Field* field) const;

  std::vector<Floating> floating_;  ///< in the order of the scene, which messages follow
  std::set<const Field*> held_;
  std::vector<std::pair<const Field*, const Field*>> ties_;
};

}  // namespace sprekk
