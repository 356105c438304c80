// Fields of amounts that are counted step by step, with the unknown that they follow from.
#pragma once

#include <string>

#include "framework/field/field.hpp"

namespace sprekk {

/// A derived field of amounts at the places of `unknown`, accepted together with it, also after a substep. `unit`: of
/// an amount (units_of_amounts.hpp).
inline FieldSpec amounts_with(const Field& unknown, std::string owner, std::string name, std::string unit,
                              std::string doc, int components = 1) {
  return {.owner = std::move(owner),
          .name = std::move(name),
          .location = unknown.spec().location,
          .components = components,
          .role = Role::derived(),
          .unit = std::move(unit),
          .doc = std::move(doc),
          .accepted_with = unknown.name(),
          .is_amount = true};
}

}  // namespace sprekk
