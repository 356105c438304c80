// __type__: how far walls approach each other under pressure. A start for a law of your own: here a semi-logarithmic
// one.
#include <cmath>
#include <memory>

#include "components/contact/laws/closure.hpp"

namespace __name__ {

using namespace sprekk;

/// length ln(1 + p/pressure) of the pressure p between the walls (Evans, Kohl, Hopkirk and Rybach 1992); linear below
/// zero.
class __Class__ : public contact::Closure {
 public:
  __Class__(double length, double pressure) : length_(length), pressure_(pressure) {}
  Value at(double pressure) const override {
    if (pressure < 0) return {length_ * pressure / pressure_, length_ / pressure_};
    return {length_ * std::log1p(pressure / pressure_), length_ / (pressure_ + pressure)};
  }

 private:
  double length_, pressure_;
};

/// The parameters: what a scene writes under `closure: {law: __type__, __type__: {…}}`.
struct Options {
  double length = 0, pressure = 0;
  Spec spec() {
    Spec spec("__type__", "length ln(1 + p/pressure)");
    spec.quantity("length", length,
                  {.unit = "m",
                   .range = non_negative(),
                   .doc = "Closure by a pressure that is e times as high.",
                   .required = true});
    spec.quantity(
        "pressure", pressure,
        {.unit = "Pa", .range = positive(), .doc = "Pressure from where on walls close slower.", .required = true});
    return spec;
  }
  std::unique_ptr<contact::Closure> build(const contact::NoInput&) const {
    return std::make_unique<__Class__>(length, pressure);
  }
};

const RegisterLaw<Options, contact::Closure, contact::NoInput> registration(contact::closure_laws(), "__type__");

}  // namespace __name__
