// Of all fronts that have K = K_IC within the error of the mesh, the one with the most equal advances.
#pragma once

#include <Eigen/Core>

namespace sprekk::fine_fracture {

/// K at a tip is known up to an error of the mesh, e = 1e-3. Where an advance of one tip unloads another as much as
/// itself, as at both ends of a straight crack under one pressure, this error over a slope near zero would decide which
/// of them advances. So the loads r_i = ln(K/K_IC) of growing tips with the advances a_i need not vanish one by one,
/// but
///   r_m + g_i = 0,     r_m = sum_j w_j r_j,     g_i = sum_j w_j [S(r_i - r_j) - H(a_i - a_j)],     w_j = a_j / sum a,
/// with S(x) = sign(x) max(0, |x| - 2e) and H(x) = 2e x / (|x| + d), d = 0.2 increments. As sum w_i g_i = 0, it means
/// - r_m = 0: the tips together release the energy that their advances need;
/// - two tips advance by the same as long as their loads differ by no more than 2e, the error of both;
/// - the more loaded of two others advances more, so that their loads differ by less than 4e; a tip alone has r = 0;
/// - nothing depends on slopes or on earlier trials. A tip that comes to rest has no weight any more, so that the
///   equations are continuous there. If loads fall at least as much by a tip's own advance as by others', there is one
///   solution for two tips.
struct FrontEquations {
  Eigen::VectorXd residual;    ///< n; r_m + g_i
  Eigen::VectorXd difference;  ///< n; g_i
  Eigen::MatrixXd by_load;     ///< n x n, the derivative of the residual by r
  Eigen::MatrixXd by_advance;  ///< n x n, its derivative by a (1/increment) where the loads stay
};

/// `loads`: r_i; `advances`: a_i >= 0, in increments; `mesh_error`: e, 0 where each load is to vanish by itself. The
/// derivatives are exact near the solution, but of two tips that are to advance by the same: there H has its chord,
/// which leads to equal advances at once.
FrontEquations most_equal_front(const Eigen::VectorXd& loads, const Eigen::VectorXd& advances, double mesh_error);

/// What has to be positive for a tip at rest with this load to grow with the tips of the front (r_m + g of it). The
/// load itself without a front, and without an error.
double load_beside_front(double load, const Eigen::VectorXd& loads, const Eigen::VectorXd& advances, double mesh_error);

/// What has to be positive for a front at rest to grow: the mean of the loads that differ from the largest by no more
/// than 2e, since these tips advance by the same.
double load_of_front_at_rest(const Eigen::VectorXd& loads, double mesh_error);

/// Whether all loads differ by no more than 2e: then all advances are equal.
bool advances_are_equal(const Eigen::VectorXd& loads, double mesh_error);

}  // namespace sprekk::fine_fracture
