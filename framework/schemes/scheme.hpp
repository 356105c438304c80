// Coupling schemes of a scene: which components are solved together, in which order, with which help.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "framework/scene/model.hpp"

namespace sprekk {

/// The names of the components of one `solve`.
using Group = std::vector<std::string>;

/// One way to solve for all components of a scene.
struct Scheme {
  std::vector<Group> groups;  ///< in the order in which they are solved; one is the monolithic scheme
  bool is_jacobi = false;     ///< whether each group uses the values of the others from the pass before
  std::map<std::size_t, std::string> stabilizations;  ///< by the index of the group that has them
  std::string acceleration;                           ///< "anderson: 5", "iqn_ils: {}"; "" for none

  bool is_monolithic() const { return groups.size() == 1; }
  std::string stabilization(std::size_t group) const;  ///< "" for none
  std::string all_stabilizations() const;              ///< joined by commas; "" for none
  std::string name() const;                            ///< as a name of a folder: "a_b-c_d=STABILIZATION=anderson_5"
  std::string split() const;                           ///< "a b (STABILIZATION) → c d"
  std::string whole_name() const;                      ///< "a b → c d, STABILIZATION, anderson: 5"
  /// Whether `text` stands in one of its names; "->" stands for "→", and spaces and '_' for each other.
  bool is_called(const std::string& text) const;
  /// The value of `schedule:` as YAML on one line. `until`: of the coupled residual; `behind`: steps that follow.
  /// A step whose passes do not converge is refused.
  std::string schedule(double until, int at_most, const std::vector<std::string>& behind) const;
};

/// All sensible schemes of a scene, the monolithic one first. Components that cannot be solved apart stay together
/// (Part::dependences); apart from those that can with the Schur complement of waiting unknowns. Both orders of two
/// groups; of more groups, those that are not rotations of one another, since an iteration that goes round and round
/// has no beginning; each also with all groups at once (Jacobi). Each without stabilization, and with those that a
/// coupler offers between groups; the first two also with `response` for all groups that have unknowns on interfaces
/// alone, where there are some. Each with every acceleration.
std::vector<Scheme> sensible_schemes(const Model& model, const std::vector<std::string>& accelerations);

}  // namespace sprekk
