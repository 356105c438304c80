// What interface quasi-Newton methods share: the differences of one iteration, and their options.
#pragma once

#include "framework/acceleration/accelerator.hpp"
#include "framework/acceleration/secants.hpp"

namespace sprekk {

/// Parameters of an interface quasi-Newton method.
struct QuasiNewtonOptions {
  int columns = 100;  ///< differences that are used at most
  double first = 1;   ///< relaxation of a pass that knows nothing
  SecantFilter filter;
  /// `which`: which differences `columns` counts.
  void add_to(Spec& spec, const std::string& which) {
    spec.integer("columns", columns, {.range = between(1, 10000), .doc = which + " that are used at most."});
    spec.quantity("first", first,
                  {.range = strictly_between(0, 2), .doc = "Relaxation of a pass that knows no differences yet."});
    filter.add_to(spec);
  }
  FilteredSecants chosen(Secants secants) const {
    if (static_cast<int>(secants.of_residual.size()) > columns) {
      secants.of_residual.resize(columns);
      secants.of_image.resize(columns);
    }
    return filtered(secants, filter);
  }
};

/// An accelerator that learns from the differences of the passes of one iteration, and keeps something of them for
/// later time steps.
class QuasiNewton : public Accelerator {
 public:
  void begin(const Vector& scale) override {
    scale_ = scale;
    passes_.begin();
  }
  void forget() override { passes_.begin(); }
  void rewound() override { passes_.begin(); }

 protected:
  Vector scale_;
  SecantsOfPasses passes_;
};

}  // namespace sprekk
