// Sets of fractures on which a component has values.
#pragma once

#include <string>
#include <vector>

#include "framework/config/input_error.hpp"
#include "framework/mesh/mesh.hpp"

namespace sprekk {

/// One flag a fracture cell: whether its fracture has one of these names; `joints_*` stands for all names that begin
/// with `joints_`. Grown cells belong to the fracture that they continue. Empty where the set has all fractures, as
/// with empty `names`. Throws InputError at `origin` for a name that no fracture has.
std::vector<char> fracture_set(const Mesh& mesh, const std::vector<std::string>& names, const Origin& origin);

}  // namespace sprekk
