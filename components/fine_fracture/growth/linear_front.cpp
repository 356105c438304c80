#include "components/fine_fracture/growth/linear_front.hpp"

#include <algorithm>

#include "components/fine_fracture/growth/most_equal_front.hpp"
#include "framework/dense/lu.hpp"
#include "framework/invariants.hpp"

namespace sprekk::fine_fracture {

namespace {

constexpr double round_off = 1e-13;      ///< of F: found
constexpr double nearly = 100;           ///< round-offs: found where no step makes F smaller
constexpr int most_steps = 60;           ///< of Newton's method
constexpr double shortest_share = 1e-4;  ///< of a step of Newton's method
constexpr int most_relaxations = 20000;  ///< twenty times what slopes of H of 1e-3 beside slopes of loads of 1 need
constexpr double longest = 10;           ///< increments: further away there is no front

/// F where a tip may still move, 0 where it rests as it has to.
Eigen::VectorXd unmet(const FrontEquations& front, const Eigen::VectorXd& advances) {
  Eigen::VectorXd values = front.residual;
  for (Eigen::Index i = 0; i < values.size(); ++i)
    if (advances[i] <= 0 && values[i] <= 0) values[i] = 0;
  return values;
}

class Search {
 public:
  Search(const LinearLoads& model, double mesh_error) : model_(model), mesh_error_(mesh_error) {}

  Eigen::VectorXd unmet_at(const Eigen::VectorXd& advances) const { return unmet(equations(advances), advances); }

  /// Newton's method from these advances, on the tips that do not rest.
  bool newton(Eigen::VectorXd& advances) const {
    for (int step = 0; step < most_steps; ++step) {
      const FrontEquations front = equations(advances);
      const Eigen::VectorXd left = unmet(front, advances);
      if (left.lpNorm<Eigen::Infinity>() < round_off) return true;
      std::vector<Eigen::Index> free;
      for (Eigen::Index i = 0; i < left.size(); ++i)
        if (advances[i] > 0 || front.residual[i] > 0) free.push_back(i);
      const Eigen::MatrixXd jacobian = front.by_load * model_.slopes + front.by_advance;
      const FullPivotingLu factors(jacobian(free, free));
      if (!factors.is_invertible()) return false;
      Eigen::VectorXd move = Eigen::VectorXd::Zero(left.size());
      move(free) = -factors.solve(left(free));
      double part = 1;
      const auto moved = [&] { return Eigen::VectorXd((advances + part * move).cwiseMax(0)); };
      while (part > shortest_share && !(unmet_at(moved()).norm() < left.norm())) part /= 2;
      if (part <= shortest_share) return left.lpNorm<Eigen::Infinity>() < nearly * round_off;
      advances = moved();
      if (advances.maxCoeff() > longest) return false;
    }
    return false;
  }

  /// Follows da/dt = F.
  void relax(Eigen::VectorXd& advances) const {
    const double rate = 1 / (model_.slopes.cwiseAbs().rowwise().sum().maxCoeff() + mesh_error_);
    for (int k = 0; k < most_relaxations && advances.maxCoeff() < longest; ++k) {
      const Eigen::VectorXd left = unmet_at(advances);
      if (left.lpNorm<Eigen::Infinity>() < round_off) return;
      advances = (advances + rate * left).cwiseMax(0);
    }
  }

 private:
  FrontEquations equations(const Eigen::VectorXd& advances) const {
    return most_equal_front(model_.loads + model_.slopes * (advances - model_.at), advances, mesh_error_);
  }

  const LinearLoads& model_;
  double mesh_error_;
};

}  // namespace

std::optional<Eigen::VectorXd> linear_front(const LinearLoads& model, double mesh_error) {
  SPREKK_EXPECT(model.loads.size() == model.at.size(), model.loads.size(), model.at.size());
  SPREKK_EXPECT(model.slopes.rows() == model.loads.size() && model.slopes.cols() == model.loads.size(),
                model.slopes.rows(), model.slopes.cols());
  const Search search(model, mesh_error);
  Eigen::VectorXd advances = model.at.cwiseMax(0);
  if (search.newton(advances)) return advances;
  advances = model.at.cwiseMax(0);
  search.relax(advances);
  if (search.newton(advances)) return advances;
  return std::nullopt;
}

}  // namespace sprekk::fine_fracture
