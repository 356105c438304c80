// Estimates the error of the stress of a solution.
#pragma once

#include <vector>

#include "components/fine_fracture/quarter_point/elasticity/model.hpp"

namespace sprekk::fine_fracture {

/// An estimate of the error in the energy norm.
struct ErrorEstimate {
  std::vector<double> elements;  ///< energy norm of the error in every element, (J/m)^1/2
  double total;                  ///< the root of the sum of their squares
  double relative;               ///< total over the energy norm of the solution
};

/// The estimate of Zienkiewicz and Zhu 1992: the distance of the stress from a smoother one, which comes from quadratic
/// polynomials that are fitted to the stress around every corner node. Near a tip the singular fields with the computed
/// K are subtracted before the fit. In rosettes the fit outside is continued. `solution` must have the factors of all
/// tips.
ErrorEstimate estimate_error(const FineModel& model, const FineSolution& solution);

}  // namespace sprekk::fine_fracture
