// Walls whose friction depends on slip rate and state.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "components/contact/laws/rate_and_state.hpp"
#include "components/contact/laws/rate_and_state_options.hpp"
#include "components/contact/slip_events.hpp"
#include "framework/assembly/property.hpp"
#include "framework/assembly/tells_events.hpp"
#include "framework/scene/component.hpp"
#include "framework/schedule/limits_step.hpp"

namespace sprekk::contact {

/// Keeps the state theta and the slip rate V of every fracture cell, which follow from the traction and the jump of the
/// step by RateAndStateLaw; bounds steps by their slip, and records events.
class RateAndStateWalls {
 public:
  /// `here`: one flag a fracture cell, of those that the contact is on; none for all. Throws InputError where a
  /// friction f_0 is zero.
  RateAndStateWalls(const ComponentContext& context, const RateAndStateOptions& options, const Property& friction,
                    const std::vector<char>& here);

  /// Throws DataError where a friction f_0 is zero.
  void evaluate_data(const Property& friction) const;
  void begin_step(const StepTime& step, const SlippingWalls& walls) {
    step_ = step;
    events_.begin_step(walls);
  }
  /// Whether a step has begun. Before the first step there is no slip rate to solve for.
  bool has_step() const { return step_.dt > 0; }

  /// The traction of a cell under this trial traction and pressure, Pa, with the stiffness c, Pa/m.
  RateAndStateLaw::Returned returned(int cell, double friction, double trial, double pressure, double stiffness) const;
  /// Takes the slip rates, m/s, `dimension` − 1 of each cell, and lets states age.
  void set_slip_rates(Vector rates);
  double slip_rate(int cell) const;  ///< m/s, without its direction
  /// Whether a cell slips faster than V_0.
  bool slips(int cell) const { return slip_rate(cell) > options_.reference_rate; }

  /// Takes the shear modulus of the rock beside each fracture cell, Pa.
  void set_shear_modulus(const Vector& modulus) { shear_modulus_ = modulus; }

  /// The longest next step, s, for LimitsStep.
  double longest_step() const;
  /// For LimitsStep: whether the step was too long for the slip rates at its end, or for its slips (m), which are
  /// given.
  std::optional<StepTooLong> too_long(const Vector& slip, const StepTime& step) const;

  void accepted(const SlippingWalls& walls);
  void begin_events_anew(const SlippingWalls& walls) { events_.begin_anew(walls.slip); }
  void report(const std::string& name, const SlippingWalls& walls, std::vector<Quantity>& quantities) const;
  /// The event that ends with this step.
  std::vector<Event> events(const std::string& name, const SlippingWalls& walls) const;
  void output(std::vector<OutputField>& fields) const;
  void note_input(const std::string& name, Notes& notes) const;
  /// `traction`: Pa, (normal, tangential) of each cell.
  void note_step(const std::string& name, const Vector& traction, const SlippingWalls& walls, Notes& notes) const;
  void save(const std::string& name, std::map<std::string, Vector>& state) const;
  void restore(const std::string& name, const std::map<std::string, Vector>& state);
  void carry_over(const RateAndStateWalls& before) { events_.carry_over(before.events_); }

 private:
  RateAndStateLaw law(int cell, double friction) const;
  Vector rates_of_cells() const;
  SlipEvents::Step step_of_events(const SlippingWalls& walls) const;
  double shear_modulus(int cell) const { return shear_modulus_.size() > 0 ? shear_modulus_[cell] : 0.0; }

  const Mesh& mesh_;
  RateAndStateOptions options_;
  std::vector<char> here_;
  Vector a_, b_, distance_;  ///< of each cell; L in m
  Field& state_;             ///< theta, s
  Field& slip_rate_;         ///< V, m/s, along the tangents
  SlipEvents events_;
  StepTime step_;
  Vector shear_modulus_;  ///< Pa; empty before it is known
};

}  // namespace sprekk::contact
