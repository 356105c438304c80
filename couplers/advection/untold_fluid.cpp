// A note for each side through which fluid without a given value enters.
#include <fmt/format.h>

#include <algorithm>

#include "couplers/advection/advection.hpp"
#include "framework/field/units_of_amounts.hpp"
#include "framework/parallel/parallel.hpp"
#include "framework/round_off.hpp"

namespace sprekk::couplers {
void Advection::note_untold_fluid(Notes& notes) const {
  const int sides = static_cast<int>(mesh_.side_names.size());
  Vector into_rock = Vector::Zero(sides), into_fractures = into_rock;
  double through_all = 0;
  std::vector<char> is_told(sides, false);  // for fluid in the rock
  if (rock_.value) {
    const Vector* known = flow_->last_fluxes_in_rock();
    const Vector& fluxes = known ? *known : matrix_->face_fluxes();
    for (int f = 0; f < mesh_.face_count(); ++f) {
      const int side = mesh_.face_side[f];
      if (side == none) continue;
      const bool has_value = in_rock_->side_value(f).has_value();
      is_told[side] = is_told[side] || has_value;
      if (mesh_.cell_rank[mesh_.face_cells[f][0]] != parallel::rank()) continue;
      through_all += std::abs(fluxes[f]);
      if (!has_value) into_rock[side] += std::max(-fluxes[f], 0.0);
    }
    through_all = parallel::sum(through_all);
    parallel::sum(into_rock);
  }
  for (int p = 0; fractures_.value && p < static_cast<int>(mesh_.ridges.size()); ++p) {
    const Ridge& ridge = mesh_.ridges[p];
    if (ridge.kind != Ridge::Kind::on_boundary) continue;
    const double out = fracture_->flux().now()[p];
    through_all += std::abs(out);
    if (!in_fractures_->end_value(p)) into_fractures[ridge.side] += std::max(-out, 0.0);
  }
  const auto note = [&](const Field& value, const std::string& where, int side, double rate, bool is_told_beside) {
    // Fluid without a given concentration has no tracer. Without a given temperature it has that of the cell, and there
    // is a note only if the rock beside the fracture has a given one.
    if (rate <= rounding::far_above * through_all || (!carried_.of_unknown_fluid && !is_told_beside)) return;
    const std::string has = carried_.of_unknown_fluid ? "it has no " + carried_.quantity
                                                      : "it has the " + carried_.value + " of the cell that it enters";
    const std::string& owner = value.spec().owner;
    notes.add(owner + ": fluid without a " + carried_.value + " through " + mesh_.side_names[side],
              fmt::format("{:.3g} {} of fluid enters {} through the side '{}', of which '{}' tells no {}{} ({}) give "
                          "'{}' one under 'boundary'",
                          rate, volume_rate_unit, where, mesh_.side_names[side], owner, carried_.value,
                          is_told_beside ? ", though the rock beside has one" : "", has, owner),
              rate);
  };
  for (int side = 0; side < sides; ++side) {
    if (rock_.value) note(*rock_.value, "the rock", side, into_rock[side], false);
    if (fractures_.value) note(*fractures_.value, "fractures", side, into_fractures[side], is_told[side]);
  }
}

}  // namespace sprekk::couplers
