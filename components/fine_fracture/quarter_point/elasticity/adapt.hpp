// Meshes as fine as a solution needs them.
#pragma once

#include "components/fine_fracture/quarter_point/elasticity/error_estimate.hpp"
#include "components/fine_fracture/quarter_point/elasticity/model.hpp"

namespace sprekk::fine_fracture {

struct AdaptOptions {
  double tolerance = 1e-3;    ///< of ErrorEstimate::relative
  int at_most = 5;            ///< meshes
  int most_elements = 50000;  ///< no mesh is made that the estimate expects to exceed this
};

struct Adapted {
  FineModel model;
  FineSolution solution;
  ErrorEstimate estimate;
  int meshes;         ///< how many were made
  bool is_converged;  ///< whether the estimate keeps the tolerance
};

/// Meshes and solves again, with sizes that share the allowed error evenly among the elements, until the estimate keeps
/// the tolerance. Sizes only shrink, so that the meshes' sizes are those of the options or finer.
Adapted adapt(const FineGeometry& geometry, const FineMeshOptions& options, const Elasticity& rock,
              const FineLoads& loads, const AdaptOptions& adapt_options,
              const std::shared_ptr<Profile>& profile = std::make_shared<Profile>());

}  // namespace sprekk::fine_fracture
