// Extends fractures in a mesh: cells around the tips are removed, and new cells are made along the new paths.
#pragma once

#include <vector>

#include "framework/mesh/mesh.hpp"
#include "framework/mesh/mesh_change.hpp"
#include "framework/remeshing/cavity_options.hpp"
#include "framework/remeshing/extension_check.hpp"

namespace sprekk {

/// A mesh with extended fractures, and its relation to the mesh before.
struct GrownMesh {
  Mesh mesh;
  MeshChange change;
  double smallest_angle;  ///< rad, of the new cells
  /// Per extension: its fracture cells, from the old tip (or the anchor of what is replaced) on.
  std::vector<std::vector<int>> extension_cells;
};

/// Marks the fracture cells that are new, or come from cells that were marked (FractureCell::grown).
void mark_grown_cells(const Mesh& before, GrownMesh& grown);

/// Extends fractures. Each given segment becomes one or more fracture cells of about `size`, shorter in narrow gaps, or
/// exactly one (PathExtension::whole_segments). Cells that an extension replaces close first; those around them are
/// made anew together with those around the new path, so that every cell that is kept has kept its faces. Existing
/// fracture cells, interfaces between regions and the outer boundary stay; edges of the outer boundary may be divided
/// near a path. Cells outside of the cavity keep their corners. They keep their numbers, too, unless there are fewer
/// cells than before: then the last cells move to the lowest free numbers. New cells are triangles, also where
/// quadrilaterals were. An end within a hundredth of `size` of the outer boundary is moved onto it and becomes
/// on_boundary. An end as near to a ridge of another fracture joins that fracture in a junction. When an angle is below
/// 25 degrees, further cavities are tried, and the cavity with the largest smallest angle is taken. Throws
/// ExtensionError, before any work, for paths that check_extensions refuses, std::invalid_argument for a radius, size
/// or growth that is not positive and for negative gap_edges, and std::runtime_error when the cavity cannot be meshed.
GrownMesh extend_fractures(const Mesh& mesh, const std::vector<PathExtension>& extensions,
                           const CavityOptions& options);

}  // namespace sprekk
