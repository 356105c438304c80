// Tips whose factors do not tell which of them advances, for example both tips of a straight crack under one pressure.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace sprekk::fine_fracture {

/// Two tips are neutral if an advance changes ln K of both by the same amount, whichever of them advances. The
/// difference of their factors is then the error of the mesh, and does not tell which of them advances. Many advances
/// give the mean of ln K in a group of such tips the right value; the shortest of them are equal ones, and are taken.
/// The Jacobian is that of (ln K, K_II/K_I) by (length/increment, angle), per tip.

/// Whether an advance of one tip instead of the other hardly changes the difference of ln K.
bool is_neutral_pair(const Eigen::MatrixXd& jacobian, int one, int other);
/// The same, judged by the advance of `one` alone.
bool is_indifferent(const Eigen::MatrixXd& jacobian, int one, int other);

/// By how much ln K of neutral tips may be off their mean: the error of a mesh.
inline constexpr double mesh_error = 1e-3;
/// ln K over one increment: a tip that is further off the mean advances more than the others by the excess over this.
inline constexpr double least_difference_slope = 0.01;

/// Whether both have the same advance (increments) and the same K but for round-off, which must not choose a leader.
bool are_twins(const Eigen::VectorXd& residual, const std::vector<double>& advances, int one, int other);

/// The group of each candidate, a number from 0 on; -1 where it is alone. A group is connected by neutral pairs and
/// twins.
std::vector<int> neutral_groups(const Eigen::MatrixXd& jacobian, const Eigen::VectorXd& residual,
                                const std::vector<double>& advances, const std::vector<char>& candidates);

/// The residual of which, in each group, the differences from its mean are less by the mesh's error, or none, and by
/// what the least slope takes from them. `advances`: in increments, per tip.
Eigen::VectorXd believed(const Eigen::VectorXd& residual, const std::vector<double>& advances,
                         const std::vector<int>& groups);

/// Adds the derivative of the least slope's part to the Jacobian.
void add_least_slope(Eigen::MatrixXd& jacobian, const std::vector<int>& groups);

/// The move x with matrix x = right, in which unknowns of the same tie (a number from 0 on; -1: none) get equal values
/// `from` + x. Of their equations the sum is met.
Eigen::VectorXd tied_move(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& right, const Eigen::VectorXd& from,
                          const std::vector<int>& ties);

/// Whether ln K of a tip is further from the mean of its group than the mesh's error.
bool is_apart(const Eigen::VectorXd& residual, const std::vector<int>& groups, int tip);

}  // namespace sprekk::fine_fracture
