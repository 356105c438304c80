// How `geometry:` and `mesh:` are written in a scene.
#pragma once

#include <string>

#include "framework/config/spec.hpp"
#include "framework/meshing/geometry.hpp"

namespace sprekk {

/// The spec of `geometry:`. Mesh files are found relative to `folder`, that of the scene. What it reads still has to
/// pass `validate_geometry`, which needs the mesh options too. The target must outlive the spec.
Spec geometry_spec(Geometry& geometry, const std::string& folder = ".");

/// The spec of `mesh:`.
Spec mesh_spec(MeshOptions& options);

}  // namespace sprekk
