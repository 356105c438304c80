#include "components/poromechanics/notes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "components/poromechanics/check_conditions.hpp"
#include "components/poromechanics/loaded_rock.hpp"
#include "components/poromechanics/start_balance.hpp"
#include "framework/mesh/geometry.hpp"
#include "framework/round_off.hpp"

namespace sprekk::poromechanics {

namespace {

constexpr double softest_rock = 1e3;  // Pa; a scene with softer rock is treated as dimensionless

}  // namespace

void note_conditions(Notes& notes, const Options& options, const Mesh& mesh, const std::string& name,
                     const Origin& origin) {
  // How much of a prescribed stress acts in a direction (x, y) in which the displacement is prescribed.
  struct Share {
    double length = 0, doubled = 0, all = 0;  // doubled: where a traction acts in this direction, too
  };
  struct Stress {
    const char* name;
    std::optional<Data> SideCondition::*data;
    int axis;  // of the face
  };
  constexpr Stress stresses[] = {{"normal_stress", &SideCondition::normal_stress, 0},
                                 {"shear_stress", &SideCondition::shear_stress, 1}};
  std::map<std::pair<std::string, std::string>, std::array<Share, dimension>> overridden;  // of a side, by a stress
  for (int f = 0; f < mesh.face_count(); ++f) {
    const SideCondition* condition = condition_of(options, mesh, f);
    if (!condition || condition->axes() == ConditionAxes::of_face) continue;
    const Tensor axes = axes_of(ConditionAxes::of_face, mesh.face_normal[f]);
    for (const Stress& stress : stresses)
      for (int k = 0; k < dimension; ++k) {
        Share& share = overridden[{mesh.side_names[mesh.face_side[f]], stress.name}][k];
        const std::optional<Data>& data = condition->*stress.data;
        share.all += mesh.face_measure[f];
        if (!data || data->is_zero()) continue;
        const double part = mesh.face_measure[f] * std::abs(axes(k, stress.axis));
        if (condition->displacement_of(k))
          share.length += part;
        else if (condition->traction_along[k])
          share.doubled += part;
      }
  }
  const auto note = [&](const std::string& what, const Origin& where, const std::string& text) {
    notes.add(name + "." + what + " without effect", where.text() + ": " + text);
  };
  for (const auto& [side, condition] : options.boundary)
    for (int k = 0; k < dimension; ++k) {
      const std::string direction = axis_names[k];
      for (const Stress& stress : stresses) {
        const Share& share = overridden[{side, stress.name}][k];
        if (share.length > rounding::far_above * share.all)
          note("boundary." + side + "." + stress.name + "." + direction, condition.origin,
               fmt::format("the {} component of '{}' on side '{}' has no effect (the displacement in {} is "
                           "prescribed there, which decides) remove one of the two",
                           direction, stress.name, side, direction));
        if (share.doubled > rounding::far_above * share.all)
          notes.add(
              name + ".boundary." + side + ": " + stress.name + " and traction",
              fmt::format("{}: '{}' and 'traction_{}' on side '{}' act in the same direction, and are added remove "
                          "one of the two, unless that is meant",
                          condition.origin.text(), stress.name, direction, side));
      }
      if (condition.traction && condition.displacement_of(k) && !condition.traction->component[k].is_zero())
        note("boundary." + side + ".traction." + direction, condition.origin,
             fmt::format("the {} component of 'traction' on side '{}' has no effect (the displacement in {} is "
                         "prescribed there, which decides) remove one of the two",
                         direction, side, direction));
    }
  if (!options.gravity.is_zero() && options.rock_density.is_zero())
    note("gravity", origin,
         "gravity has no effect on '" + name +
             "' (its rock_density is 0) give the density of the saturated rock, or 'gravity: " +
             (dimension == 2 ? "[0, 0]" : "[0, 0, 0]") + "' to the component");
  if (options.gravity.is_zero() && !options.rock_density.is_zero())
    note("rock_density", origin,
         "'rock_density' of '" + name +
             "' does not weigh on it (there is no gravity) give a gravity, unless only a profile with depth is to read "
             "it");
  if (options.bulk_modulus && !options.is_anisotropic)
    note("bulk_modulus", origin,
         "'bulk_modulus' of '" + name +
             "' has no effect (that of an isotropic rock follows from young_modulus and poisson_ratio) remove it");
}

void LoadedRock::note_input(Notes& notes) const { note_conditions(notes, options_, mesh_, name(), origin_); }

void LoadedRock::note_start(Notes& notes) const {
  note_start_imbalance(notes, options_, mesh_, name(), evaluated_for_.start);
}

void note_large_strain(Notes& notes, const std::string& name, const LargestStrain& largest, const Options& options,
                       const std::vector<Stiffness>& stiffness) {
  if (largest.strain <= options.large_strain) return;
  double softest = std::numeric_limits<double>::infinity();
  for (const Stiffness& of_cell : stiffness) softest = std::min(softest, of_cell(dimension, dimension));
  if (softest < softest_rock) return;
  notes.add(
      name + " large strain",
      fmt::format("the displacement of '{}' changes by {:.3g} of the distance at {} (strains over {:.3g} are large: "
                  "the rock is assumed to be linear, and its displacement to be small) check loads and stiffness",
                  name, largest.strain, to_text(largest.place), options.large_strain),
      largest.strain);
}

}  // namespace sprekk::poromechanics
