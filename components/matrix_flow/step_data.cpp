// The data of a step: properties, values on the boundary, sources and wells.
#include <algorithm>
#include <cmath>

#include "components/matrix_flow/history_of_cells.hpp"
#include "components/matrix_flow/leaky_sides.hpp"
#include "components/matrix_flow/matrix_flow.hpp"
#include "framework/discretization/changes_along_face.hpp"
#include "framework/invariants.hpp"
#include "framework/mesh/cell_mean.hpp"

namespace sprekk::matrix_flow {

bool MatrixFlow::depends_on_time() const {
  return properties_change_ || stores_by_state() || options_.source.depends_on_time() ||
         std::any_of(options_.wells.begin(), options_.wells.end(),
                     [](const auto& well) { return well.second.rate.depends_on_time(); }) ||
         std::any_of(options_.boundary.begin(), options_.boundary.end(), [](const auto& side) {
           return std::ranges::any_of(side.second.data(), [](const Data* data) { return data->depends_on_time(); });
         });
}

void MatrixFlow::evaluate_data(const StepTime& step) {
  if (history_) history_->show(step);
  const bool same_step = evaluated_for_.start == step.start && evaluated_for_.end == step.end;
  const bool is_evaluated = data_evaluated_ && (same_step || !depends_on_time());
  if (properties_change_ && !is_evaluated) {
    for (Property& entry : permeability_) entry.evaluate(step);
    for (Property* property : {&porosity_, &compressibility_, &storage_}) property->evaluate(step);
    if (!viscosity_is_given_) viscosity_.evaluate(step);
    use_properties();
  }
  if (is_sealed_ && wall_flux_ && !wall_flux_->determined_by().empty())
    throw DataError(InputError(origin_, "fluid is to flow through the walls of rock that has no permeability",
                               "what enters a cell could not leave it",
                               "remove the coupler of its walls, or give it a permeability")
                        .what());
  if (is_sealed_ && leaky_sides_)
    throw DataError(InputError(origin_, "fluid is to leak through the side of rock that has no permeability",
                               "what enters a cell could not leave it",
                               "remove 'outer_pressure' from its sides, or give it a permeability")
                        .what());
  if (is_sealed_ && !borders_.empty())
    throw DataError(InputError(origin_, "fluid is to cross the border of rock that has no permeability",
                               "what enters a cell could not leave it",
                               "remove the coupler at the border, or give it a permeability")
                        .what());
  if (is_evaluated) return;
  data_evaluated_ = true;
  evaluated_for_ = step;
  if (by_state_) take_permeability();
  boundary_applied_ = false;
  forget_flow();
  evaluate_sources(step);
  if (leaky_sides_) leaky_sides_->evaluate(step);
  boundary_values_ = Vector::Zero(mesh_.face_count());
  boundary_changes_ = Vector::Zero(directions_of_faces * mesh_.face_count());
  for (int f = 0; f < mesh_.face_count(); ++f) {
    if (mesh_.face_side[f] == none) continue;
    const auto found = options_.boundary.find(mesh_.side_names[mesh_.face_side[f]]);
    if (found == options_.boundary.end()) continue;
    const Place place{mesh_.face_center[f], mesh_.cell_region[mesh_.face_cells[f][0]], 0};
    const SideCondition& side = found->second;
    if (side.pressure && (side.pressure->depends_on_space() || !options_.gravity.is_zero())) {
      const LinearOnFace linear = linear_on_face(mesh_, f, [&](const Point& x) {
        return value_in_step(*side.pressure, {x, place.region, 0}, step) - gravity_potential(x);
      });
      boundary_values_[f] = linear.at_center;
      for (int k = 0; k < directions_of_faces; ++k) boundary_changes_[directions_of_faces * f + k] = linear.changes[k];
    } else if (side.pressure) {
      boundary_values_[f] = value_in_step(*side.pressure, place, step);
    }
    if (side.flux) boundary_values_[f] = value_in_step(*side.flux, place, step) * mesh_.face_measure[f];
  }
}

std::optional<OutsideOfRock> MatrixFlow::outside(int side, const Place& place, const StepTime& step) const {
  const auto found = options_.boundary.find(mesh_.side_names[side]);
  if (found == options_.boundary.end()) return std::nullopt;
  const SideCondition& given = found->second;
  if (given.pressure) return OutsideOfRock{value_in_step(*given.pressure, place, step)};
  if (!given.is_leaky()) return std::nullopt;
  OutsideOfRock outside{value_in_step(*given.outer_pressure, place, step), std::nullopt, given.only_out};
  if (given.conductance) outside.conductance = value_in_step(*given.conductance, place, step);
  return outside;
}

void MatrixFlow::change_viscosity(const Vector& viscosity) {
  SPREKK_EXPECT(viscosity.size() == mesh_.cell_count(), viscosity.size(), mesh_.cell_count());
  viscosity_is_given_ = properties_change_ = true;
  if (viscosity_.values() == viscosity) return;
  viscosity_.set(viscosity);
  use_properties();
}

void MatrixFlow::evaluate_sources(const StepTime& step) {
  source_ = Vector::Zero(mesh_.cell_count());
  sources_.clear();
  if (!options_.source.is_zero()) {
    FluidSource& spread = sources_.emplace_back(FluidSource{"source", {}});
    for (int c = 0; c < mesh_.cell_count(); ++c) {
      if (!is_in_cell(c)) continue;
      const auto density = [&](const Point& at) {
        return value_in_step(options_.source, {at, mesh_.cell_region[c], 0}, step);
      };
      source_[c] = mesh_.cell_measure[c] *
                   (options_.source.depends_on_space() ? cell_mean(mesh_, c, density) : density(mesh_.cell_center[c]));
      spread.rates.emplace_back(c, source_[c]);
    }
  }
  for (const auto& [name, well] : options_.wells) {
    const double rate = value_in_step(well.rate, {well.path().front(), 0, 0}, step);
    FluidSource& at_well = sources_.emplace_back(FluidSource{name, {}, true});
    for (const auto& [cell, weight] : well_cells_.at(name)) {
      source_[cell] += weight * rate;
      at_well.rates.emplace_back(cell, weight * rate);
    }
    SPREKK_ASSERT(std::isfinite(rate), name, rate);
  }
}

void MatrixFlow::apply_boundary() {
  if (boundary_applied_) return;
  boundary_applied_ = true;
  SPREKK_ASSERT(boundary_values_.size() == mesh_.face_count(), boundary_values_.size(), mesh_.face_count());
  SPREKK_ASSERT(is_finite(boundary_values_) && is_finite(boundary_changes_));
  boundary_fluxes_ = operators_.flux_boundary * boundary_values_ + operators_.flux_change * boundary_changes_;
  if (is_limited_ && !is_sealed_)
    for (const int side : {0, 1})
      limited_constant_[side] =
          operators_.limited[side].boundary * boundary_values_ + operators_.limited[side].change * boundary_changes_;
  if (face_pressure_) continuity_constant_ = operators_.faces.continuity_boundary * boundary_values_;
  apply_boundary_at_borders();
  if (!wall_flux_) return;
  Vector trace = operators_.trace_boundary * boundary_values_ + operators_.trace_change * boundary_changes_ -
                 operators_.trace_cell * gravity_potential_cell_ + gravity_potential_face_;
  if (face_pressure_) trace -= operators_.faces.trace * gravity_potential_face_;
  wall_pressure_.constant.resize(mesh_.wall_count());
  for (int w = 0; w < mesh_.wall_count(); ++w) wall_pressure_.constant[w] = trace[mesh_.wall_face(w)];
}

std::vector<double> MatrixFlow::switch_times() const {
  std::vector<double> times = merged_switch_times(properties());
  const auto append = [&](const Data& data) {
    times.insert(times.end(), data.switch_times().begin(), data.switch_times().end());
  };
  append(options_.source);
  for (const auto& [name, well] : options_.wells) append(well.rate);
  for (const auto& [side, condition] : options_.boundary) {
    for (const Data* data : condition.data()) append(*data);
  }
  return times;
}

}  // namespace sprekk::matrix_flow
