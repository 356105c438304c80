// The forces between walls that may touch.
#pragma once

#include <Eigen/Core>

#include "framework/types.hpp"

namespace sprekk::fine_fracture {

/// The forces f <= 0 with gaps + compliance f >= 0, one of which is 0 at each place. First all places whose condition
/// is violated change at once (a semismooth Newton method); if that cycles, only the first of them changes (Murty,
/// Linear Algebra Appl. 7 (1974) 65). Throws UnsolvedGrowth where no such state is found.
Vector contact_forces(const Eigen::MatrixXd& compliance, const Vector& gaps);

}  // namespace sprekk::fine_fracture
