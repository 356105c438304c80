// The fluxes out of a fracture cell at one of its ridges.
#pragma once

#include <utility>
#include <vector>

#include "framework/mesh/mesh.hpp"

namespace sprekk::fracture_flow {

/// Keeps a pointer to the mesh, which must stay alive and unchanged.
class Outflows {
 public:
  Outflows() = default;  ///< of no cells
  explicit Outflows(const Mesh& mesh);

  /// The ridges whose fluxes add up to the outflow of a cell at a ridge, with the signs of these fluxes: at a junction
  /// one for each of the other cells there, else one. At a junction, `ridge` may be any of the ridges there.
  std::vector<std::pair<int, double>> at(int cell, int ridge) const;

 private:
  const Mesh* mesh_ = nullptr;
  std::vector<int> junction_of_ridge_;
};

}  // namespace sprekk::fracture_flow
