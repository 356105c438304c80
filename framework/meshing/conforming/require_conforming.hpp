// Refuses meshes whose cells do not fit together.
#pragma once

#include <string>
#include <vector>

#include "framework/mesh/face_table.hpp"
#include "framework/mesh/raw_mesh.hpp"

namespace sprekk {

/// Throws InputError, with the number of places and where they are, if
/// - edges lie on one another with nodes of their own, or a node lies on the inside of an edge;
/// - cells overlap, or leave a gap that is far narrower than their edges;
/// - a few cells are missing: a hole with few edges, none of which `has_group`.
///
/// Returns a note for each larger hole without a group. In space faces take the place of edges, and gaps are not looked
/// for. The cells have the order of their shapes. Takes time in proportion to n log n of the number n of outer faces,
/// in space to n^1.5.
std::vector<std::string> require_conforming(const RawMesh& mesh, const FaceTable& faces,
                                            const std::vector<bool>& has_group);

}  // namespace sprekk
