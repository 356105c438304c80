// The ends of fractures, by name and in one order, and the cells there.
#pragma once

#include <string>
#include <vector>

#include "components/fine_fracture/fine_level/fine_domain.hpp"
#include "components/fine_fracture/growth/grow_tips.hpp"
#include "framework/mesh/mesh.hpp"
#include "framework/mesh/mesh_change.hpp"

namespace sprekk::fine_fracture {

/// Both ends of each fracture, in the order of the fractures, the first end first.
std::vector<TipEnd> all_ends(const Mesh& mesh);
std::string name_of(const Mesh& mesh, const TipEnd& end);  ///< "main_first"
Ridge::Kind kind_of(const Mesh& mesh, const TipEnd& end);  ///< a tip, a junction or on the boundary
inline bool is_same(const TipEnd& a, const TipEnd& b) { return a.fracture == b.fracture && a.at_end == b.at_end; }

Point end_point(const Mesh& mesh, const TipEnd& end);  ///< where the fracture ends in the mesh, m
/// The last cell of the fracture at this end.
const FractureCell& end_cell(const Mesh& mesh, const TipEnd& end);
double fracture_length(const Mesh& mesh, int fracture);  ///< of all its cells, m
/// The length of the cell at this end of the fracture as the scene gives it, before any growth, m.
double original_size(const Mesh& mesh, const TipEnd& end);
/// The length of the fracture's new cells at this end, m.
double new_length(const Mesh& mesh, const TipEnd& end, const MeshChange& change);
/// The length of the fracture's cells at this end that were given up for new ones, m.
double given_up_length(const Mesh& mesh, const TipEnd& end, const MeshChange& change);
/// The length of a path that begins at `from`, m.
double length_of(const Point& from, const TipPath& path);

}  // namespace sprekk::fine_fracture
