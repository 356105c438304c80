// Where the faces of the outer boundary meet one another, and which side of the domain is there.
#pragma once

#include <map>
#include <vector>

#include "framework/mesh/face_table.hpp"
#include "framework/mesh/raw_mesh.hpp"

namespace sprekk {

/// A ridge, whichever way it is named.
RidgeNodes sorted(RidgeNodes ridge);

/// The sides of the outer faces of a mesh and of their ridges.
class OuterRidges {
 public:
  OuterRidges() = default;
  /// Throws InputError for a face of a side that no cell has or that is inside of the mesh, for outer faces that have
  /// no side or two, and where the outer boundary touches itself.
  OuterRidges(const RawMesh& raw, const FaceTable& faces);

  /// Index into RawMesh::side_names, or none inside.
  int side_of_face(int face) const { return side_of_face_[face]; }
  bool has(const RidgeNodes& ridge) const { return ridges_.count(sorted(ridge)) > 0; }
  /// The side with the smallest index of the outer faces that have this ridge; they are two.
  int side_of(const RidgeNodes& ridge) const { return ridges_.at(sorted(ridge)).side; }

 private:
  struct AtRidge {
    int faces = 0, side = 0;
  };
  std::vector<int> side_of_face_;
  std::map<RidgeNodes, AtRidge> ridges_;
};

}  // namespace sprekk
