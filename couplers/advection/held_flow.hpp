// The rates of fluid for transport, also while the flow is held.
#pragma once

#include <functional>
#include <map>
#include <string>

#include "components/capabilities/fluid_fluxes.hpp"
#include "components/capabilities/fracture_fluid.hpp"
#include "components/capabilities/matrix_fluid.hpp"
#include "components/capabilities/wells.hpp"
#include "couplers/advection/flow_course.hpp"
#include "couplers/advection/streams.hpp"
#include "framework/scene/component.hpp"

namespace sprekk::couplers {

/// The flow for transport. Each member may be missing.
struct CarryingFlow {
  const MatrixFluxes* matrix = nullptr;  ///< if something is carried in the rock
  const Field* pressure_in_rock = nullptr;
  MatrixWalls* walls = nullptr;
  const FractureFluxes* fracture = nullptr;
  const WellPressures* wells = nullptr;
};

/// If the flow is solved together with the transport, its rates are the present ones. If it is held, they are those of
/// its solution for the time of the step (FlowCourse), or, if there is none yet, of its last solution. They are not
/// computed again from the held pressures: with the data of a new step (another viscosity or prescribed pressure) these
/// give fluxes that do not balance, and cells would gain or lose many times their fluid.
class HeldFlow {
 public:
  HeldFlow(const CouplerContext& context, const CarryingFlow& flow);

  /// The fields on which rates depend.
  std::vector<const Field*> fields() const;
  /// Whether the flow has been solved at all; the fluxes of initial values do not count.
  bool has_flowed() const { return has_flowed_; }
  /// Whether the flow was solved before the run began (for a settled start).
  void begin(bool with_flow) { has_flowed_ = had_flowed_ = with_flow; }
  /// Whether a field is solved for together with the transport.
  using IsSolved = std::function<bool(const Field&)>;
  /// To be called after each solve.
  void take(const IsSolved& is_solved, const StepTime& step);
  /// The rates in a step.
  FlowRates rates(const IsSolved& is_solved, const StepTime& step) const;
  /// Through each face of the rock, out of face_cells[f][0], m^2/s (in space m^3/s). To be called after
  /// Part::begin_step of all parts.
  Vector fluxes_in_rock(const IsSolved& is_solved, const StepTime& step) const;

  /// The same at the last solution of the flow; nullptr if there is none on this mesh.
  const Vector* last_fluxes_in_rock() const { return is_taken_ ? &flux_->now() : nullptr; }

  /// On another mesh fluxes are those of the pressures that have been found there, until the flow is solved again.
  void carry_over(const HeldFlow& before);
  void accepted();
  void rewound();
  void save(std::map<std::string, Vector>& state) const;
  void restore(const std::map<std::string, Vector>& state);

 private:
  /// nullptr if nothing passes the walls; known when all couplers have been built.
  const Field* wall_flux() const;

  const Mesh* mesh_;
  std::string name_;
  CarryingFlow flow_;
  /// Through each face of the rock as last solved, m^2/s (in space m^3/s); with a flow in the rock.
  Field* flux_ = nullptr;
  FlowCourse in_rock_, through_walls_, in_fractures_, of_wells_;
  bool is_taken_ = false, was_taken_ = false;     // whether flux_ is known, now and when the last step was accepted
  bool has_flowed_ = false, had_flowed_ = false;  // the same
};

}  // namespace sprekk::couplers
