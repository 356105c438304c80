#include "couplers/advection/held_flow.hpp"

#include "framework/field/ownership.hpp"
#include "framework/field/units_of_amounts.hpp"

namespace sprekk::couplers {

HeldFlow::HeldFlow(const CouplerContext& context, const CarryingFlow& flow)
    : mesh_(&context.mesh), name_(context.name), flow_(flow) {
  if (!flow_.matrix || !flow_.pressure_in_rock) return;
  flux_ = &context.fields.add(context.mesh, {.owner = context.name,
                                             .name = "flux_in_rock",
                                             .location = Location::face,
                                             .role = Role::derived(),
                                             .unit = volume_rate_unit,
                                             .doc = "Flux of fluid through each face as the flow was last solved",
                                             .accepted_with = flow_.pressure_in_rock->name()});
}

const Field* HeldFlow::wall_flux() const {
  if (!flow_.walls || mesh_->wall_count() == 0) return nullptr;
  const Field& flux = flow_.walls->wall_flux();
  return flux.is_solved() ? &flux : nullptr;
}

std::vector<const Field*> HeldFlow::fields() const {
  std::vector<const Field*> fields;
  if (flow_.pressure_in_rock) fields.push_back(flow_.pressure_in_rock);
  if (const Field* flux = wall_flux()) fields.push_back(flux);
  if (flow_.fracture) fields.push_back(&flow_.fracture->flux());
  return fields;
}

void HeldFlow::take(const IsSolved& is_solved, const StepTime& step) {
  for (const Field* field : fields()) has_flowed_ = has_flowed_ || is_solved(*field);
  const bool has_length = step.end > step.start;  // a state that is settled has none
  if (flux_ && is_solved(*flow_.pressure_in_rock)) {
    Vector fluxes = flow_.matrix->face_fluxes();
    exchange(*mesh_, Location::face, 1, fluxes);
    if (has_length) in_rock_.add(step, {fluxes, flow_.matrix->fluid_sources()});
    flux_->set(std::move(fluxes));
    is_taken_ = true;
  }
  if (!has_length) return;
  if (const Field* flux = wall_flux(); flux && is_solved(*flux)) through_walls_.add(step, {flux->now()});
  if (flow_.fracture && is_solved(flow_.fracture->flux()))
    in_fractures_.add(step, {flow_.fracture->flux().now(), flow_.fracture->fluid_sources()});
  if (flow_.wells && is_solved(flow_.wells->rate())) of_wells_.add(step, {flow_.wells->rate().now()});
}

Vector HeldFlow::fluxes_in_rock(const IsSolved& is_solved, const StepTime& step) const {
  if (!flux_ || is_solved(*flow_.pressure_in_rock)) return flow_.matrix->face_fluxes();
  if (const FluidRates* in_step = in_rock_.over(step)) return in_step->values;
  return is_taken_ ? flux_->now() : flow_.matrix->face_fluxes();
}

FlowRates HeldFlow::rates(const IsSolved& is_solved, const StepTime& step) const {
  /// In the step, where the field is held and has been solved for.
  const auto held = [&](const FlowCourse& course, const Field& field) {
    return is_solved(field) ? nullptr : course.over(step);
  };
  FlowRates rates;
  if (flow_.matrix) {
    const FluidRates* in_step = flux_ ? held(in_rock_, *flow_.pressure_in_rock) : nullptr;
    rates.sources_in_rock = in_step ? in_step->sources : flow_.matrix->fluid_sources();
  }
  if (const Field* flux = wall_flux()) {
    const FluidRates* in_step = held(through_walls_, *flux);
    rates.walls = in_step ? in_step->values : flux->now();
  }
  if (flow_.fracture) {
    const FluidRates* in_step = held(in_fractures_, flow_.fracture->flux());
    rates.points = in_step ? in_step->values : flow_.fracture->flux().now();
    rates.sources_in_fractures = in_step ? in_step->sources : flow_.fracture->fluid_sources();
  }
  if (flow_.wells) {
    const FluidRates* in_step = held(of_wells_, flow_.wells->rate());
    rates.wells = in_step ? in_step->values : flow_.wells->rate().now();
  }
  return rates;
}

void HeldFlow::carry_over(const HeldFlow& before) {
  has_flowed_ = had_flowed_ = before.has_flowed_;
  is_taken_ = was_taken_ = false;
}

void HeldFlow::accepted() {
  for (FlowCourse* course : {&in_rock_, &through_walls_, &in_fractures_, &of_wells_}) course->clear();
  was_taken_ = is_taken_;
  had_flowed_ = has_flowed_;
}

void HeldFlow::rewound() {
  for (FlowCourse* course : {&in_rock_, &through_walls_, &in_fractures_, &of_wells_}) course->clear();
  is_taken_ = was_taken_;
  has_flowed_ = had_flowed_;
}

void HeldFlow::save(std::map<std::string, Vector>& state) const {
  state[name_ + ".held_flow"] = Eigen::Vector2d{was_taken_ ? 1.0 : 0.0, had_flowed_ ? 1.0 : 0.0};
}

void HeldFlow::restore(const std::map<std::string, Vector>& state) {
  const Vector& flags = state.at(name_ + ".held_flow");
  is_taken_ = was_taken_ = flags[0] != 0;
  has_flowed_ = had_flowed_ = flags[1] != 0;
}

}  // namespace sprekk::couplers
