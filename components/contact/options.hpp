// The parameters that all types of contact share.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "components/contact/laws/closure_options.hpp"
#include "components/contact/laws/friction_options.hpp"
#include "components/contact/laws/rate_and_state_options.hpp"
#include "components/contact/laws/strength.hpp"
#include "components/contact/multiplier.hpp"
#include "framework/assembly/history/history_options.hpp"
#include "framework/config/spec.hpp"
#include "framework/scene/component.hpp"

namespace sprekk::contact {

/// Parameters of the contact law.
struct Options {
  HistoryOptions history;
  Data friction;  ///< mu_s
  FrictionOptions friction_law;
  Data dilation_angle;                   ///< psi, rad
  std::optional<double> dilation_limit;  ///< m
  std::optional<Data> dilation;          ///< m, the opening by slip, instead of the two above
  Data cohesion;                         ///< Pa
  Weakening weakening;
  bool weakens = false;                  ///< whether the scene has the section
  std::optional<Data> dynamic_friction;  ///< mu_d
  RateAndStateOptions rate_and_state;
  bool depends_on_rate = false;  ///< whether the scene has the section
  ClosureOptions closure;
  /// Jump over the length of its fracture from which on a note says that it is large.
  double large_jump = 0.01;
  std::vector<std::string> fractures;  ///< where the contact is; all if there are none
  Origin fractures_origin;
  Spec spec(const std::string& type, const std::string& doc);
};

/// Builds a FrictionalContact; the sources of the types need not include its header. `stiffness_factor`: c over the
/// stiffness of the rock against a jump of the cell. Throws InputError where the scene has no fractures.
std::unique_ptr<Component> frictional_contact(const ComponentContext& context, const Options& options,
                                              Multiplier multiplier, double stiffness_factor);

}  // namespace sprekk::contact
