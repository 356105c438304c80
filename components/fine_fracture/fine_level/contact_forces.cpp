#include "components/fine_fracture/fine_level/contact_forces.hpp"

#include <vector>

#include "framework/dense/lu.hpp"
#include "framework/schedule/growing.hpp"

namespace sprekk::fine_fracture {

Vector contact_forces(const Eigen::MatrixXd& compliance, const Vector& gaps) {
  // Rounds: Newton's method takes some ten; then one wall changes at a time.
  constexpr int at_once = 30, most_rounds = 2000;
  std::vector<char> touches(gaps.size(), 1);
  for (int round = 0; round < most_rounds; ++round) {
    std::vector<Eigen::Index> closed;
    for (Eigen::Index i = 0; i < gaps.size(); ++i)
      if (touches[i]) closed.push_back(i);
    Vector f = Vector::Zero(gaps.size());
    if (!closed.empty()) {
      const Eigen::MatrixXd matrix = compliance(closed, closed);
      const Vector right = -gaps(closed);
      f(closed) = DenseLu(matrix).solve(right);
    }
    const Vector gap = gaps + compliance * f;
    bool is_found = true;
    for (Eigen::Index i = 0; i < gaps.size() && (is_found || round < at_once); ++i) {
      const bool next = touches[i] ? f[i] <= 0 : gap[i] < 0;
      if (next == static_cast<bool>(touches[i])) continue;
      is_found = false;
      touches[i] = next;
    }
    if (is_found) return f;
  }
  throw UnsolvedGrowth("fine level: no state of contact was found on the walls beside a kink");
}

}  // namespace sprekk::fine_fracture
