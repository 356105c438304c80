// What the scene says of fluid that carries something, and whether it fits.
#include "couplers/advection/advection.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "components/capabilities/cold.hpp"
#include "components/capabilities/fracture_fluid.hpp"
#include "components/capabilities/one_place.hpp"
#include "framework/assembly/state_fields.hpp"
#include "framework/mesh/geometry.hpp"
#include "framework/noticeable.hpp"

namespace sprekk::couplers {

Advection::Advection(const CouplerContext& context, const Carried& carried, const AdvectionOptions& options,
                     MatrixCarried* in_rock, FractureCarried* in_fractures)
    : Coupler(context.name),
      mesh_(context.mesh),
      carried_(carried),
      options_(options),
      origin_(context.origin),
      in_rock_(in_rock),
      in_fractures_(in_fractures) {
  for (const auto& [place, injected] : options_.injected)
    require_one_place(injected.value, "the " + carried_.value + " of '" + place + "'",
                      "what enters at a place of this name has one value", injected.origin);
  matrix_ = context.find<MatrixFluxes>();
  fracture_ = context.find<FractureFluxes>();
  walls_ = context.find<MatrixWalls>();
  flow_in_rock_ = context.find<MatrixFluid>();
  if (!(matrix_ && in_rock_) && !(fracture_ && in_fractures_))
    throw InputError(context.origin, "coupler " + name() + " has no flow that carries " + carried_.quantity,
                     "it needs the flow and the " + carried_.quantity + " of the matrix, of the fractures, or of both",
                     "name such components in `between`, or remove the coupler for conduction alone");
  if (in_rock_ && matrix_) rock_ = contents(context, *in_rock_, Location::cell, "rock");
  if (in_fractures_ && fracture_) fractures_ = contents(context, *in_fractures_, Location::fracture_cell, "fractures");
  if (auto* formulas = dynamic_cast<TakesState*>(fracture_); formulas && fractures_.value && carried_.in_formulas)
    formulas->offer_state(carried_.in_formulas, {fractures_.value});
  if (auto* formulas = dynamic_cast<TakesState*>(matrix_); formulas && rock_.value && carried_.in_formulas)
    formulas->offer_state(carried_.in_formulas, {rock_.value});
  find_wells(context);
  for (const FluidContents* place : {&rock_, &fractures_})
    if (place->value) at_start_.push_back(place->value->now());
  if (fractures_.value) compare_apertures(context);
  flow_.emplace(context,
                CarryingFlow{rock_.value ? matrix_ : nullptr, flow_in_rock_ ? &flow_in_rock_->pressure() : nullptr,
                             walls_, fracture_, wells_.wells});
}

void Advection::note_input(Notes& notes) const {
  std::vector<const Data*> given;
  for (const auto& [place, injected] : options_.injected) given.push_back(&injected.value);
  if (carried_.has_absolute_zero)
    for (const Vector& at_start : at_start_) note_cold(notes, name(), at_start, given);
  if (const Dispersivity& of = options_.dispersivity; of.across > of.along)
    notes.add(
        name() + ": dispersion across the flow",
        fmt::format("'{}' spreads {} more across the flow ({:.4g} m) than along it ({:.4g} m) (in rocks the transverse "
                    "dispersivity is a tenth of the longitudinal one or less: Gelhar, Welty and Rehfeldt 1992) "
                    "exchange the two, unless that is meant",
                    name(), carried_.quantity, of.across, of.along));
  if (!other_aperture_.empty()) notes.add(name() + ": another aperture for " + carried_.quantity, other_aperture_);
}

void Advection::note_step(Notes& notes, const StepTime&) const {
  wells_.note(name(), notes);
  if (flow_->has_flowed()) note_untold_fluid(notes);
  if (disperses_late_)
    notes.add(name() + ": dispersion of the step before",
              "the dispersion of '" + name() +
                  "' is that of the flow of the step before, and none in the first step (" + carried_.quantity +
                  " and flow are in one 'solve') solve the flow before, in a step of its own");
}

std::vector<double> Advection::switch_times() const {
  std::vector<const Data*> data;
  for (const auto& [name, given] : options_.injected) data.push_back(&given.value);
  return merged_switch_times(data);
}

void Advection::compare_apertures(const CouplerContext& context) {
  const FractureFluid* fluid = context.find<FractureFluid>();
  const Vector* of_carried = in_fractures_->thickness();
  if (!fluid || !of_carried) return;
  const Vector& of_fluid = fluid->initial_aperture();
  double worst = noticeable;
  for (int i = 0; i < of_carried->size(); ++i) {
    const double larger = std::max(of_fluid[i], (*of_carried)[i]),
                 difference = std::abs(of_fluid[i] - (*of_carried)[i]);
    if (of_fluid[i] <= 0 || difference <= worst * larger) continue;
    worst = difference / larger;
    const FractureCell& cell = mesh_.fracture_cells[i];
    other_aperture_ = fmt::format(
        "the fracture '{}' is {:.4g} m wide for its {} and {:.4g} m for its fluid at {} (so it stores the {} of "
        "another amount of fluid than flows in it) give 'aperture' of '{}' the initial_aperture of the flow",
        mesh_.fractures[cell.fracture].name, (*of_carried)[i], carried_.quantity, of_fluid[i], to_text(cell.center),
        carried_.quantity, in_fractures_->value().spec().owner);
  }
}

void Advection::find_wells(const CouplerContext& context) {
  const std::string left_out = context.left_out<WellPressures>();
  if (!left_out.empty())
    throw InputError(context.origin, "coupler " + name() + " leaves out '" + left_out + "'",
                     "the fluid of these wells carries " + carried_.quantity + ", too",
                     "name '" + left_out + "' in 'between'");
  wells_.wells = context.find<WellPressures>();
  wells_.carried = &carried_;
  if (!wells_.wells) return;
  if (auto* fluid = context.find<MatrixFluid>()) wells_.rock = {&fluid->pressure(), rock_.value};
  if (auto* fluid = context.find<FractureFluid>()) wells_.fractures = {&fluid->pressure(), fractures_.value};
}

std::vector<std::optional<double>> Advection::injected_by_wells() const {
  std::vector<std::optional<double>> values;
  if (wells_.wells)
    for (const std::string& well : wells_.wells->names()) {
      const auto given = std::ranges::find(injected_, well, &std::pair<std::string, double>::first);
      values.push_back(given == injected_.end() ? carried_.of_unknown_fluid : std::optional(given->second));
    }
  return values;
}

void Advection::check_names() const {
  std::vector<std::string> known;
  if (rock_.value)
    for (const FluidSource& source : matrix_->fluid_sources()) known.push_back(source.name);
  if (fractures_.value) {
    for (const FluidSource& source : fracture_->fluid_sources()) known.push_back(source.name);
    for (const FluidReservoir& reservoir : fracture_->fluid_reservoirs()) known.push_back(reservoir.name);
  }
  if (wells_.wells) known.insert(known.end(), wells_.wells->names().begin(), wells_.wells->names().end());
  for (const std::string& each : known)
    if (std::ranges::count(known, each) > 1)
      throw DataError(InputError(origin_,
                                 "two places at which the flow lets fluid in or out have the name '" + each + "'",
                                 "coupler " + name() + " tells the " + carried_.value + " of each by its name",
                                 "give one of them another name")
                          .what());
  for (const auto& [name, given] : options_.injected)
    if (!std::ranges::count(known, name))
      throw DataError(unknown_name(given.origin, "place where the flow lets fluid in", name, known).what());
}

}  // namespace sprekk::couplers
