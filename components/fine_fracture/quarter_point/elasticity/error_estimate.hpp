// How far the stress of a solution is from the true one.
#pragma once

#include <vector>

#include "components/fine_fracture/quarter_point/elasticity/model.hpp"

namespace sprekk::fine_fracture {

struct ErrorEstimate {
  std::vector<double> elements;  ///< energy norm of the error in every element, (J/m)^1/2
  double total;                  ///< the root of the sum of their squares
  double relative;               ///< total over the energy norm of the solution
};

/// Zienkiewicz and Zhu 1992: the error is the distance from a smoother stress, which comes from quadratic polynomials
/// fitted to the stress around every corner node. Near a tip the fit is of what the singular fields with the computed
/// K leave over. In rosettes the fit outside is continued.
/// `solution` has the factors of all tips.
ErrorEstimate estimate_error(const FineModel& model, const FineSolution& solution);

}  // namespace sprekk::fine_fracture
