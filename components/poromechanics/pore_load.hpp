// A pore pressure that loads the rock, whatever discretizes the stress.
#pragma once

#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "framework/assembly/counts_from_here.hpp"
#include "framework/field/field.hpp"

namespace sprekk::poromechanics {

/// A pressure p, Pa, that adds -alpha (p - p_0) I to the stress. One value a cell each.
struct PoreLoad {
  const Field* pressure;
  Vector alpha;                     ///< Biot coefficients; zero in cells that are taken away
  Vector reference;                 ///< p_0, Pa
  Vector given = {};                ///< Biot coefficients of all cells
  std::uint64_t alpha_version = 1;  ///< changes with alpha
  bool is_settled = false;          ///< whether p_0 is that of a settled state, and not the initial one
  bool follows_stiffness = false;   ///< whether alpha is in proportion to a stiffness that follows the state
  Vector ratio = {};                ///< then: present over initial stiffness, one a cell; empty: 1

  /// Gives other Biot coefficients.
  void change_alpha(Vector of_rock) {
    alpha = std::move(of_rock);
    ++alpha_version;
  }
  Vector present_alpha() const { return ratio.size() > 0 ? Vector(alpha.cwiseProduct(ratio)) : alpha; }
  /// alpha (p - p_0) with the present pressure, Pa.
  Vector stress() const { return present_alpha().cwiseProduct(pressure->now() - reference); }
};

/// The stress belongs to the pressures of a state that has been settled: to all where the displacement was, and to
/// those that were where the rock was held.
inline void count_loads_from_here(const SettledFields& settled, const Field& displacement,
                                  std::vector<PoreLoad>& loads) {
  for (PoreLoad& load : loads) {
    if (!settled.contain(displacement) && !settled.contain(*load.pressure)) continue;
    load.reference = load.pressure->now();
    load.is_settled = true;
  }
}

inline bool has_settled_loads(const std::vector<PoreLoad>& loads) {
  return std::ranges::any_of(loads, &PoreLoad::is_settled);
}

/// The name of the references of settled, or of initial, states among the values of the component `name`.
inline std::string key_of_reference(const std::string& name, const PoreLoad& load, bool is_settled) {
  return name + (is_settled ? ".settled." : ".reference.") + load.pressure->name();
}

/// References for checkpoints, also initial ones: a run that begins with this state counts from them, although what
/// gives the pressure may have another value at its start.
inline void save_loads(const std::string& name, const std::vector<PoreLoad>& loads,
                       std::map<std::string, Vector>& state) {
  for (const PoreLoad& load : loads) state[key_of_reference(name, load, load.is_settled)] = load.reference;
}

inline void restore_loads(const std::string& name, std::vector<PoreLoad>& loads,
                          const std::map<std::string, Vector>& state) {
  for (PoreLoad& load : loads)
    for (const bool is_settled : {false, true})
      if (const auto kept = state.find(key_of_reference(name, load, is_settled));
          kept != state.end() && kept->second.size() == load.reference.size()) {
        load.reference = kept->second;
        load.is_settled = is_settled;
      }
}

}  // namespace sprekk::poromechanics
