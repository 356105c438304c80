// The specs of `geometry:` and `mesh:` in a scene.
#pragma once

#include <string>

#include "framework/config/spec.hpp"
#include "framework/meshing/geometry.hpp"

namespace sprekk {

/// The spec of `geometry:`. Paths of mesh files are relative to `folder`, the folder of the scene. After reading, the
/// caller checks the geometry by `validate_geometry`, which also needs the mesh options. `geometry` must outlive the
/// spec.
Spec geometry_spec(Geometry& geometry, const std::string& folder = ".");

/// The spec of `mesh:`.
Spec mesh_spec(MeshOptions& options);

}  // namespace sprekk
