// What lies between the cells of fractures, and what ends them.
#pragma once

#include <map>
#include <vector>

#include "framework/mesh/add_junction.hpp"
#include "framework/mesh/mesh.hpp"
#include "framework/mesh/outer_ridges.hpp"
#include "framework/mesh/raw_mesh.hpp"

namespace sprekk {

/// Finds where the cells of fractures meet, while fractures are added one after the other.
class FractureRidges {
 public:
  /// `faces`: of the fracture, whose cells get the next numbers. Throws InputError for a fracture that meets itself (a
  /// branch, or a loop in a plane), touches the outer boundary other than with its end, or meets another fracture
  /// there.
  void add(const RawMesh& raw, int fracture, const std::vector<FaceNodes>& faces, const OuterRidges& outer);

  /// Gives the mesh, which has all fracture cells, its ridges and junctions.
  void add_to(Mesh& mesh, const RawMesh& raw, const OuterRidges& outer) const;

 private:
  struct Place {
    RidgeNodes nodes;
    std::vector<RidgeOfCell> at;  ///< in ascending order of cells
    int fracture = none;          ///< the last one that is here, with so many cells
    int cells_of_fracture = 0;
    bool is_junction = false;
  };
  static void claim(const RawMesh& raw, int fracture, Place& place, int k, const OuterRidges& outer);
  void add_ridge(Mesh& mesh, const RawMesh& raw, const RidgeOfCell& first, const OuterRidges& outer) const;

  std::map<RidgeNodes, int> number_of_;  ///< of a place, by its sorted nodes
  std::vector<Place> places_;
  std::vector<FaceRidges> places_of_cell_;
};

}  // namespace sprekk
