// Data that belong to one place.
#pragma once

#include <string>

#include "framework/config/data.hpp"
#include "framework/config/input_error.hpp"

namespace sprekk {

/// Throws InputError where data vary in space that have one value. `name`: "the rate of well 'a'"; `because`: why.
inline void require_one_place(const Data& data, const std::string& name, const std::string& because,
                              const Origin& where) {
  if (data.depends_on_space())
    throw InputError(where, name + " varies in space", because, "give one value for all places");
}

}  // namespace sprekk
