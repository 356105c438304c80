// A front of tips with stress intensity factors in closed form.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "components/fine_fracture/growth/front.hpp"
#include "components/fine_fracture/growth/mixed_mode.hpp"

namespace sprekk::fine_fracture {

/// Tips with K = K_IC exp(rise - own (s_i - c_i) - shared sum_j (s_j - c_j)), K² = K_I² + K_II², whose right direction
/// turns with their length. K does not depend on the direction.
struct ClosedForm {
  std::vector<double> rise;
  std::vector<FrontTip> tips;
  double own = 20, shared = 30;  ///< 1/m
  double turn = 8;               ///< rad/m

  std::vector<FrontState> states(const std::vector<double>& lengths, const std::vector<double>& angles) const {
    double sum = 0;
    for (std::size_t i = 0; i < tips.size(); ++i) sum += lengths[i] - tips[i].covered;
    std::vector<FrontState> states;
    for (std::size_t i = 0; i < tips.size(); ++i) {
      const double added = lengths[i] - tips[i].covered, wrong = angles[i] - tips[i].angle - turn * added;
      FrontState state;
      const double k = tips[i].toughness * std::exp(rise[i] - own * added - shared * sum);
      state.sifs = {k * std::cos(0.7 * wrong), k * std::sin(0.7 * wrong), -1e6};
      state.load = equivalent_sif(state.sifs) / tips[i].toughness;
      states.push_back(state);
    }
    return states;
  }
  std::vector<FrontState> without_growth() const {
    std::vector<double> lengths, angles;
    for (const FrontTip& tip : tips) lengths.push_back(tip.covered), angles.push_back(tip.angle);
    return states(lengths, angles);
  }
  Front solved(const FrontOptions& options, const Eigen::MatrixXd& slopes = {}) const {
    Front front(tips, without_growth(), options, 3600, slopes);
    while (front.verdict() == Front::Verdict::again) {
      std::vector<double> lengths, angles;
      for (int i = 0; i < static_cast<int>(tips.size()); ++i) {
        lengths.push_back(front.length(i));
        angles.push_back(front.angle(i));
      }
      front.learn(states(lengths, angles));
    }
    return front;
  }
};

inline FrontOptions options() {
  FrontOptions options;
  options.increment = 0.01;
  options.shortest = 1e-4;
  return options;
}

/// Each K is the toughness, as if the mesh had no error.
inline FrontOptions exact() {
  FrontOptions exact = options();
  exact.mesh_error = 0;
  return exact;
}

inline FrontTip tip(double angle) {
  FrontTip tip;
  tip.covered = 0.008;
  tip.angle = tip.ahead = angle;
  tip.toughness = 7e5;
  tip.longest = tip.covered + 0.015;
  return tip;
}

}  // namespace sprekk::fine_fracture
