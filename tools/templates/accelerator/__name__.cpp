// __type__: an accelerator of iterated schemes. A start for one of your own: here relaxation whose factor alternates.
#include <memory>

#include "framework/acceleration/registry.hpp"

namespace __name__ {

using namespace sprekk;

/// x + factor (G(x) − x), with one factor in the first, third, … pass of a time step, and another in those between.
class __Class__ : public Accelerator {
 public:
  __Class__(double odd, double even) : odd_(odd), even_(even) {}
  void begin(const Vector& /*scale*/) override { pass_ = 0; }
  void forget() override {}
  Vector next(const Vector& x, const Vector& image) override {
    const double factor = ++pass_ % 2 == 1 ? odd_ : even_;
    return x + factor * (image - x);
  }

 private:
  double odd_, even_;
  int pass_ = 0;
};

/// The parameters: what a scene writes under `accelerate: {__type__: {…}}`.
struct Options {
  double odd = 1, even = 1;
  Spec spec() {
    Spec spec("__type__", "Relaxation whose factor alternates.");
    spec.quantity("odd", odd, {.range = positive(), .doc = "Factor of odd passes.", .required = true});
    spec.quantity("even", even, {.range = positive(), .doc = "Factor of even passes.", .required = true});
    return spec;
  }
  std::unique_ptr<Accelerator> build() const { return std::make_unique<__Class__>(odd, even); }
};

const RegisterAccelerator<Options> registration("__type__");

}  // namespace __name__
