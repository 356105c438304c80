// Meshes from files.
#pragma once

#include <string>
#include <vector>

#include "framework/config/input_error.hpp"
#include "framework/mesh/raw_mesh.hpp"

namespace sprekk {

/// Reads the triangles and quadrilaterals of a gmsh mesh file (format MSH, version 2.2 or 4.1, text or binary) in the
/// x-y plane; in space its tetrahedra, wedges and hexahedra, with volumes and surfaces for what follows. gmsh itself
/// never opens the file, since gmsh runs any file that is no mesh as a script. Physical groups of surfaces are regions
/// (named after the medium where there is none). Physical groups of curves on the outer boundary are sides (`boundary`
/// where there is none), those inside are fractures, directed as the first of their lines in the file. A group along
/// which gmsh has cut the mesh open is a fracture (`glue_cuts`; not in space). `notes` receives what the user of the
/// file may not expect.
///
/// Throws InputError, with `origin` and the line (or the byte) of the file, for
/// - files that cannot be read or are malformed (`parse_msh`), and elements of another kind than these;
/// - nodes off the plane, or farther than 1e12 m;
/// - cells without an area, or in two groups, and two groups with one name;
/// - curve groups that branch, close, fall apart, leave the cells' edges, or lie partly inside and partly on the
///   boundary;
/// - cells that do not fit together (`require_conforming`).
RawMesh read_msh(const std::string& file, const Origin& origin = {}, std::vector<std::string>* notes = nullptr);

/// 3 for a mesh file of volumes, else 2, also for a file that cannot be read.
int dimension_of_mesh_file(const std::string& file);

}  // namespace sprekk
