// __type__: how well a fracture conducts. A start for a law of your own: here walls that are mated badly, h = a/(1 +
// b/a).
#include <algorithm>
#include <memory>

#include "components/fracture_flow/laws/known_laws.hpp"

namespace __name__ {

using namespace sprekk;

/// h = a/(1 + b/a) of the aperture a: the transmissivity is h^3/12. Not below the lowest hydraulic aperture, m.
class __Class__ : public fracture_flow::HydraulicLaw {
 public:
  __Class__(double mismatch, double lowest) : mismatch_(mismatch), lowest_(lowest) {}
  fracture_flow::HydraulicAperture at(double aperture) const override {
    if (!(aperture > 0)) return {lowest_, 0};
    const double sum = aperture + mismatch_, value = aperture * aperture / sum;
    if (!(value >= lowest_)) return {lowest_, 0};
    return {value, value / aperture * (2 - aperture / sum)};
  }

 private:
  double mismatch_, lowest_;
};

/// The parameters: what a scene writes under `law: {type: __type__, __type__: {…}}`.
struct Options {
  double mismatch = 0;
  Spec spec() {
    Spec spec("__type__", "a^3/12/(1 + mismatch/a)^3 of walls that are mated badly");
    spec.quantity("mismatch", mismatch, {.unit = "m", .range = non_negative(), .doc = "b.", .required = true});
    return spec;
  }
  std::unique_ptr<fracture_flow::HydraulicLaw> build(double lowest) const {
    return std::make_unique<__Class__>(mismatch, lowest);
  }
};

const RegisterLaw<Options, fracture_flow::HydraulicLaw, double> registration(fracture_flow::hydraulic_laws(),
                                                                             "__type__");

}  // namespace __name__
