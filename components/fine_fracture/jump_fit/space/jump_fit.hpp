// Fronts of fractures whose stress intensity factors follow from the displacement jumps behind them.
#pragma once

#include <string>
#include <vector>

#include "components/capabilities/jumps_of_walls.hpp"
#include "components/fine_fracture/jump_fit/space/front_fit.hpp"
#include "framework/scene/component.hpp"
#include "framework/schedule/growing.hpp"

namespace sprekk::fine_fracture {

/// The component of fronts that stay where they are: factors of each state, from that state alone.
class FrontJumpFit : public Component, public FractureFronts, public NotGrowing {
 public:
  FrontJumpFit(const ComponentContext& context, const JumpFitOptions& options);

  void begin_step(const StepTime&) override { has_begun_ = true; }
  void assemble(Assembly&, const StepTime&) const override {}
  bool allows_stages() const override { return true; }
  void report(std::vector<Quantity>& quantities) const override;
  void output(std::vector<OutputField>& fields) const override;
  void note_input(Notes& notes) const override;
  void note_step(Notes& notes, const StepTime& step) const override;

  /// Throws InputError for a rock whose jumps next to fronts are wrong on each mesh.
  void accept_jumps(JumpsOfWalls& jumps) override;
  std::string why_no_growth() const override;

 private:
  /// Pa sqrt(m); `error`: by how much they change in a strip that is one cell size shorter; NaN where that gives none.
  struct Factors {
    double k1, k2, k3, error;
    double release;  ///< J/m^2
  };
  std::vector<Factors> factors() const;  ///< of all places

  const Mesh& mesh_;
  Origin origin_;
  std::vector<FrontPlace> places_;
  JumpsOfWalls* jumps_ = nullptr;
  bool has_begun_ = false;  ///< whether the first step has begun: before it the rock has no stiffness
};

}  // namespace sprekk::fine_fracture
