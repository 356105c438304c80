#include "framework/acceleration/secants.hpp"

#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <vector>

#include "framework/invariants.hpp"

namespace sprekk {

void SecantFilter::add_to(Spec& spec) {
  spec.choice("filter", kind,
              {{"qr2", "by what is left of a difference, against its own size"},
               {"qr1", "by what is left of a difference, against the size of all"},
               {"none", "keeps all but round-off"}},
              {.doc = "How differences are left out that newer ones make superfluous."});
  spec.quantity("filter_limit", limit, {.range = strictly_between(0, 1), .doc = "Smaller shares are left out."});
}

FilteredSecants filtered(const Secants& secants, const SecantFilter& filter) {
  constexpr double round_off = 16 * std::numeric_limits<double>::epsilon();  // of a difference: newer ones span it
  const int count = static_cast<int>(secants.of_residual.size());
  const Eigen::Index size = count > 0 ? secants.of_residual.front().size() : 0;
  double square = 0;
  for (const Vector& column : secants.of_residual) square += column.squaredNorm();
  const double whole = std::sqrt(square);
  FilteredSecants kept;
  kept.q.resize(size, count);
  kept.r = Eigen::MatrixXd::Zero(count, count);
  std::vector<int> chosen;
  for (int j = 0; j < count; ++j) {
    const int k = static_cast<int>(chosen.size());
    Vector left = secants.of_residual[j];
    const double own = left.norm();
    Vector along = Vector::Zero(k);
    for (int time = 0; time < 2; ++time) {  // twice is enough (Giraud, Langou, Rozloznik 2005)
      const Vector share = kept.q.leftCols(k).transpose() * left;
      left -= kept.q.leftCols(k) * share;
      along += share;
    }
    const double rest = left.norm();
    const double limit = filter.kind == "qr1" ? filter.limit * whole : filter.kind == "qr2" ? filter.limit * own : 0;
    if (k == size || !(rest > limit) || !(rest > round_off * own)) continue;
    kept.q.col(k) = left / rest;
    kept.r.col(k).head(k) = along;
    kept.r(k, k) = rest;
    chosen.push_back(j);
  }
  const int k = static_cast<int>(chosen.size());
  kept.q.conservativeResize(size, k);
  kept.r.conservativeResize(k, k);
  kept.of_image.resize(size, k);
  kept.of_residual.resize(size, k);
  for (int i = 0; i < k; ++i) {
    kept.of_image.col(i) = secants.of_image[chosen[i]];
    kept.of_residual.col(i) = secants.of_residual[chosen[i]];
  }
  return kept;
}

Vector FilteredSecants::weights(const Vector& residual) const {
  return r.triangularView<Eigen::Upper>().solve(q.transpose() * residual);
}

Eigen::MatrixXd FilteredSecants::pseudo_inverse() const {
  return r.triangularView<Eigen::Upper>().solve(q.transpose());
}

void SecantsOfPasses::begin() {
  secants_ = {};
  last_residual_.resize(0);
}

void SecantsOfPasses::add(const Vector& residual, const Vector& image) {
  SPREKK_EXPECT(residual.size() == image.size(), residual.size(), image.size());
  SPREKK_EXPECT(is_finite(residual) && is_finite(image));
  if (last_residual_.size() == residual.size()) {
    secants_.of_residual.push_front(residual - last_residual_);
    secants_.of_image.push_front(image - last_image_);
  }
  last_residual_ = residual;
  last_image_ = image;
}

}  // namespace sprekk
