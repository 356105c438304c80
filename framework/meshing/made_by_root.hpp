// Meshes that one process makes for all.
#pragma once

#include <functional>

#include "framework/mesh/raw_mesh.hpp"

namespace sprekk {

/// Calls `make` on the first process, and gives its mesh to all. An exception of `make` is thrown on all: InputError as
/// such, others as std::runtime_error. Collective.
RawMesh made_by_root(const std::function<RawMesh()>& make);

}  // namespace sprekk
