// Which unknowns have a constant mode in their null space, and what removes it (docs/numerics/constant_modes.md).
#pragma once

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "framework/config/input_error.hpp"
#include "framework/field/field.hpp"

namespace sprekk {

/// Finds potentials to which any constant may be added. Components declare which of their unknowns float (the equations
/// leave a constant open), couplers which fields they tie together or hold. A field that nobody declares floating is
/// held.
class ConstantModes {
 public:
  /// Declares that the field's own equations and data leave a constant open: `why`, and what would hold it.
  void floats(const Field& field, const Origin& where, const std::string& why, const std::string& suggestion);
  void hold(const Field& field);
  /// Declares that two fields share one constant: what holds one holds the other.
  void tie(const Field& one, const Field& other);
  /// Throws InputError naming a floating field that nothing holds.
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
