// Meshes that one process makes for all.
#pragma once

#include <functional>

#include "framework/mesh/raw_mesh.hpp"

namespace sprekk {

/// What `make` gives on the first process, on all of them. Its exceptions are thrown on all: InputError as such, others
/// as std::runtime_error. Collective.
RawMesh made_by_root(const std::function<RawMesh()>& make);

}  // namespace sprekk
