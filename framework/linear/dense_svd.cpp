#include "framework/linear/dense_svd.hpp"

template class Eigen::JacobiSVD<Eigen::MatrixXd>;
