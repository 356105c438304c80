#include "framework/meshing/generate_mesh.hpp"

#include "framework/mesh/build_mesh.hpp"
#include "framework/meshing/distort_mesh.hpp"
#include "framework/meshing/made_by_root.hpp"
#include "framework/meshing/number_in_space.hpp"
#include "framework/meshing/read_msh.hpp"
#include "framework/meshing/regions.hpp"
#include "framework/meshing/single_cell_corners.hpp"
#include "framework/meshing/structured_mesh.hpp"
#include "framework/meshing/unstructured_mesh.hpp"
#include "framework/meshing/validate_geometry.hpp"

namespace sprekk {
namespace {

RawMesh triangulate(const Geometry& geometry, const MeshOptions& options) {
  if (geometry.is_imported()) return read_msh(geometry.file, geometry.file_origin);
  if (options.kind == MeshOptions::Kind::structured) return structured_mesh(geometry, options);
  return unstructured_mesh(geometry, options);
}

RawMesh finished(RawMesh raw, const Geometry& geometry, const MeshOptions& options) {
  // In space validate_geometry refuses a distortion, and tetrahedra in corners stay.
  if constexpr (dimension == 2) avoid_single_cell_corners(raw);
  const std::vector<Point> places = raw.nodes;
  if constexpr (dimension == 2) distort_mesh(raw, options.distortion, options.seed);
  // A distorted mesh is numbered like the mesh before the distortion. Structured meshes keep their numbers, which
  // follow the grid lines.
  if (geometry.is_imported() || options.kind == MeshOptions::Kind::unstructured) number_in_space(raw, places);
  return raw;
}

}  // namespace

Mesh generate_mesh(const Geometry& geometry, const MeshOptions& options) {
  validate_geometry(geometry, options);
  bool is_made = false;
  try {
    return build_mesh(made_by_root([&] {
      RawMesh raw = triangulate(geometry, options);
      is_made = true;
      return finished(std::move(raw), geometry, options);
    }));
  } catch (const InputError& error) {
    if (!is_made || !geometry.is_imported()) throw;
    // Wrong triangles in a file are an error of the user, so the message names the file.
    throw InputError(geometry.file_origin, "cannot use the mesh file '" + geometry.file + "'", error.what());
  }
}

MeshNames mesh_names(const Geometry& geometry) {
  MeshNames names;
  if (geometry.is_imported()) {
    const RawMesh raw = read_msh(geometry.file, geometry.file_origin, &names.notes);
    names.regions = raw.region_names;
    names.sides = raw.side_names;
    for (const auto& fracture : raw.fractures) names.fractures.push_back(fracture.name);
    return names;
  }
  names.regions = region_names(geometry);
  names.sides.assign(box_sides.begin(), box_sides.end());
  for (const SidePart& part : geometry.side_parts) names.sides.push_back(part.name);
  for (const FractureGeometry& fracture : geometry.fractures) names.fractures.push_back(fracture.name);
  return names;
}

}  // namespace sprekk
