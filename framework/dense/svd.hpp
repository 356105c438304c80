// The singular value decomposition of dense matrices. Its code takes six seconds to compile: here once for all.
#pragma once

#include <Eigen/SVD>

namespace sprekk {

using DenseSvd = Eigen::JacobiSVD<Eigen::MatrixXd>;

}  // namespace sprekk

extern template class Eigen::JacobiSVD<Eigen::MatrixXd>;
