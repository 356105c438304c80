#include "components/contact/laws/closure.hpp"

namespace sprekk::contact {

namespace {

/// closure = pressure/stiffness.
class Linear : public Closure {
 public:
  explicit Linear(double stiffness) : compliance_(1 / stiffness) {}
  Value at(double pressure) const override { return {pressure * compliance_, compliance_}; }

 private:
  double compliance_;
};

/// pressure = k_0 c/(1 − c/c_max), solved for the closure c: c = p c_max/(k_0 c_max + p). Bandis, Lumsden and Barton,
/// Int. J. Rock Mech. Min. Sci. 20 (1983) 249, Eq. 8.
class BartonBandis : public Closure {
 public:
  BartonBandis(double stiffness, double largest) : stiffness_(stiffness), largest_(largest) {}
  Value at(double pressure) const override {
    if (pressure < 0) return {pressure / stiffness_, 1 / stiffness_};
    const double sum = stiffness_ * largest_ + pressure;
    return {pressure * largest_ / sum, stiffness_ * largest_ * largest_ / (sum * sum)};
  }

 private:
  double stiffness_, largest_;
};

}  // namespace

Spec ClosureOptions::spec() {
  Spec spec("closure", "How far walls in contact approach each other under pressure.");
  spec.choice("law", law,
              {{"hard", "not at all"},
               {"linear", "closure = pressure/stiffness"},
               {"barton_bandis",
                "pressure = stiffness c/(1 - c/largest), with the closure c (Bandis, Lumsden and Barton 1983)"}},
              {.doc = "The law. Closure counts from zero pressure, where the fracture has its initial aperture: a "
                      "fracture under pressure begins narrower than that."});
  spec.quantity("stiffness", stiffness,
                {.unit = "Pa/m", .range = non_negative(), .doc = "Normal stiffness of the joint at zero pressure."});
  spec.quantity("largest", largest,
                {.unit = "m",
                 .range = non_negative(),
                 .doc = "The closure that is not passed, whatever the pressure (barton_bandis)."});
  spec.check([this](const Node& node) {
    if (law != "hard" && stiffness == 0)
      throw InputError(node.origin, "'stiffness' is missing", "walls close by the law '" + law + "'",
                       "give it in Pa/m, for example 100 GPa/m");
    if (law == "hard" && stiffness > 0)
      throw InputError(node.origin, "'stiffness' has no effect", "the walls are hard", "set law: linear, or remove it");
    if (law == "barton_bandis" && largest == 0)
      throw InputError(node.origin, "'largest' is missing", "the law of Barton and Bandis has a largest closure",
                       "give it in m, below the initial aperture of the fracture");
    if (law != "barton_bandis" && largest > 0)
      throw InputError(node.origin, "'largest' has no effect", "the law '" + law + "' has no largest closure",
                       "set law: barton_bandis, or remove it");
  });
  return spec;
}

std::unique_ptr<Closure> ClosureOptions::build() const {
  if (law == "linear") return std::make_unique<Linear>(stiffness);
  if (law == "barton_bandis") return std::make_unique<BartonBandis>(stiffness, largest);
  return nullptr;
}

}  // namespace sprekk::contact
