// The contacts of the fractures that a coupler stands between.
#pragma once

#include <cstdint>
#include <vector>

#include "components/capabilities/fracture_contact.hpp"
#include "framework/scene/component.hpp"

namespace sprekk::couplers {

/// One contact for all fractures, or several, each on its own fractures, or none. On other fractures the traction and
/// jump of a contact are zero, so the sums over all contacts are the tractions and jumps of all fractures.
class Contacts {
 public:
  /// Throws InputError where a fracture has two of the contacts between which the coupler stands.
  explicit Contacts(const CouplerContext& context);
  /// Throws InputError where a fracture has none of them, unless there is no contact at all.
  void need_all_fractures(const CouplerContext& context) const;

  bool empty() const { return contacts_.empty(); }
  auto begin() const { return contacts_.begin(); }
  auto end() const { return contacts_.end(); }
  bool are_several() const { return contacts_.size() > 1; }
  /// The contact of a fracture cell, or nullptr.
  const FractureContact* at(int cell) const { return empty() ? nullptr : of_cell_[cell]; }

  /// Sums over all contacts, (normal, tangential) of each fracture cell; there must be one.
  Vector traction() const;                 ///< Pa
  Vector jump() const;                     ///< m
  Vector accepted_jump() const;            ///< m
  std::uint64_t traction_version() const;  ///< grows when the traction of any changes

 private:
  std::vector<FractureContact*> contacts_;
  std::vector<const FractureContact*> of_cell_;
};

}  // namespace sprekk::couplers
