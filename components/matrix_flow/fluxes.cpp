// The fluxes through faces at a state of the pressure, and the velocities that follow from them.
#include <Eigen/LU>

#include "components/capabilities/formula_of_cells.hpp"
#include "components/matrix_flow/buoyancy.hpp"
#include "components/matrix_flow/history_of_cells.hpp"
#include "components/matrix_flow/matrix_flow.hpp"
#include "framework/assembly/products.hpp"
#include "framework/field/ownership.hpp"
#include "framework/field/units_of_amounts.hpp"
#include "framework/invariants.hpp"
#include "framework/mesh/cell_sums.hpp"
#include "framework/parallel/parallel.hpp"

namespace sprekk::matrix_flow {

void MatrixFlow::forget_flow() {
  flows_ = {};
  with_walls_ = {};
}

const MatrixFlow::Flow& MatrixFlow::flow(State state) const {
  const auto version_of = [&](const Field& field) {
    return state == State::now ? field.version() : field.accepted_version();
  };
  const auto values_of = [&](const Field& field) -> const Vector& {
    return state == State::now ? field.now() : field.accepted();
  };
  const std::uint64_t version = version_of(pressure_), face_version = face_pressure_ ? version_of(*face_pressure_) : 0;
  const bool is_limited = is_limited_ && !is_sealed_;
  const std::uint64_t wall_version = is_limited && wall_flux_ ? version_of(*wall_flux_) : 0;
  const std::uint64_t side_version = is_limited && side_outflow_ ? version_of(*side_outflow_) : 0;
  const auto density_state = state == State::now ? FluidDensity::State::now : FluidDensity::State::accepted;
  const FluidDensity::Version density = buoyancy_ ? buoyancy_->version(density_state) : FluidDensity::Version{};
  for (Flow& kept : flows_)
    if (kept.used > 0 && kept.pressure == version && kept.face_pressure == face_version &&
        kept.wall_flux == wall_version && kept.side_outflow == side_version && kept.density == density) {
      kept.used = ++flow_uses_;
      return kept;
    }
  Flow& flow = flows_[flows_[0].used <= flows_[1].used ? 0 : 1];
  SPREKK_EXPECT(pressure_.size() == mesh_.cell_count(), pressure_.size(), mesh_.cell_count());
  flow.pressure = version;
  flow.face_pressure = face_version;
  flow.wall_flux = wall_version;
  flow.side_outflow = side_version;
  flow.density = density;
  flow.used = ++flow_uses_;
  const Vector potential = values_of(pressure_) - gravity_potential_cell_;
  flow.fluxes = multiply(operators_.flux_cell, potential, false).value;
  if (face_pressure_)
    flow.fluxes += multiply(operators_.faces.flux, values_of(*face_pressure_) - gravity_potential_face_, false).value;
  flow.fluxes += boundary_fluxes_;
  Vector excess;
  if (buoyancy_) {
    excess = buoyancy_->excess(density_state);
    flow.fluxes += buoyancy_->flux().cells * excess + buoyancy_->flux().of_boundaries;
  }
  if (is_limited)
    add_limited(flow, potential, wall_flux_ ? values_of(*wall_flux_) : Vector(),
                side_outflow_ ? values_of(*side_outflow_) : Vector(), excess);
  flow.outflow = cell_sums(mesh_, flow.fluxes, 1);
  flow.leaving = Vector::Zero(mesh_.cell_count());
  for (const auto& [face, cell] : outer_faces_) flow.leaving[cell] += flow.fluxes[face];
  flow.largest_outflow = flow.outflow.lpNorm<Eigen::Infinity>();
  return flow;
}

const Vector& MatrixFlow::face_fluxes() const {
  const Flow& flow = this->flow(State::now);
  if (!wall_flux_ && borders_.empty()) return flow.fluxes;
  const std::uint64_t wall_version = wall_flux_ ? wall_flux_->version() : 0;
  std::vector<std::uint64_t> border_versions;
  for (const OpenBorder& border : borders_) border_versions.push_back(border.outflow->version());
  if (with_walls_.fluxes.size() == 0 || with_walls_.pressure != flow.pressure ||
      with_walls_.face_pressure != flow.face_pressure || with_walls_.wall_flux != wall_version ||
      with_walls_.borders != border_versions || with_walls_.density != flow.density) {
    with_walls_ = {flow.pressure, flow.face_pressure, wall_version, std::move(border_versions),
                   flow.density,  flow.fluxes};
    if (wall_flux_) with_walls_.fluxes += flux_of_wall_flux_ * wall_flux_->now();
    for (const OpenBorder& border : borders_) with_walls_.fluxes += border.flux * border.outflow->now();
  }
  return with_walls_.fluxes;
}

std::vector<MatrixFluxes::Derivative> MatrixFlow::face_flux_derivatives() const {
  std::vector<Derivative> derivatives = {{&pressure_, &operators_.flux_cell}};
  if (face_pressure_) derivatives.push_back({face_pressure_, &operators_.faces.flux});
  if (wall_flux_) derivatives.push_back({wall_flux_, &flux_of_wall_flux_});
  for (const OpenBorder& border : borders_) derivatives.push_back({border.outflow, &border.flux});
  if (buoyancy_) {
    fluxes_by_density_ = fluxes_by_density(this->flow(State::now));
    for (const auto& [field, matrix] : fluxes_by_density_) derivatives.push_back({field, &matrix});
  }
  for (const ByState& by : linearized_) derivatives.push_back({by.field, &by.flux});
  if (!is_limited_ || is_sealed_) return derivatives;
  const Flow& flow = this->flow(State::now);
  limited_by_pressure_ = limited_derivative(flow, operators_.limited[0].cell, operators_.limited[1].cell);
  derivatives.push_back({&pressure_, &limited_by_pressure_});
  if (wall_flux_) {
    limited_by_wall_flux_ = limited_derivative(flow, limited_of_wall_flux_[0], limited_of_wall_flux_[1]);
    derivatives.push_back({wall_flux_, &limited_by_wall_flux_});
  }
  if (side_outflow_) {
    const auto& [first, second] = borders_.front().limited;
    limited_by_side_outflow_ = limited_derivative(flow, first, second);
    derivatives.push_back({side_outflow_, &limited_by_side_outflow_});
  }
  return derivatives;
}

FluxOperators MatrixFlow::fluxes_around(const std::vector<char>& nodes, const Tensor& mobility) const {
  std::vector<FlowCondition> sealed(mesh_.face_count(), FlowCondition::none);
  for (int f = 0; f < mesh_.face_count(); ++f)
    if (mesh_.face_cells[f][1] == none) sealed[f] = FlowCondition::flux;
  return discretize_(mesh_, std::vector<Tensor>(mesh_.cell_count(), mobility), sealed, nodes);
}

void MatrixFlow::report(std::vector<Quantity>& quantities) const {
  const bool has_flowed = discretized_mobility_ != 0;
  for (const auto& [well, given] : options_.wells) {
    double rate = 0;
    for (const FluidSource& source : sources_)
      if (source.name == well)
        for (const auto& [cell, part] : source.rates) rate += part;
    quantities.push_back({name() + "." + well + ".rate", volume_rate_unit, rate});
  }
  if (options_.boundary.empty()) return;
  Vector outflow = Vector::Zero(static_cast<Eigen::Index>(mesh_.side_names.size()));
  if (has_flowed) {
    const Vector& fluxes = fluxes_of_step();
    for (int f = 0; f < mesh_.face_count(); ++f)
      if (mesh_.face_side[f] != none && is_owned(mesh_, Location::face, f)) outflow[mesh_.face_side[f]] += fluxes[f];
    parallel::sum(outflow);
  }
  for (std::size_t side = 0; side < mesh_.side_names.size(); ++side)
    if (options_.boundary.count(mesh_.side_names[side]) > 0)
      quantities.push_back({name() + "." + mesh_.side_names[side] + ".outflow", volume_rate_unit,
                            outflow[static_cast<Eigen::Index>(side)]});
}

void MatrixFlow::output(std::vector<OutputField>& fields) const {
  if (history_) history_->history().output(fields);
  if (pores_) fields.push_back({name() + ".porosity", "", Location::cell, 1, pores_->values()});
  // Cell-wise Darcy velocity from the fluxes: V v = sum over faces of flux · (x_face − x_cell), exact for a constant
  // one. Where faces are bent, in space, that sum is V B v for a constant v, with B the sum of (x_face − x_cell) ⊗ area
  // vector over V, which is 1 for flat faces.
  Vector velocity = Vector::Zero(dimension * mesh_.cell_count());
  if (discretized_mobility_ == 0) {  // nothing has flowed yet
    fields.push_back({name() + ".velocity", "m/s", Location::cell, dimension, std::move(velocity)});
    return;
  }
  const Vector& fluxes = fluxes_of_step();
  for (int c = 0; c < mesh_.cell_count(); ++c) {
    if (!is_in_cell(c)) continue;
    auto of_cell = velocity.segment<dimension>(dimension * c);
    Tensor of_constants = Tensor::Zero();
    for (const int face : mesh_.cell_faces[c]) {
      const double out = mesh_.face_cells[face][0] == c ? 1 : -1;
      const Point arm = mesh_.face_center[face] - mesh_.cell_center[c];
      of_cell += out * fluxes[face] * arm / mesh_.cell_measure[c];
      of_constants +=
          out * mesh_.face_measure[face] / mesh_.cell_measure[c] * arm * mesh_.face_normal[face].transpose();
    }
    if constexpr (dimension == 3) of_cell = of_constants.inverse() * of_cell;
  }
  exchange(mesh_, Location::cell, dimension, velocity);
  fields.push_back({name() + ".velocity", "m/s", Location::cell, dimension, std::move(velocity)});
}

}  // namespace sprekk::matrix_flow
