// aitken: relaxation with a factor from the last two passes.
#include <algorithm>
#include <cmath>

#include "framework/acceleration/registry.hpp"

namespace sprekk {

namespace {

/// x + ω r with r = G(x) − x and ω_k = −ω_(k−1) r_(k−1)·(r_k − r_(k−1)) / |r_k − r_(k−1)|²; the absolute value of ω_k
/// is kept within bounds (Küttler and Wall, Comput. Mech. 43 (2008) 61, Eq. 44).
class Aitken : public Accelerator {
 public:
  Aitken(double first, double least, double most) : first_(first), least_(least), most_(most) {}
  void begin(const Vector&) override { forget(); }
  void forget() override { last_.resize(0); }
  Vector next(const Vector& x, const Vector& image) override {
    const Vector residual = image - x;
    if (last_.size() != residual.size()) {
      factor_ = first_;
    } else {
      const Vector difference = residual - last_;
      const double square = difference.squaredNorm();
      if (square > 0) factor_ *= -last_.dot(difference) / square;
      factor_ = std::copysign(std::clamp(std::abs(factor_), least_, most_), factor_);
    }
    last_ = residual;
    return x + factor_ * residual;
  }

 private:
  double first_, least_, most_, factor_ = 1;
  Vector last_;  ///< residual of the pass before
};

constexpr double smallest_factor = 1e-3;  // least size of the factor

struct AitkenOptions {
  double first = 0.5;
  double least = smallest_factor;
  double most = 100;
  Spec spec() {
    Spec spec("aitken", "Relaxation by Aitken's rule: one factor for all fields, from the last two passes.");
    spec.quantity("first", first, {.range = positive(), .doc = "Factor of the first pass of a step."});
    spec.quantity("least", least, {.range = positive(), .doc = "Least size of the factor."});
    spec.quantity("most", most, {.range = positive(), .doc = "Largest size of the factor."});
    spec.check([this](const Node& node) {
      if (least > most)
        throw InputError(node.origin, "'least' is larger than 'most'", "no factor is within these bounds",
                         "exchange them");
    });
    return spec;
  }
  std::unique_ptr<Accelerator> build() const { return std::make_unique<Aitken>(first, least, most); }
};

const RegisterAccelerator<AitkenOptions> registration("aitken");

}  // namespace

}  // namespace sprekk
