#include "components/fine_fracture/growth/neutral_tips.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <map>

namespace sprekk::fine_fracture {

namespace {

constexpr double of_mean_slope = 0.25;  ///< of the slope of the mean: that of the difference is small beside it
constexpr double same_load = 1e-7, same_advance = 1e-6;  ///< ln K, and increments, of twins: as the search finds them

bool is_small(double difference, double mean) {
  return std::abs(difference) < std::min(least_difference_slope, -of_mean_slope * mean);
}

std::vector<int> members_of(const std::vector<int>& groups, int group) {
  std::vector<int> members;
  for (std::size_t i = 0; i < groups.size(); ++i)
    if (groups[i] == group) members.push_back(static_cast<int>(i));
  return members;
}

double mean_of(const Eigen::VectorXd& residual, const std::vector<int>& groups, int group) {
  const std::vector<int> members = members_of(groups, group);
  double sum = 0;
  for (const int i : members) sum += residual[2 * i];
  return sum / static_cast<double>(members.size());
}

}  // namespace

bool is_neutral_pair(const Eigen::MatrixXd& jacobian, int one, int other) {
  const double own = jacobian(2 * one, 2 * one) + jacobian(2 * other, 2 * other),
               shared = jacobian(2 * one, 2 * other) + jacobian(2 * other, 2 * one);
  return is_small((own - shared) / 2, (own + shared) / 2);
}

bool is_indifferent(const Eigen::MatrixXd& jacobian, int one, int other) {
  const double own = jacobian(2 * one, 2 * one), shared = jacobian(2 * other, 2 * one);
  return is_small(own - shared, own + shared);
}

bool are_twins(const Eigen::VectorXd& residual, const std::vector<double>& advances, int one, int other) {
  return std::abs(residual[2 * one] - residual[2 * other]) < same_load &&
         std::abs(advances[one] - advances[other]) < same_advance;
}

std::vector<int> neutral_groups(const Eigen::MatrixXd& jacobian, const Eigen::VectorXd& residual,
                                const std::vector<double>& advances, const std::vector<char>& candidates) {
  const int count = static_cast<int>(candidates.size());
  std::vector<int> groups(candidates.size(), -1);
  int next = 0;
  for (int i = 0; i < count; ++i)
    for (int j = 0; j < i; ++j) {
      if (!candidates[i] || !candidates[j]) continue;
      if (!is_neutral_pair(jacobian, i, j) && !are_twins(residual, advances, i, j)) continue;
      if (groups[i] < 0 && groups[j] < 0) {
        groups[i] = groups[j] = next++;
      } else if (groups[i] < 0 || groups[j] < 0) {
        groups[i] = groups[j] = std::max(groups[i], groups[j]);
      } else {
        std::ranges::replace(groups, std::max(groups[i], groups[j]), std::min(groups[i], groups[j]));
      }
    }
  return groups;
}

Eigen::VectorXd believed(const Eigen::VectorXd& residual, const std::vector<double>& advances,
                         const std::vector<int>& groups) {
  Eigen::VectorXd values = residual;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    if (groups[i] < 0) continue;
    const Eigen::Index row = 2 * static_cast<Eigen::Index>(i);
    const double mean = mean_of(residual, groups, groups[i]), difference = residual[row] - mean;
    double ahead = advances[i];
    const std::vector<int> members = members_of(groups, groups[i]);
    for (const int j : members) ahead -= advances[j] / static_cast<double>(members.size());
    values[row] = mean + std::copysign(std::max(0.0, std::abs(difference) - mesh_error), difference) -
                  least_difference_slope * ahead;
  }
  return values;
}

void add_least_slope(Eigen::MatrixXd& jacobian, const std::vector<int>& groups) {
  for (std::size_t i = 0; i < groups.size(); ++i) {
    if (groups[i] < 0) continue;
    const Eigen::Index row = 2 * static_cast<Eigen::Index>(i);
    const std::vector<int> members = members_of(groups, groups[i]);
    jacobian(row, row) -= least_difference_slope;
    for (const int j : members) jacobian(row, 2 * j) += least_difference_slope / static_cast<double>(members.size());
  }
}

Eigen::VectorXd tied_move(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& right, const Eigen::VectorXd& from,
                          const std::vector<int>& ties) {
  const int size = static_cast<int>(ties.size());
  std::map<int, int> column_of_tie;
  std::vector<int> column(ties.size()), members;
  std::vector<double> sum;
  for (int a = 0; a < size; ++a) {
    const auto tied = ties[a] < 0 ? column_of_tie.end() : column_of_tie.find(ties[a]);
    column[a] = tied == column_of_tie.end() ? static_cast<int>(members.size()) : tied->second;
    if (tied == column_of_tie.end()) {
      members.push_back(0);
      sum.push_back(0);
      if (ties[a] >= 0) column_of_tie[ties[a]] = column[a];
    }
    ++members[column[a]];
    sum[column[a]] += from[a];
  }
  const int unknowns = static_cast<int>(members.size());
  if (unknowns == size) return matrix.fullPivLu().solve(right);
  Eigen::MatrixXd spread = Eigen::MatrixXd::Zero(size, unknowns);
  Eigen::VectorXd to_equal = Eigen::VectorXd::Zero(size);
  for (int a = 0; a < size; ++a) {
    spread(a, column[a]) = 1;
    if (ties[a] >= 0) to_equal[a] = sum[column[a]] / members[column[a]] - from[a];
  }
  const Eigen::MatrixXd reduced = spread.transpose() * matrix * spread;
  return to_equal + spread * reduced.fullPivLu().solve(spread.transpose() * (right - matrix * to_equal));
}

bool is_apart(const Eigen::VectorXd& residual, const std::vector<int>& groups, int tip) {
  return groups[tip] >= 0 && std::abs(residual[2 * tip] - mean_of(residual, groups, groups[tip])) > mesh_error;
}

}  // namespace sprekk::fine_fracture
