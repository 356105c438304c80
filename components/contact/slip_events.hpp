// Events: times at which walls slip fast.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "framework/scene/component.hpp"

namespace sprekk::contact {

/// Records the events of a run. One begins with the first step at whose end a fracture cell slips faster than a rate,
/// and lasts until the end of the first step at whose end none does. The slip of all steps of the event counts, of slow
/// cells, too.
class SlipEvents {
 public:
  /// A time step, with values of each fracture cell.
  struct Step {
    double start, end;     ///< s
    Vector slip;           ///< m, `dimension` − 1 of each cell, at the end
    Vector slip_rate;      ///< m/s, at the end
    Vector shear_modulus;  ///< Pa; empty where it is not known
  };
  /// The latest event: the current one up to now, or the last one that has ended.
  struct Event {
    bool goes_on = false;
    double count = 0;           ///< events that have begun
    double begin = 0;           ///< s
    double end = 0;             ///< s, the end of its last step so far
    double moment = 0;          ///< N m per m of depth, sum of G |slip| |cell|
    double length = 0;          ///< m, of the cells that have slipped faster than the rate
    double peak_slip_rate = 0;  ///< m/s
  };

  /// `rate`: the slip rate above which an event begins, m/s.
  SlipEvents(const ComponentContext& context, double rate);

  /// The latest event at the end of this step, which begins where the last accepted one has ended.
  Event after(const Step& step) const;
  const Event& latest() const { return latest_; }
  /// To be called when the step has been accepted.
  void accept(const Step& step);
  static void report(const std::string& name, const Event& event, std::vector<Quantity>& quantities);

  /// Save and restore the state that has no place on the mesh.
  void save(const std::string& name, std::map<std::string, Vector>& state) const;
  void restore(const std::string& name, const std::map<std::string, Vector>& state);
  void carry_over(const SlipEvents& before) { latest_ = before.latest_; }

 private:
  /// The greatest slip rate of each cell in the event, m/s, with this step.
  Vector peaks_after(const Step& step) const;

  const Mesh& mesh_;
  double rate_;         ///< m/s
  Field& slip_before_;  ///< m, slip before the current event
  Field& peak_rate_;    ///< m/s, greatest in the current event
  Event latest_;
};

}  // namespace sprekk::contact
