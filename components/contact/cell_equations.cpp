#include "components/contact/cell_equations.hpp"

#include <algorithm>

#include "components/contact/tangents.hpp"
#include "components/contact/trial_state.hpp"
#include "framework/invariants.hpp"
#include "framework/matrix_of.hpp"

namespace sprekk::contact {

CellEquations equations_of(const Trial& t, const Point& traction, const CellSettings& settings) {
  SPREKK_EXPECT(settings.normal_stiffness > 0 && settings.tangential_stiffness > 0, settings.normal_stiffness,
                settings.tangential_stiffness);
  const double f_n = traction[0], c_n = settings.normal_stiffness, c_t = settings.tangential_stiffness;
  const double gap_by_f = t.gap_by_traction - settings.normal_compliance;
  const TangentialVector f_t = traction.tail<tangents>();
  CellEquations equations;
  Point& own = equations.residual;
  Tensor &by_f = equations.by_traction, &by_u = equations.by_jump;
  if (t.is_open() && !settings.weakens && !t.at_rate) {
    own << f_n / c_n, f_t / c_t;
    by_f.diagonal().setConstant(1 / c_t);
    by_f(0, 0) = 1 / c_n;
  } else {
    using Row = Eigen::Matrix<double, 1, dimension>;
    const ReturnedTraction<tangents> returned = t.at_rate ? t.at_rate->traction : return_to_cone<tangents>(t);
    Row gap_by_u;
    gap_by_u << 1, -t.slip_direction.transpose() * t.dilation;
    const auto gap_by_t = gap_by_u.template tail<tangents>();
    auto by_f_t = by_f.bottomRightCorner<tangents, tangents>();
    own[0] = t.is_open() ? (f_n - t.tension) / c_n : -t.gap;
    own.template tail<tangents>() = (f_t - returned.tangential) / c_t;
    if (t.is_open()) {
      by_f(0, 0) = 1 / c_n;
    } else {
      by_f(0, 0) = -gap_by_f;
      by_u.row(0) = -gap_by_u;
    }
    by_u.bottomRightCorner<tangents, tangents>() = -returned.by_trial;
    by_f_t.setIdentity();
    by_f_t -= (1 - c_t * settings.tangential_compliance) * returned.by_trial;
    by_f_t /= c_t;
    if (t.normal <= 0 && (t.at_rate || !t.sticks())) {
      const TangentialVector by_normal =
          (t.at_rate ? t.at_rate->by_pressure : TangentialVector(returned.by_bound * t.bound_by_pressure)) / c_t;
      by_f.bottomLeftCorner<tangents, 1>() = by_normal * (1 + c_n * gap_by_f);
      by_u.bottomLeftCorner<tangents, 1>() = by_normal * c_n;
      by_u.bottomRightCorner<tangents, tangents>() += by_normal * c_n * gap_by_t;
    }
    if (settings.weakens) {
      // What weakens along the path: the tensile strength in the normal row, the bound in the tangential ones.
      Row path_by_u = t.path_by_gap * gap_by_u;
      path_by_u.template tail<tangents>() += t.path_by_slip.transpose();
      const double path_by_f = t.path_by_gap * t.gap_by_traction;
      if (t.is_open()) {
        by_f(0, 0) -= t.strength.tension_by_path * path_by_f / c_n;
        by_u.row(0) -= t.strength.tension_by_path * path_by_u / c_n;
      }
      if (!t.sticks()) {
        const double by_path = t.strength.cohesion_by_path - t.strength.friction_by_path * std::min(0.0, t.normal);
        by_f.bottomLeftCorner<tangents, 1>() -= returned.by_bound * by_path * path_by_f / c_t;
        by_u.bottomRows<tangents>() -= returned.by_bound * by_path * path_by_u / c_t;
        by_u.bottomRightCorner<tangents, tangents>() -= returned.by_bound * t.bound_by_slip.transpose() / c_t;
      }
    }
  }
  return equations;
}

SparseMatrix block_diagonal(const CellBlocks& blocks, Pattern pattern) {
  std::vector<Triplet> entries;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const int row = dimension * static_cast<int>(i);
    for (int k = 0; k < dimension; ++k)
      for (int l = 0; l < dimension; ++l)
        if (pattern == Pattern::full || k > 0 || l == 0) entries.emplace_back(row + k, row + l, blocks[i](k, l));
  }
  const auto rows = static_cast<int>(dimension * blocks.size());
  return matrix_of(rows, rows, entries);
}

}  // namespace sprekk::contact
