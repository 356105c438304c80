// constant: relaxation with one factor.
#include "framework/acceleration/registry.hpp"

namespace sprekk {

namespace {

/// x + factor (G(x) − x).
class Constant : public Accelerator {
 public:
  explicit Constant(double factor) : factor_(factor) {}
  void begin(const Vector&) override {}
  void forget() override {}
  Vector next(const Vector& x, const Vector& image) override { return x + factor_ * (image - x); }

 private:
  double factor_;
};

struct ConstantOptions {
  double factor = 1;
  Spec spec() {
    Spec spec("constant", "Relaxation: each pass goes the same share of its way, or beyond it.");
    spec.quantity("factor", factor,
                  {.range = strictly_between(0, 2), .doc = "The share; 1 is the plain iteration.", .required = true});
    return spec;
  }
  std::unique_ptr<Accelerator> build() const { return std::make_unique<Constant>(factor); }
};

const RegisterAccelerator<ConstantOptions> registration("constant");

}  // namespace

}  // namespace sprekk
