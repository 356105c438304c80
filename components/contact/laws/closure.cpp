#include "components/contact/laws/closure.hpp"

#include <memory>

#include "components/capabilities/usual_ranges.hpp"
#include "components/contact/laws/closure_options.hpp"
#include "components/contact/laws/formulas.hpp"
#include "framework/config/state.hpp"

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

ClosureLaws& closure_laws() {
  static ClosureLaws registered(
      {{"hard", "not at all"},
       {"linear", "closure = pressure/stiffness"},
       {"barton_bandis",
        "pressure = stiffness c/(1 - c/largest), with the closure c (Bandis, Lumsden and Barton 1983)"},
       {"formula", "the formula given as `closure`"}});
  return registered;
}

namespace {

const RegisterLawKind kind_of_closure({"closure", "closure: {law: NAME}", [] { return closure_laws().names(); }});

}  // namespace

Spec ClosureOptions::spec() {
  Spec spec("closure", "How far walls in contact approach each other under pressure.");
  spec.choice("law", law, closure_laws().names(),
              {.doc = "The law. Closure counts from zero pressure, where the fracture has its initial aperture: a "
                      "fracture under pressure begins narrower than that."});
  spec.quantity("stiffness", stiffness,
                {.unit = "Pa/m", .range = non_negative(), .doc = "Normal stiffness of the joint at zero pressure."});
  usually(spec, "stiffness", usual_joint_stiffness());
  spec.quantity("largest", largest,
                {.unit = "m",
                 .range = non_negative(),
                 .doc = "The closure that is not passed, whatever the pressure (barton_bandis)."});
  spec.data("closure", formula,
            {.unit = "m",
             .range = non_negative(),
             .doc = "The closure by a formula. Below zero pressure it goes on linearly."});
  may_be_formula(spec.name(), "closure", closure_variables());
  registered.add_sections(spec, closure_laws());
  spec.check([this](const Node& node) {
    registered.check(node, law, "law");
    const bool is_linear = law == "linear", is_barton_bandis = law == "barton_bandis";
    if ((is_linear || is_barton_bandis) && stiffness == 0)
      throw InputError(node.origin, "'stiffness' is missing", "walls close by the law '" + law + "'",
                       "give it in Pa/m, for example 100 GPa/m");
    if (!is_linear && !is_barton_bandis && stiffness > 0)
      throw InputError(node.origin, "'stiffness' has no effect",
                       law == "hard" ? "the walls are hard" : "the law '" + law + "' has parameters of its own",
                       "set law: linear, or remove it");
    if (is_barton_bandis && largest == 0)
      throw InputError(node.origin, "'largest' is missing", "the law of Barton and Bandis has a largest closure",
                       "give it in m, below the initial aperture of the fracture");
    if ((law == "formula") != formula.has_value())
      throw InputError(node.origin, formula ? "'closure' has no effect" : "'closure' is missing",
                       "the law is '" + law + "'",
                       formula ? "set law: formula, or remove it" : "give its formula in m");
    if (!is_barton_bandis && largest > 0)
      throw InputError(node.origin, "'largest' has no effect", "the law '" + law + "' has no largest closure",
                       "set law: barton_bandis, or remove it");
  });
  return spec;
}

std::unique_ptr<Closure> ClosureOptions::build() const {
  if (law == "linear") return std::make_unique<Linear>(stiffness);
  if (law == "barton_bandis") return std::make_unique<BartonBandis>(stiffness, largest);
  return registered.build(law, {});
}

}  // namespace sprekk::contact
