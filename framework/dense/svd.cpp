#include "framework/dense/svd.hpp"

template class Eigen::JacobiSVD<Eigen::MatrixXd>;
