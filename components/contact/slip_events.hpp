// Events: times at which walls slip fast.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "components/contact/rupture.hpp"
#include "framework/scene/component.hpp"

namespace sprekk::contact {

/// Slip and shear traction of each fracture cell in a step.
struct SlippingWalls {
  Vector slip;                 ///< m, `dimension` − 1 of each cell, at the end
  Vector shear_before, shear;  ///< Pa, size of the traction at the start and at the end
};

/// Records the events of a run. One begins with the first step at whose end a fracture cell slips faster than a rate,
/// and lasts until the end of the first step at whose end none does. The slip of an event is that of all cells, slow
/// ones too, in all of its steps.
class SlipEvents {
 public:
  /// A time step, with values of each fracture cell.
  struct Step {
    double start, end;  ///< s
    SlippingWalls walls;
    Vector slip_rate;      ///< m/s, at the end
    Vector shear_modulus;  ///< Pa; empty where it is not known
  };
  /// The latest event: the current one up to now, or the last one that has ended.
  struct Event {
    bool goes_on = false;
    double count = 0;           ///< events that have begun
    double begin = 0;           ///< s
    double end = 0;             ///< s, the end of its last step so far
    double peak_slip_rate = 0;  ///< m/s
    Rupture rupture;            ///< cells that have slipped faster than the rate take part
  };

  /// `rate`: the slip rate above which an event begins, m/s.
  SlipEvents(const ComponentContext& context, double rate);

  /// To be called at the start of a step.
  void begin_step(const SlippingWalls& walls);
  /// The latest event at the end of this step. The step begins where the last accepted one has ended.
  Event after(const Step& step) const;
  const Event& latest() const { return latest_; }
  /// Whether the event ends with this step.
  bool ends_with(const Step& step) const { return latest_.goes_on && !after(step).goes_on; }
  /// To be called when the step has been accepted.
  void accept(const Step& step);
  /// To be called at the start from another run: forgets its events. An event that is under way begins with the first
  /// step. `slip`: m, of each cell, at the start.
  void begin_anew(const Vector& slip);
  static void report(const std::string& name, const Event& event, std::vector<Quantity>& quantities);

  /// Save and restore the state that has no place on the mesh. `restore` throws InputError where this is missing or
  /// damaged.
  void save(const std::string& name, std::map<std::string, Vector>& state) const;
  void restore(const std::string& name, const std::map<std::string, Vector>& state);
  void carry_over(const SlipEvents& before) { latest_ = before.latest_; }

 private:
  /// The greatest slip rate of each cell in the event, m/s, with this step.
  Vector peaks_after(const Step& step) const;

  const Mesh& mesh_;
  double rate_;          ///< m/s
  Field& slip_before_;   ///< m, slip before the current event
  Field& shear_before_;  ///< Pa, size of the shear traction before the current, or the last, event
  Field& peak_rate_;     ///< m/s, greatest in the current event
  Event latest_;
};

}  // namespace sprekk::contact
