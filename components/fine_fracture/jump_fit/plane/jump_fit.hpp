// Tips whose stress intensity factors follow from the displacement jumps of the coarse level, without a fine level.
#pragma once

#include <string>
#include <vector>

#include "components/capabilities/fracture_tips.hpp"
#include "components/fine_fracture/jump_fit/options.hpp"
#include "components/fine_fracture/jump_fit/plane/factors_from_jumps.hpp"
#include "components/fine_fracture/tips/ends.hpp"
#include "framework/scene/component.hpp"
#include "framework/schedule/growing.hpp"

namespace sprekk::fine_fracture {

/// The component of tips that stay where they are: factors of each state, from that state alone.
class JumpFit : public Component, public FractureTips, public NotGrowing {
 public:
  JumpFit(const ComponentContext& context, const JumpFitOptions& options);

  void begin_step(const StepTime&) override { has_begun_ = true; }
  void assemble(Assembly&, const StepTime&) const override {}
  void report(std::vector<Quantity>& quantities) const override;
  void note_input(Notes& notes) const override;
  void note_step(Notes& notes, const StepTime& step) const override;

  /// Throws InputError for a rock whose jumps next to tips are wrong on each mesh.
  void accept_surroundings(TipSurroundings& surroundings) override;
  std::string why_no_growth() const override;

 private:
  struct Tip {
    TipEnd end;
    std::string name;
  };
  FittedFactors factors_of(const Tip& tip) const;

  const Mesh& mesh_;
  Origin origin_;
  JumpFitOptions options_;
  TipSurroundings* surroundings_ = nullptr;
  std::vector<Tip> tips_;
  bool has_begun_ = false;  ///< the first step: before it the rock has no stiffness
};

}  // namespace sprekk::fine_fracture
