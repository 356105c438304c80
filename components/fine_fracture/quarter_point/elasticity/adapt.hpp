// Refines the mesh of a fine level until the estimated error keeps a tolerance.
#pragma once

#include "components/fine_fracture/quarter_point/elasticity/error_estimate.hpp"
#include "components/fine_fracture/quarter_point/elasticity/model.hpp"

namespace sprekk::fine_fracture {

/// Tolerance and limits of the refinement.
struct AdaptOptions {
  double tolerance = 1e-3;    ///< of ErrorEstimate::relative; by comparison with the limit of refinement
  int at_most = 5;            ///< largest number of meshes
  int most_elements = 50000;  ///< meshes that are expected to have more elements are not made
};

/// The result on the last mesh.
struct Adapted {
  FineModel model;
  FineSolution solution;
  ErrorEstimate estimate;
  int meshes;         ///< how many were made
  bool is_converged;  ///< whether the estimate keeps the tolerance
};

/// Meshes and solves repeatedly, with sizes that distribute the allowed error evenly among the elements, until the
/// estimate keeps the tolerance. Sizes only decrease: no mesh is coarser than the options say.
Adapted adapt(const FineGeometry& geometry, const FineMeshOptions& options, const FineRock& rock,
              const FineLoads& loads, const AdaptOptions& adapt_options,
              const std::shared_ptr<Profile>& profile = std::make_shared<Profile>());

}  // namespace sprekk::fine_fracture
